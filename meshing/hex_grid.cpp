#include "meshing/hex_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "exchange/error.hpp"
#include "meshing/cell_order.hpp"
#include "meshing/hex_geometry.hpp"
#include "meshing/hex_spacing.hpp"
#include "meshing/hex_topology.hpp"

namespace hemoflux::meshing {
namespace {

constexpr std::uint32_t none = HexTopology::none;

Quad quad(const HexMesh& mesh, std::uint32_t side) {
    const auto n = side_nodes(mesh, side);
    return {mesh.nodes[n[0]], mesh.nodes[n[1]], mesh.nodes[n[2]], mesh.nodes[n[3]]};
}

std::array<Quad, 6> cell_quads(const HexMesh& mesh, std::size_t cell) {
    std::array<Quad, 6> quads;
    for (std::uint32_t k = 0; k < 6; ++k) quads[k] = quad(mesh, static_cast<std::uint32_t>(6 * cell) + k);
    return quads;
}

/// Builds a grid from the sides of a mesh, in the order of its member functions.
class Assembly {
  public:
    Assembly(const HexMesh& mesh, const HexTopology& topology) : mesh_(mesh), topology_(topology) {}

    HexGrid run() {
        number_cells();
        measure_cells();
        list_faces();
        measure_faces();
        list_faces_of_cells();
        return std::move(grid_);
    }

  private:
    void number_cells() {
        Graph graph;
        graph.first.assign(mesh_.cells.size() + 1, 0);
        for (const std::uint32_t b : topology_.partner) graph.to.push_back(b == none ? none : b / 6);
        std::vector<std::uint32_t> packed;
        for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
            for (std::size_t k = 6 * c; k < 6 * c + 6; ++k)
                if (graph.to[k] != none && graph.to[k] != c) packed.push_back(graph.to[k]);
            graph.first[c + 1] = static_cast<std::uint32_t>(packed.size());
        }
        graph.to = std::move(packed);
        const std::vector<std::uint32_t> order = reverse_cuthill_mckee(graph);
        grid_.original.assign(order.begin(), order.end());
        number_.resize(order.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) number_[order[i]] = i;
    }

    void measure_cells() {
        grid_.nodes = mesh_.nodes;
        for (const std::size_t old : grid_.original) {
            grid_.corners.push_back(mesh_.cells[old]);
            const std::array<Quad, 6> quads = cell_quads(mesh_, old);
            const Solid solid = hexahedron(quads);
            if (!(solid.volume > 0))
                throw InputError(
                    fmt::format("{} has the volume {:.4g}", describe_cell(mesh_, old), solid.volume),
                    solid.volume == 0
                        ? "a cell without volume cannot hold fluid"
                        : "it is turned inside out: its nodes are not in the order of VTK_HEXAHEDRON, "
                          "or its faces cross",
                    "Repair this cell in the program that made the mesh");
            grid_.volume.push_back(solid.volume);
            grid_.centre.push_back(solid.centre);
            grid_.aspect.push_back(aspect_of(static_cast<std::uint32_t>(6 * old), quads));
        }
    }

    [[nodiscard]] bool one_cell_everywhere(std::uint32_t first_side) const {
        return topology_.one_cell_thick(first_side) && topology_.one_cell_thick(first_side + 2) &&
               topology_.one_cell_thick(first_side + 4);
    }

    /// Extents are V / A, so that their ratio is that of the areas.
    [[nodiscard]] double aspect_of(std::uint32_t first_side, const std::array<Quad, 6>& quads) const {
        const bool all = one_cell_everywhere(first_side);
        double smallest = std::numeric_limits<double>::infinity(), largest = 0;
        for (std::uint32_t k = 0; k < 6; k += 2) {
            if (!all && topology_.one_cell_thick(first_side + k)) continue;
            const double area = norm(quad_area(quads[k])) + norm(quad_area(quads[k + 1]));
            smallest = std::min(smallest, area);
            largest = std::max(largest, area);
        }
        return largest / smallest;
    }

    [[nodiscard]] std::uint32_t cell_of(std::uint32_t side) const { return number_[side / 6]; }

    /// left_side_, right_side_, left, right, shift and the patches.
    void list_faces() {
        std::vector<HexTopology::Link> links = topology_.links;
        for (HexTopology::Link& link : links)
            if (link.pair == none && cell_of(link.b) < cell_of(link.a)) std::swap(link.a, link.b);
        const auto key = [this](const HexTopology::Link& link) {
            const std::uint32_t a = cell_of(link.a), b = cell_of(link.b);
            return std::tuple(std::min(a, b), std::max(a, b), link.a, link.b);
        };
        std::sort(links.begin(), links.end(),
                  [&key](const HexTopology::Link& a, const HexTopology::Link& b) { return key(a) < key(b); });
        for (const HexTopology::Link& link : links) {
            const bool turned = cell_of(link.b) < cell_of(link.a);  // only across a periodic pair
            add_face(turned ? link.b : link.a, turned ? link.a : link.b);
            if (topology_.translation.empty()) continue;
            Vec3d shift{0, 0, 0};
            if (link.pair != none) shift = topology_.translation[link.pair];
            grid_.shift.push_back(turned ? shift : -shift);
        }
        for (const HexTopology::Patch& patch : topology_.patches) {
            std::vector<std::uint32_t> sides = patch.sides;
            std::sort(sides.begin(), sides.end(), [this](std::uint32_t a, std::uint32_t b) {
                return std::pair(cell_of(a), a) < std::pair(cell_of(b), b);
            });
            grid_.patches.push_back({patch.name, grid_.left.size(), sides.size()});
            for (const std::uint32_t side : sides) {
                add_face(side, none);
                if (!topology_.translation.empty()) grid_.shift.push_back({0, 0, 0});
            }
        }
    }

    void add_face(std::uint32_t left_side, std::uint32_t right_side) {
        const auto ghost = static_cast<std::uint32_t>(mesh_.cells.size() + left_side_.size() - links());
        left_side_.push_back(left_side);
        right_side_.push_back(right_side);
        grid_.left.push_back(cell_of(left_side));
        grid_.right.push_back(right_side == none ? ghost : cell_of(right_side));
    }

    [[nodiscard]] std::size_t links() const { return topology_.links.size(); }

    void measure_faces() {
        for (std::size_t f = 0; f < left_side_.size(); ++f) {
            const Quad corners = quad(mesh_, left_side_[f]);
            const Vec3d area = quad_area(corners);
            if (!(norm(area) > 0))
                throw InputError(
                    fmt::format("a face of {} has no area", describe_cell(mesh_, left_side_[f] / 6)),
                    "its direction is not defined", "Repair this cell in the program that made the mesh");
            grid_.area.push_back(area);
            grid_.face_centre.push_back(quad_centre(corners));
            const FaceFrame frame = face_frame((1 / norm(area)) * area);
            double delta = delta_in(left_side_[f], grid_.face_centre[f], frame, -1);
            if (right_side_[f] != none)
                delta = std::min(
                    delta, delta_in(right_side_[f], quad_centre(quad(mesh_, right_side_[f])), frame, 1));
            grid_.delta.push_back(delta);
        }
    }

    [[nodiscard]] double delta_in(std::uint32_t side, const Vec3d& centre, const FaceFrame& frame,
                                  int inward) const {
        std::array<Limit, 6> limits;
        std::size_t count = 0;
        const std::uint32_t first = side - side % 6;
        const bool single = one_cell_everywhere(first);
        for (std::uint32_t g = first; g < first + 6; ++g) {
            if (g == side || (topology_.one_cell_thick(g) && !single)) continue;
            const Quad corners = quad(mesh_, g);
            const Vec3d area = quad_area(corners);
            const double size = norm(area);
            if (size > 0) limits[count++] = {quad_centre(corners), (1 / size) * area};
        }
        return largest_delta(centre, frame, inward, grid_.centre[cell_of(side)], {limits.data(), count});
    }

    void list_faces_of_cells() {
        const std::size_t cells = grid_.cells();
        grid_.first_face.resize(cells + 1);
        for (std::size_t c = 0; c <= cells; ++c) grid_.first_face[c] = static_cast<std::uint32_t>(6 * c);
        grid_.face.resize(6 * cells);
        grid_.outward.resize(6 * cells);
        grid_.side.resize(6 * cells);
        std::vector<std::uint32_t> next(grid_.first_face.begin(), grid_.first_face.end() - 1);
        const auto add = [&](std::uint32_t cell, std::size_t face, signed char sign, std::uint32_t side) {
            grid_.side[next[cell]] = static_cast<unsigned char>(side % 6);
            grid_.face[next[cell]] = static_cast<std::uint32_t>(face);
            grid_.outward[next[cell]++] = sign;
        };
        for (std::size_t f = 0; f < left_side_.size(); ++f) {
            add(grid_.left[f], f, 1, left_side_[f]);
            if (right_side_[f] != none) add(grid_.right[f], f, -1, right_side_[f]);
        }
    }

    const HexMesh& mesh_;
    const HexTopology& topology_;
    HexGrid grid_;
    std::vector<std::uint32_t> number_, left_side_, right_side_;
};

}  // namespace

HexGrid make_hex_grid(const HexMesh& mesh, const std::vector<PeriodicPair>& periodic) {
    return Assembly(mesh, connect(mesh, periodic)).run();
}

}  // namespace hemoflux::meshing
