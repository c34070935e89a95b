#include "coupling/hex_neighbourhood.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "coupling/hex_cells.hpp"
#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// Windows that only touch a cell, as on uniform grids, add nothing there.
constexpr double touch = 1e-9;

using Turns = std::array<int, hex_periods>;

/// Whether one meets the border within `layers` cells by leaving a cell through a face and every next one through the face
/// opposite.
bool border_within(const HexCells& cells, std::uint32_t cell, std::size_t side, int layers) {
    const std::vector<HexStep>& steps = cells.steps();
    for (int depth = 0; depth < layers; ++depth) {
        const std::uint32_t next = steps[hex_faces_count * cell + side].cell;
        if (next == no_cell) return true;
        std::size_t back = 0;
        while (back + 1 < hex_faces_count && steps[hex_faces_count * next + back].cell != cell) ++back;
        side = back ^ 1U;
        cell = next;
    }
    return false;
}

/// Rows of the inverse of the matrix whose columns are the sides of a cell, those across the border stretched.
HexWindow window_of(const HexCells& cells, std::uint32_t cell, const WindowShape& shape) {
    const auto& sides = cells.sides(cell);
    const double volume = dot(sides[0], cross(sides[1], sides[2]));
    HexWindow w{};
    for (std::size_t q = 0; q < 3; ++q) {
        const bool wide = border_within(cells, cell, 2 * q, shape.layers) ||
                          border_within(cells, cell, 2 * q + 1, shape.layers);
        const Vec3d row =
            (1 / ((wide ? shape.stretch : 1) * volume)) * cross(sides[(q + 1) % 3], sides[(q + 2) % 3]);
        w.inverse[3 * q] = row.x, w.inverse[3 * q + 1] = row.y, w.inverse[3 * q + 2] = row.z;
    }
    return w;
}

/// Finds the candidates of one cell after the other by spreading from neighbour to neighbour.
class Search {
  public:
    Search(const HexCells& cells, const std::vector<HexWindow>& windows, double reach)
        : cells_(cells), windows_(windows), reach_(reach), seen_(windows.size()) {
        image_of_[{}] = 0;
        images.push_back({0, 0, 0});
    }

    std::vector<Vec3d> images;

    void add_candidates(std::uint32_t host, std::vector<HexCandidate>& all) {
        std::vector<Found> found{{host, {}, 0}};
        seen_[host] = {host, 0};
        first_ = all.size();
        all.push_back({host, 0});
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Found from = found[i];
            for (std::size_t s = 0; s < hex_faces_count; ++s) {
                const HexStep step = cells_.steps()[hex_faces_count * from.cell + s];
                if (step.cell == no_cell) continue;
                Found next{step.cell, from.turns, 0};
                if (step.turn != 0)
                    next.turns[static_cast<std::size_t>(std::abs(step.turn)) - 1] += step.turn > 0 ? 1 : -1;
                next.image = image(next.turns);
                if (known(host, next, all) || !reaches(next, host)) continue;
                seen_[next.cell] = {host, next.image};
                found.push_back(next);
                all.push_back({next.cell, next.image});
            }
        }
    }

  private:
    struct Found {
        std::uint32_t cell;
        Turns turns;
        std::uint32_t image;
    };
    struct Seen {
        std::uint32_t host = no_cell, image = 0;
    };

    std::uint32_t image(const Turns& turns) {
        const auto [entry, added] = image_of_.try_emplace(turns, static_cast<std::uint32_t>(images.size()));
        if (added) {
            HexPlace place{0, {turns[0], turns[1], turns[2]}};
            images.push_back(cells_.walk().offset(place));
        }
        return entry->second;
    }

    /// Only a cell that is met as two images of itself needs a look at the list.
    [[nodiscard]] bool known(std::uint32_t host, const Found& f, const std::vector<HexCandidate>& all) const {
        if (seen_[f.cell].host != host) return false;
        if (seen_[f.cell].image == f.image) return true;
        return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(first_), all.end(),
                           [&](const HexCandidate& c) { return c.cell == f.cell && c.image == f.image; });
    }

    /// Whether the window of f overlaps the box around the host's corners in the window's own coordinates.
    [[nodiscard]] bool reaches(const Found& f, std::uint32_t host) const {
        const meshing::HexGrid& grid = cells_.grid();
        const Vec3d middle = grid.centre[f.cell] + images[f.image];
        const double* a = windows_[f.cell].inverse;
        for (std::size_t q = 0; q < 3; ++q) {
            const Vec3d row{a[3 * q], a[3 * q + 1], a[3 * q + 2]};
            double low = 1e300, high = -1e300;
            for (const std::uint32_t v : grid.corners[host]) {
                const double at = dot(row, grid.nodes[v] - middle);
                low = std::min(low, at), high = std::max(high, at);
            }
            // the cell lies within the hull of its corners, bent faces as well
            if (low > reach_ - touch || high < -reach_ + touch) return false;
        }
        return true;
    }

    const HexCells& cells_;
    const std::vector<HexWindow>& windows_;
    double reach_;
    std::vector<Seen> seen_;
    std::map<Turns, std::uint32_t> image_of_;
    std::size_t first_ = 0;
};

}  // namespace

WindowShape window_shape(Kernel kernel) {
    switch (kernel) {
        case Kernel::phi3:
            return {1.5, 1.4, 2};
        case Kernel::phi4:
            return {2, 1, 2};
        case Kernel::lagrange:
            return {2, 1.5, 3};
        case Kernel::phi2:
            break;
    }
    throw InputError("the kernel phi2 on hexahedra",
                     "its hat may leave a node alone with the nearest cell, too few for the first moments",
                     "Use phi3, phi4 or lagrange");
}

HexNeighbourhood::HexNeighbourhood(const HexCells& cells, Kernel kernel) {
    const WindowShape shape = window_shape(kernel);
    const std::size_t n = cells.field_size();
    std::vector<HexWindow> windows;
    std::vector<double> inverse_size;
    for (std::uint32_t c = 0; c < n; ++c) {
        windows.push_back(window_of(cells, c, shape));
        inverse_size.push_back(1 / std::cbrt(cells.grid().volume[c]));
    }
    Search search(cells, windows, shape.reach);
    host_first_.push_back(0);
    for (std::uint32_t c = 0; c < n; ++c) {
        search.add_candidates(c, host_candidate_);
        host_first_.push_back(static_cast<std::uint32_t>(host_candidate_.size()));
        width_ = std::max(width_, host_candidate_.size() - host_first_[c]);
    }
    window_ = exchange::Buffer<HexWindow>(windows);
    first_ = exchange::Buffer<std::uint32_t>(host_first_);
    candidate_ = exchange::Buffer<HexCandidate>(host_candidate_);
    image_ = exchange::Buffer<Vec3d>(search.images);
    inverse_size_ = exchange::Buffer<double>(inverse_size);
}

}  // namespace hemoflux::coupling
