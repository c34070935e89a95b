#include "coupling/hex_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

constexpr int longest_walk = 1000000;

/// Number of the period that equals `shift` or its opposite, with the sign; added where it is new.
int turn_of(std::vector<Vec3d>& periods, const Vec3d& shift) {
    const double tolerance = 1e-6 * norm(shift);
    for (std::size_t p = 0; p < periods.size(); ++p)
        for (const int sign : {1, -1})
            if (norm(shift - double(sign) * periods[p]) < tolerance) return sign * static_cast<int>(p + 1);
    if (periods.size() == hex_periods)
        throw InputError("a mesh with more than three different periodic translations",
                         "a space repeats in three directions at most",
                         "Check the pairs of periodic patches");
    periods.push_back(shift);
    return static_cast<int>(periods.size());
}

}  // namespace

HexCells::HexCells(const meshing::HexGrid& grid)
    : grid_(grid), nearest_(grid.centre), centre_(grid.centre), node_(grid.nodes) {
    find_steps();
    find_sides();
    std::vector<std::uint32_t> corners;
    for (const auto& c : grid.corners) corners.insert(corners.end(), c.begin(), c.end());
    std::vector<double> inverse;
    for (const double v : grid.volume) inverse.push_back(1 / v);
    corner_ = exchange::Buffer<std::uint32_t>(corners);
    step_ = exchange::Buffer<HexStep>(steps_);
    inverse_volume_ = exchange::Buffer<double>(inverse);
    host_walk_.cells = grid.cells();
    for (std::size_t p = 0; p < periods_.size(); ++p) host_walk_.period[p] = periods_[p];
    walk_ = host_walk_;
    host_walk_.centre = grid_.centre.data();
    host_walk_.node = grid_.nodes.data();
    host_walk_.corner = grid_.corners.front().data();
    host_walk_.step = steps_.data();
    walk_.centre = centre_.data();
    walk_.node = node_.data();
    walk_.corner = corner_.data();
    walk_.step = step_.data();
    refuse_hidden_faces();
}

void HexCells::find_steps() {
    steps_.resize(hex_faces_count * grid_.cells());
    for (std::size_t cell = 0; cell < grid_.cells(); ++cell)
        for (std::size_t s = grid_.first_face[cell]; s < grid_.first_face[cell + 1]; ++s) {
            const std::uint32_t f = grid_.face[s];
            if (f >= grid_.interior_faces()) continue;
            HexStep& step = steps_[hex_faces_count * cell + grid_.side[s]];
            const bool own = grid_.outward[s] > 0;
            step.cell = own ? grid_.right[f] : grid_.left[f];
            if (grid_.shift.empty() || !(norm(grid_.shift[f]) > 0)) continue;
            const int turn = turn_of(periods_, grid_.shift[f]);
            step.turn = own ? turn : -turn;
        }
}

void HexCells::find_sides() {
    smallest_ = 1e300;
    for (const auto& corner : grid_.corners) {
        const auto middle = [&](std::size_t side) {
            Vec3d sum{0, 0, 0};
            for (const int v : meshing::hex_faces[side])
                sum += grid_.nodes[corner[static_cast<std::size_t>(v)]];
            return 0.25 * sum;
        };
        auto& sides = sides_.emplace_back();
        for (std::size_t q = 0; q < 3; ++q) {
            sides[q] = middle(2 * q + 1) - middle(2 * q);
            smallest_ = std::min(smallest_, norm(sides[q]));
        }
    }
}

void HexCells::refuse_hidden_faces() const {
    for (std::uint32_t cell = 0; cell < grid_.cells(); ++cell) {
        double smallest = 1e300;
        host_walk_.exit(cell, grid_.centre[cell], &smallest);
        if (!(smallest > 0))
            throw InputError(
                fmt::format("cell {} of the mesh", grid_.original[cell]),
                "it is so distorted that its centre does not see all of its faces, so the place of "
                "what is immersed cannot be found there",
                "Improve the mesh there");
    }
}

NodeBox HexCells::box() const {
    Vec3d low = grid_.nodes.front(), high = low;
    for (const Vec3d& r : grid_.nodes) {
        low = {std::min(low.x, r.x), std::min(low.y, r.y), std::min(low.z, r.z)};
        high = {std::max(high.x, r.x), std::max(high.y, r.y), std::max(high.z, r.z)};
    }
    NodeBox box{{low.x, low.y, low.z}, {high.x - low.x, high.y - low.y, high.z - low.z}, {}};
    for (const Vec3d& period : periods_) {
        const double along[3] = {std::abs(period.x), std::abs(period.y), std::abs(period.z)};
        const std::size_t a = along[0] > along[1]   ? (along[0] > along[2] ? 0 : 2)
                              : along[1] > along[2] ? 1
                                                    : 2;
        if (std::abs(along[a] - box.length[a]) > 1e-6 * box.length[a] || norm(period) > along[a] * (1 + 1e-6))
            throw InputError(
                fmt::format("a mesh that repeats by ({:.4g}, {:.4g}, {:.4g}) um", period.x, period.y,
                            period.z),
                "distances between membranes are taken in a box that repeats along its axes by its lengths",
                "Turn the mesh, or let it repeat along an axis");
        box.periodic[a] = true;
        box.length[a] = along[a];
    }
    return box;
}

bool HexCells::contains(const Vec3d& at) const {
    HexPlace place{nearest(at), {0, 0, 0}};
    return host_walk_.walk(at, place, longest_walk);
}

double HexCells::cell_volume(const Vec3d& at) const {
    HexPlace place{nearest(at), {0, 0, 0}};
    host_walk_.walk(at, place, longest_walk);
    return grid_.volume[place.cell];
}

double HexCells::width(const Vec3d& at, const Vec3d& n) const {
    HexPlace place{nearest(at), {0, 0, 0}};
    host_walk_.walk(at, place, longest_walk);
    const auto& s = sides_[place.cell];
    return norm(Vec3d{dot(n, s[0]), dot(n, s[1]), dot(n, s[2])});
}

const HexNeighbourhood& HexCells::neighbourhood(Kernel kernel) const {
    const auto known = neighbourhoods_.find(kernel);
    if (known != neighbourhoods_.end()) return known->second;
    return neighbourhoods_.emplace(kernel, HexNeighbourhood(*this, kernel)).first->second;
}

}  // namespace hemoflux::coupling
