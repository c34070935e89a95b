#include "apps/case_rigid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "apps/choice.hpp"
#include "apps/schema.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

double length_of(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

std::array<double, 3> unit(std::array<double, 3> v) {
    const double length = length_of(v);
    for (double& c : v) c /= length;
    return v;
}

std::array<double, 3> vector_or_zero(const Section& in, const char* key) {
    return in.has(key) ? in.vector(key) : std::array<double, 3>{};
}

}  // namespace

RigidInput read_rigid(const Section& in) {
    RigidInput b;
    b.name = in.text("name");
    b.shape = chosen<RigidShape>(in.text("shape"), {"sphere", "spheroid", "cylinder"});
    b.file = in.text("file");
    b.diameter = in.maybe("diameter").value_or(0);
    b.aspect = in.number("aspect");
    b.length = in.maybe("length").value_or(0);
    b.nodes = in.maybe("nodes");
    b.position = in.vector("position");
    b.axis = unit(in.vector("axis"));
    b.motion = chosen<RigidMotion>(in.text("motion"), {"prescribed", "torque-free", "free"});
    b.velocity = in.vector("velocity");
    b.angular_velocity = in.vector("angular_velocity");
    b.density = in.maybe("density");
    b.force = vector_or_zero(in, "force");
    b.torque = vector_or_zero(in, "torque");
    b.method = chosen<RigidMethod>(in.text("method"), {"direct", "feedback"});
    b.stiffness = in.maybe("stiffness");
    b.iterations = in.integer("iterations");
    b.retraction = in.maybe("retraction");
    b.speed = in.maybe("speed");
    b.reference_area = in.maybe("reference_area");
    b.drag_direction = unit(in.vector("drag_direction"));
    b.lift_direction = unit(in.vector("lift_direction"));
    return b;
}

void check_rigid_rules(const Section& top, const std::string& name) {
    const std::vector<Section> bodies = top.tables("body");
    if (bodies.empty()) return;
    const auto refuse = [&](const std::string& what, const std::string& why, const std::string& remedy) {
        throw InputError(fmt::format("{}: {}", name, what), why, remedy);
    };
    if (top.text("kind") == "membrane")
        refuse("a [[body]] in a case of kind \"membrane\"", "there is no fluid around it",
               "Write kind = \"fluid\" or \"coupled\", or remove the body");
    if (const auto steady = top.table("steady"); steady && steady->text("method") != "implicit")
        refuse("a [[body]] with steady.method = \"local-steps\"",
               "the forces that hold it are unknowns, which only the implicit method solves for",
               "Leave steady.method out");
    if (const auto grid = top.table("grid"); top.table("steady") && grid && grid->table("mesh"))
        refuse("a [[body]] with [steady] and grid.mesh", "the implicit method holds bodies in boxes of cells",
               "Replace [steady] by [time], with steady = 1e-6 to end the run in the steady state");
    if (const auto coupling = top.table("coupling"); coupling && coupling->flag("recentre"))
        refuse("a [[body]] with coupling.recentre", "cells would be moved and bodies not",
               "Set coupling.recentre = false");
    if (top.table("numerics")->text("precision") == "single")
        refuse("a [[body]] with numerics.precision = \"single\"", "bodies exert a force, which needs double",
               "Leave numerics.precision out");
    std::set<std::string> names;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Section& b = bodies[i];
        const std::string what = fmt::format("body.{}", i);
        if (!b.text("name").empty() && !names.insert(b.text("name")).second)
            refuse(fmt::format("{}.name \"{}\"", what, b.text("name")), "another body has it", "Rename one");
        const bool cylinder = b.text("shape") == "cylinder" && !b.has("file");
        if (b.has("file") == b.has("diameter"))
            refuse(what, b.has("file") ? "file and diameter are both given" : "it has no size",
                   "Give diameter, or file");
        if (cylinder != b.has("length"))
            refuse(fmt::format("{}.length", what),
                   cylinder ? "a cylinder has one, and none is given" : "only a cylinder has one",
                   cylinder ? "Add length" : "Remove it");
        for (const char* key : {"axis", "drag_direction", "lift_direction"})
            if (!(length_of(b.vector(key)) > 0))
                refuse(fmt::format("{}.{} is zero", what, key), "it gives no direction",
                       "Write for example [1, 0, 0]");
        if (cylinder && b.text("motion") != "prescribed")
            refuse(fmt::format("{}.motion = \"{}\"", what, b.text("motion")),
                   "a cylinder is open at its ends and has no inertia", "Write motion = \"prescribed\"");
        if (top.table("steady") && b.text("method") != "direct")
            refuse(fmt::format("{}.method = \"feedback\" with [steady]", what),
                   "the forces of a steady flow are found exactly, without springs",
                   "Leave method out, or replace [steady] by [time]");
        if (b.has("stiffness") && b.maybe("stiffness") && b.text("method") == "direct")
            refuse(fmt::format("{}.stiffness with method = \"direct\"", what), "it would have no effect",
                   "Remove it, or write method = \"feedback\"");
    }
}

}  // namespace hemoflux::apps
