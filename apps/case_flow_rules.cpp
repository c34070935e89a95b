// Rules between keys that concern the flow: patches, forces, exact solutions, sweeps.
#include <fmt/format.h>

#include <algorithm>

#include "apps/case_rules.hpp"
#include "apps/schema.hpp"
#include "apps/toml_input.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& why,
                         const std::string& remedy) {
    throw InputError(fmt::format("{}: {}", name, what), why, remedy);
}

/// A key that a word of another key asks for.
struct Needed {
    const char *key, *word, *needs, *example;
};

void check_patches(const Section& top, const std::string& name) {
    const auto boundary = top.table("boundary");
    if (!boundary) return;
    const bool mesh = top.table("grid") && top.table("grid")->table("mesh");
    constexpr Needed needed[] = {
        {"velocity", "parabolic", "speed", "speed = \"0.45 m/s\""},
        {"velocity", "expression", "velocity_expression", "velocity_expression = [\"0.1*y\", \"0\", \"0\"]"},
        {"density", "gradient", "pressure_gradient", "pressure_gradient = \"10 Pa/m\""},
        {"density", "expression", "pressure_expression", "pressure_expression = \"2*cos(2*_pi*t)\""}};
    for (const std::string& side : boundary->keys()) {
        const auto patch = boundary->table(side);
        if (!patch) continue;
        if (patch->has("velocity") == patch->has("periodic"))
            refuse(name, fmt::format("boundary.\"{}\"", side),
                   patch->has("periodic") ? "it is periodic and has a velocity" : "its velocity is not given",
                   "Give velocity, or of a mesh periodic = \"OTHER PATCH\"");
        if (patch->has("periodic") && (!mesh || side.size() == 1))
            refuse(name, fmt::format("boundary.\"{}\".periodic", side),
                   "the sides of an axis have their opposite sides", "Write x = \"periodic\"");
        if (mesh && patch->text("velocity") == "parabolic")
            refuse(name, fmt::format("boundary.\"{}\" has velocity = \"parabolic\"", side),
                   "it is known for the sides of a box only", "Write the profile as velocity_expression");
        for (const Needed& n : needed) {
            const bool asked = patch->text(n.key) == n.word;
            if (asked && !patch->has(n.needs))
                refuse(name, fmt::format("boundary.\"{}\" has {} = \"{}\"", side, n.key, n.word),
                       fmt::format("key \"{}\" is missing", n.needs), fmt::format("Add {}", n.example));
            if (!asked && patch->has(n.needs))
                refuse(name, fmt::format("boundary.\"{}\" has {}", side, n.needs),
                       fmt::format("it has no effect without {} = \"{}\"", n.key, n.word),
                       fmt::format("Write {} = \"{}\", or remove it", n.key, n.word));
        }
    }
}

void check_force(const Section& top, const std::string& name) {
    const auto force = top.table("body_force");
    if (!force) return;
    if (!force->has("acceleration") && !force->has("amplitude"))
        refuse(name, "[body_force] is empty", "there is no force",
               "Give acceleration, or amplitude and period");
    if (force->has("amplitude") != force->has("period"))
        refuse(name, "[body_force] has only one of amplitude and period", "an oscillating force needs both",
               "Add the other");
}

/// A uniform start and its velocity belong together.
void check_initial_velocity(const Section& top, const std::string& name) {
    const auto fluid = top.table("fluid");
    if (!fluid) return;
    const bool uniform = fluid->text("initial") == "uniform";
    if (uniform == fluid->has("initial_velocity")) return;
    refuse(
        name,
        uniform ? "fluid.initial is \"uniform\" without initial_velocity" : "fluid.initial_velocity is given",
        uniform ? "there is no velocity" : "it is of fluid.initial = \"uniform\" only",
        uniform ? "Add initial_velocity" : "Set fluid.initial to \"uniform\", or leave it out");
}

void check_analytical(const Section& top, const std::string& name) {
    const auto exact = top.table("analytical");
    const auto fluid = top.table("fluid");
    if (!exact) {
        if (fluid && fluid->text("initial") == "analytical")
            refuse(name, "fluid.initial is \"analytical\" without [analytical]", "no solution is named",
                   "Add [analytical] with a solution");
        return;
    }
    if (top.text("kind") != "fluid")
        refuse(name, "[analytical] in a case that is not of kind \"fluid\"",
               "the solutions are of a flow alone", "Write kind = \"fluid\", or remove it");
    const std::string solution = exact->text("solution");
    if ((solution == "womersley") == exact->has("speed"))
        refuse(name, fmt::format("analytical.solution = \"{}\"", solution),
               exact->has("speed") ? "its speed follows from the force" : "its speed is not given",
               exact->has("speed") ? "Remove speed" : "Add speed = \"1 mm/s\"");
    const std::vector<double> times = exact->numbers("times");
    const bool steady = solution == "couette" || solution == "poiseuille";
    if (steady && !times.empty())
        refuse(name, fmt::format("analytical.times with the steady solution \"{}\"", solution),
               "it has no clock", "Remove times, and give time.duration");
    if (!std::is_sorted(times.begin(), times.end()))
        refuse(name, "analytical.times are not ascending", "the last one ends the run", "Sort them");
}

void check_mesh(const Section& top, const std::string& name) {
    const auto mesh = top.table("grid") ? top.table("grid")->table("mesh") : std::nullopt;
    if (!mesh) return;
    if (top.text("kind") == "membrane")
        refuse(name, "grid.mesh in a case of kind \"membrane\"", "it has no fluid", "Remove [grid]");
    if (top.table("packing"))
        refuse(name, "[packing] with grid.mesh", "cells are packed into boxes",
               "List the cells, or give the grid length and cells");
    if (const auto contact = top.table("contact"); contact && contact->flag("walls"))
        refuse(name, "contact.walls = true with grid.mesh", "the walls that push are those of a box",
               "Set contact.walls = false");
    if (const auto coupling = top.table("coupling"); coupling && coupling->text("kernel") == "phi2")
        refuse(name, "coupling.kernel = \"phi2\" with grid.mesh",
               "on hexahedra its hat reaches too few cells for the first moments",
               "Use lagrange, phi3 or phi4");
    if (top.table("analytical"))
        refuse(name, "[analytical] with grid.mesh", "the solutions are compared on boxes",
               "Remove one of them");
    const bool file = mesh->text("kind") == "file";
    if (file != mesh->has("file") || (!file && !mesh->has("size")))
        refuse(name, fmt::format("grid.mesh has kind = \"{}\"", mesh->text("kind")),
               file ? "no file is given" : "a generator needs size, and no file",
               file ? "Add file" : "Give size");
}

void check_steady(const Section& top, const std::string& name) {
    const auto steady = top.table("steady");
    const bool gamma = top.table("numerics")->maybe("gamma").has_value();
    if (!steady) {
        if (!gamma)
            refuse(name, "numerics.gamma = \"auto\" without [steady]",
                   "preconditioning changes flows that are not steady", "Write gamma = 1, or add [steady]");
        return;
    }
    if (top.text("kind") != "fluid")
        refuse(name, "[steady] in a case that is not of kind \"fluid\"", "cells have no steady state",
               "Remove it");
    const auto exact = top.table("analytical");
    const std::string solution = exact ? exact->text("solution") : "";
    if (solution == "taylor-green" || solution == "womersley")
        refuse(name, fmt::format("[steady] with analytical.solution = \"{}\"", solution), "it is not steady",
               "Remove [steady]");
    if (const auto force = top.table("body_force"); force && force->has("amplitude"))
        refuse(name, "[steady] with an oscillating force", "there is no steady state", "Remove [steady]");
}

/// Keys of the capillary scaling, which only cells need, and those that only a flow alone reads.
void check_numerics(const Section& top, const std::string& name) {
    if (top.text("kind") == "coupled") {
        // on a mesh it stands for the speed of velocity expressions
        if (top.table("numerics")->maybe("speed") && !(top.table("grid") && top.table("grid")->table("mesh")))
            refuse(name, "numerics.speed in a case of kind \"coupled\"",
                   "it would have no effect: the Mach number is that of the sheared walls, or of the "
                   "channel's flow",
                   "Remove it, or give numerics.mach");
        if (const auto time = top.table("time"); time && time->has("steady"))
            refuse(name, "time.steady in a case of kind \"coupled\"",
                   "it would have no effect: a run with cells lasts as long as it says", "Remove it");
    }
    if (top.text("kind") != "fluid") return;
    for (const char* key : {"lattice_viscosity", "reynolds"})
        if (top.table("numerics")->maybe(key))
            refuse(name, fmt::format("numerics.{} in a case of kind \"fluid\"", key),
                   "it would have no effect: the viscosity is the case's, and numerics.mach sets the lattice "
                   "speed",
                   "Remove it, or give numerics.mach");
}

void check_sweep(const Section& top, const std::string& name) {
    const auto sweep = top.table("sweep");
    if (!sweep) return;
    const auto values = sweep->table("values");
    std::size_t length = 0;
    if (values->keys().empty())
        refuse(name, "sweep.values is empty", "nothing varies",
               "Add \"grid.cells\" = [[20, 20, 1], [40, 40, 1]]");
    for (const std::string& key : values->keys()) {
        const std::size_t count = values->count(key);
        if (count == 0)
            refuse(name, fmt::format("sweep.values.\"{}\" is empty", key), "there is nothing to run",
                   "List values");
        if (sweep->text("combine") == "together" && length > 0 && count != length)
            refuse(name,
                   fmt::format("sweep.values.\"{}\" has {} values, another list {}", key, count, length),
                   "combined together, the lists go side by side",
                   "Give lists of equal length, or combine = \"product\"");
        length = count;
    }
}

}  // namespace

void check_flow_rules(const toml::table& resolved, const std::string& name) {
    check_time_rules(resolved, name);
    const Section top(case_schema(), resolved);
    check_patches(top, name);
    check_force(top, name);
    check_analytical(top, name);
    check_initial_velocity(top, name);
    check_numerics(top, name);
    check_mesh(top, name);
    check_steady(top, name);
    check_sweep(top, name);
}

}  // namespace hemoflux::apps
