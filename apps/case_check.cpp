#include "apps/case_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/cell_builder.hpp"
#include "apps/cell_file.hpp"
#include "apps/cell_surface.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// The surface of cell number `index` must lie inside the box; periodic sides may be crossed.
void check_inside(const Case& c, std::size_t index, const meshing::SurfaceMesh& surface,
                  const meshing::RectilinearGrid& grid) {
    const CellInput& cell = c.cells[index];
    for (std::size_t d = 0; d < 3; ++d) {
        const meshing::Axis& axis = grid.axes[d];
        const char name = "xyz"[d];
        if (!(cell.position[d] >= axis.lower() && cell.position[d] <= axis.upper())) {
            throw InputError(fmt::format("cell.{} is outside the box", index),
                             fmt::format("its centre has {} = {} um, the box reaches from {} to {} um", name,
                                         cell.position[d], axis.lower(), axis.upper()),
                             "Change its position, or grid.length and grid.origin");
        }
        if (c.periodic(d)) {
            continue;
        }
        const auto less = [d](const Vec3d& a, const Vec3d& b) { return component(a, d) < component(b, d); };
        const auto [low, high] = std::minmax_element(surface.vertices.begin(), surface.vertices.end(), less);
        const double lower = component(*low, d);
        const double upper = component(*high, d);
        if (!(lower > axis.lower() && upper < axis.upper())) {
            throw InputError(
                fmt::format("cell.{} overlaps the side \"{}{}\"", index, name,
                            lower > axis.lower() ? '+' : '-'),
                fmt::format("it reaches from {0} = {1:.4g} to {2:.4g} um, the box from {3:.4g} to {4:.4g} um",
                            name, lower, upper, axis.lower(), axis.upper()),
                "Move the cell, enlarge the box, or make this axis periodic");
        }
    }
}

/// A warning where the nodes of cell number `index` are too far apart for the fluid's grid, else empty.
std::string sparse_nodes(std::size_t index, const meshing::SurfaceMesh& surface,
                         const meshing::RectilinearGrid& grid) {
    constexpr double most = 2.5;
    const double edge = std::sqrt(4 / std::sqrt(3.0) * meshing::area(surface) /
                                  static_cast<double>(surface.triangles.size()));
    if (edge < most * grid.smallest()) return "";
    return fmt::format(
        "cell.{}: its nodes are {:.2g} um apart, {:.1f} of the smallest fluid cells: the membrane crumples, "
        "and fluid "
        "passes between them. Use more nodes, or wider fluid cells",
        index, edge, edge / grid.smallest());
}

}  // namespace

std::vector<std::string> check_case(const Case& c) {
    std::vector<std::string> warnings;
    const bool flow = c.kind != CaseKind::membrane && !c.mesh;
    const meshing::RectilinearGrid grid = flow ? make_grid(c.grid) : meshing::RectilinearGrid{};
    const std::size_t different = c.packing ? 1 : c.cells.size();
    for (std::size_t i = 0; i < different; ++i) {
        meshing::SurfaceMesh surface = start_shape(c.cells[i]);
        if (!c.cells[i].reference_file.empty()) {
            CellInput reference = c.cells[i];
            reference.shape = CellShape::file;
            reference.file = reference.reference_file;
            if (start_shape(reference).triangles != surface.triangles) {
                throw InputError(fmt::format("cell.{}.reference_file = {}", i, reference.file),
                                 "its triangles are not those of the cell's mesh",
                                 "Give a surface with the same triangles, vertices in the same order");
            }
        }
        if (takes_stored_reference(c.cells[i])) {
            static_cast<void>(read_reference(c.cells[i].file, membrane::Topology(surface)));
        }
        if (!flow) {
            continue;
        }
        if (!c.packing) {
            place(surface, c.cells[i].axis, c.cells[i].position);
            check_inside(c, i, surface, grid);
        }
        if (std::string text = sparse_nodes(i, surface, grid); !text.empty())
            warnings.push_back(std::move(text));
        const ThinnestPart thin = thinnest_part(surface, grid);
        if (thin.grid_cells < 1) {
            warnings.push_back(fmt::format(
                "cell.{}: only {:.2g} grid cells across its thinnest part ({:.3g} um at x, y, z = {:.3g}, "
                "{:.3g}, "
                "{:.3g} um): inside and outside are not told apart there. Use more cells, or a plateau axis",
                i, thin.grid_cells, thin.thickness, thin.where.x, thin.where.y, thin.where.z));
        }
    }
    return warnings;
}

}  // namespace hemoflux::apps
