#include "apps/case_suspension.hpp"

#include <fmt/format.h>

#include <cmath>

#include "apps/cell_surface.hpp"
#include "apps/flow_setup.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

constexpr double um_per_m = 1e6;

double box_volume(const meshing::RectilinearGrid& grid) {
    return grid.axes[0].length() * grid.axes[1].length() * grid.axes[2].length();
}

bool at_rest(const PatchInput& side) { return side.velocity == VelocityCondition::no_slip; }

/// The flow in a mesh of kind pipe whose ends are glued.
std::optional<fluid::DuctFlow> in_round_pipe(const Case& c, std::size_t axis, double drive) {
    if (c.mesh->kind != "pipe" || axis != 0) return {};
    const auto wall = c.patches.find("wall"), inlet = c.patches.find("inlet");
    if (wall == c.patches.end() || inlet == c.patches.end()) return {};
    if (!at_rest(wall->second) || !inlet->second.periodic()) return {};
    return fluid::DuctFlow::round(axis, drive, c.mesh->size / 2);
}

}  // namespace

ContactInput read_contact(const Section& in) {
    return {in.number("pressure"),         in.maybe("range"),           in.number("adhesion"),
            in.maybe("adhesion_distance"), in.number("adhesion_scale"), in.flag("walls")};
}

PackingInput read_packing(const Section& in) {
    return {in.number("haematocrit"), in.integer("seed"), in.number("gap")};
}

std::optional<fluid::DuctFlow> undisturbed_flow(const Case& c) {
    const Triple& a = c.body_force.acceleration;
    std::size_t axis = 0, driven = 0;
    for (std::size_t q = 0; q < 3; ++q)
        if (a[q] != 0) axis = q, ++driven;
    if (driven != 1 || c.body_force.period > 0) return {};
    const double nu = c.fluid.viscosity / c.fluid.density * um_per_m * um_per_m;  // um^2/s
    const double drive = a[axis] * um_per_m / nu;
    if (c.mesh) return in_round_pipe(c, axis, drive);
    if (!c.periodic(axis)) return {};
    std::array<double, 3> lower{}, length{};
    std::array<bool, 3> periodic{};
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    std::size_t walls = 0;
    for (std::size_t q = 0; q < 3; ++q) {
        lower[q] = grid.axes[q].lower();
        length[q] = grid.axes[q].length();
        periodic[q] = c.periodic(q);
        if (periodic[q]) continue;
        if (!at_rest(c.boundary[q][0]) || !at_rest(c.boundary[q][1])) return {};
        ++walls;
    }
    if (walls == 0) return {};
    return fluid::DuctFlow(axis, drive, lower, length, periodic);
}

double flow_reach(const Case& c, double sheared) {
    const auto flow = undisturbed_flow(c);
    return flow ? flow->largest_speed() / c.shear_rate.value_or(flow->wall_rate()) : sheared;
}

std::size_t packed_cells(const Case& c) {
    const double volume = rest_state(c.cells.front()).volume;
    const double box = box_volume(make_grid(c.grid));
    const auto count = static_cast<std::size_t>(std::lround(c.packing->haematocrit * box / volume));
    if (count == 0)
        throw InputError(fmt::format("packing.haematocrit {}", c.packing->haematocrit),
                         fmt::format("a box of {:.4g} um^3 holds {:.2g} cells of {:.4g} um^3", box,
                                     c.packing->haematocrit * box / volume, volume),
                         "Raise it, or enlarge the box");
    return count;
}

void complete_suspension(Case& c, bool initial_chosen) {
    if (c.kind == CaseKind::coupled && c.body_force.acceleration != Triple{} && !c.shear_rate) {
        const auto flow = undisturbed_flow(c);
        if (!flow)
            throw InputError(
                "[body_force] in a coupled case without [shear]",
                "the clock of the run is the wall shear rate of the undisturbed flow, which is "
                "known for a constant "
                "force along one periodic axis between sides with velocity = \"no-slip\", or along a "
                "pipe of grid.mesh whose inlet and outlet are periodic",
                "Give such a force and such sides, or [shear] with the rate to count strain by");
        c.shear_rate = flow->wall_rate();
        if (!initial_chosen) c.fluid.initial = InitialFlow::channel;
    }
    if (c.fluid.initial == InitialFlow::channel && !undisturbed_flow(c))
        throw InputError("fluid.initial = \"channel\"",
                         "there is no constant [body_force] along one periodic axis between no-slip sides",
                         "Leave fluid.initial out");
    if (!c.packing) return;
    if (c.cells.size() != 1)
        throw InputError(fmt::format("[packing] and {} tables [[cell]]", c.cells.size()),
                         "packed cells are all alike",
                         "Keep one [[cell]]; its position and axis have no effect");
    c.cells.resize(packed_cells(c), c.cells.front());
}

}  // namespace hemoflux::apps
