#include "apps/rigid_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/rigid_surface.hpp"
#include "exchange/error.hpp"
#include "fluid/probe.hpp"

namespace hemoflux::apps {
namespace {

Vec3d vec(const Triple& v) { return {v[0], v[1], v[2]}; }

coupling::BodyFreedom freedom_of(RigidMotion motion) {
    switch (motion) {
        case RigidMotion::torque_free:
            return coupling::BodyFreedom::torque_free;
        case RigidMotion::free:
            return coupling::BodyFreedom::free;
        case RigidMotion::prescribed:
            break;
    }
    return coupling::BodyFreedom::prescribed;
}

std::string name_of(const RigidInput& input, std::size_t index) {
    return input.name.empty() ? fmt::format("body{}", index) : input.name;
}

/// Values before and after a half turn: times at which an angle, known at some times, passes pi/2 + k pi.
std::vector<double> passages(const std::vector<double>& time, const std::vector<double>& angle) {
    constexpr double pi = std::numbers::pi;
    const auto level = [](double a) { return std::floor(a / pi - 0.5); };
    std::vector<double> times;
    for (std::size_t i = 1; i < angle.size(); ++i)
        if (level(angle[i]) != level(angle[i - 1])) {
            const double at = pi * (std::max(level(angle[i]), level(angle[i - 1])) + 0.5);
            const double share = (at - angle[i - 1]) / (angle[i] - angle[i - 1]);
            times.push_back(time[i - 1] + share * (time[i] - time[i - 1]));
        }
    return times;
}

constexpr const char* motion_columns[] = {"x_um",
                                          "y_um",
                                          "z_um",
                                          "force_x_N",
                                          "force_y_N",
                                          "force_z_N",
                                          "torque_x_Nm",
                                          "torque_y_Nm",
                                          "torque_z_Nm",
                                          "angular_x_1_per_s",
                                          "angular_y_1_per_s",
                                          "angular_z_1_per_s",
                                          "axis_x",
                                          "axis_y",
                                          "axis_z",
                                          "no_slip_um_per_s"};
/// Length of the axis in the xy plane below which it has no angle there.
constexpr double smallest_projection = 0.1;
constexpr std::size_t columns_per_body = std::size(motion_columns), axis_column = 12;

}  // namespace

RigidBodies::RigidBodies(const Case& c, const Scales& scales, coupling::Loop& loop,
                         const fluid::SolverOptions& fluid)
    : case_(c), scales_(scales), grid_(loop.grid()), fluid_(fluid) {
    for (std::size_t i = 0; i < c.bodies.size(); ++i) {
        const RigidInput& in = c.bodies[i];
        const double h = cells_around(in, grid_);
        coupling::BodySurface surface = make_surface(in, h);
        check_inside(c, i, surface, grid_);
        coupling::retract(surface, grid_, vec(in.position),
                          retraction(in, c.coupling.kernel, c.mesh.has_value()));
        coupling::BodyOptions o;
        o.name = name_of(in, i);
        o.forcing = in.method == RigidMethod::direct ? coupling::BodyForcing::direct
                                                     : coupling::BodyForcing::feedback;
        o.freedom = freedom_of(in.motion);
        o.density_ratio = in.density.value_or(c.fluid.density) / c.fluid.density;
        o.stiffness = in.stiffness.value_or(0) * 1e-6 / scales.pressure_pa;
        o.iterations = in.iterations;
        o.force = (1 / newton()) * vec(in.force);
        o.torque = (1e6 / newton()) * vec(in.torque);
        coupling::BodyState start;
        start.centre = vec(in.position);
        start.velocity = (1 / scales.velocity_um_per_s) * vec(in.velocity);
        start.angular_velocity = scales.time_s() * vec(in.angular_velocity);
        bodies_.push_back(std::make_unique<coupling::RigidBody>(std::move(surface), grid_, o, start));
        cell_.push_back(h);
        loop.add(*bodies_.back());
    }
}

std::string RigidBodies::describe() const {
    std::string text;
    for (std::size_t i = 0; i < size(); ++i) {
        const coupling::BodySurface& s = bodies_[i]->surface();
        text += fmt::format(
            "\n  body          {}: {} nodes, {:.2g} per square of the cells around it ({:.4g} um), {}",
            bodies_[i]->name(), bodies_[i]->nodes(), s.nodes_per_square(cell_[i]), cell_[i],
            case_.bodies[i].method == RigidMethod::direct ? "direct forcing" : "springs");
        if (s.nodes_per_square(cell_[i]) < fewest_nodes)
            text += fmt::format("; fewer than {} let the flow through between them", fewest_nodes);
    }
    return text;
}

Vec3d RigidBodies::axis(std::size_t body) const {
    return coupling::rotation(bodies_[body]->state().orientation) * vec(case_.bodies[body].axis);
}

std::vector<std::string> RigidBodies::columns() const {
    std::vector<std::string> names;
    for (const auto& body : bodies_)
        for (const char* column : motion_columns) names.push_back(fmt::format("{}.{}", body->name(), column));
    return names;
}

std::vector<double> RigidBodies::row() const {
    std::vector<double> values;
    const auto put = [&](double factor, const Vec3d& v) {
        values.insert(values.end(), {factor * v.x, factor * v.y, factor * v.z});
    };
    for (std::size_t i = 0; i < size(); ++i) {
        const coupling::BodyForces f = bodies_[i]->fluid_forces();
        put(1, bodies_[i]->state().centre);
        put(newton(), f.force);
        put(newton() * 1e-6, f.torque);
        put(1 / scales_.time_s(), bodies_[i]->state().angular_velocity);
        put(1, axis(i));
        values.push_back(bodies_[i]->slip() * scales_.velocity_um_per_s);
    }
    return values;
}

std::map<std::string, double> RigidBodies::observables(fluid::Flow& fluid,
                                                       const std::vector<std::vector<double>>& rows,
                                                       std::size_t first) const {
    std::map<std::string, double> all;
    const auto probe = fluid::make_probe(fluid);
    const std::vector<double> last = row();
    for (std::size_t i = 0; i < size(); ++i) {
        const RigidInput& in = case_.bodies[i];
        const coupling::RigidBody& body = *bodies_[i];
        const std::string prefix = i == 0 ? "" : body.name() + ".";
        const auto put = [&](const std::string& name, double value) { all[prefix + name] = value; };
        for (std::size_t k = 3; k < 9; ++k) put(motion_columns[k], last[columns_per_body * i + k]);
        const coupling::BodyState& state = body.state();
        put("angular_velocity_z_1_per_s", state.angular_velocity.z / scales_.time_s());
        if (case_.shear_rate)
            put("angular_velocity_z_over_rate",
                state.angular_velocity.z / scales_.time_s() / *case_.shear_rate);
        const coupling::BodyForces f = body.fluid_forces();
        double speed = fluid_speed(in, state, fluid);
        if (in.speed) {
            speed = *in.speed / scales_.velocity_um_per_s;
            const double unit = 0.5 * speed * speed * reference_area(in, body.surface());
            put("drag_coefficient", dot(f.force, vec(in.drag_direction)) / unit);
            put("lift_coefficient", dot(f.force, vec(in.lift_direction)) / unit);
        }
        put("no_slip_error", body.slip() / speed);
        put("pressure_difference_pa",
            pressure_difference(body, vec(in.drag_direction), grid_, fluid_, *probe) * scales_.pressure_pa);
        if (std::hypot(axis(i).x, axis(i).y) < smallest_projection) continue;
        std::vector<double> time, angle;
        for (const auto& r : rows) {
            const std::size_t at = first + columns_per_body * i + axis_column;
            const double a = std::atan2(r[at + 1], r[at]);
            const double turns = angle.empty() ? 0 : std::round((angle.back() - a) / (2 * std::numbers::pi));
            time.push_back(r[1]);
            angle.push_back(a + 2 * std::numbers::pi * turns);
        }
        const std::vector<double> at = passages(time, angle);
        if (at.size() < 2) continue;
        const double period = 2 * (at.back() - at.front()) / static_cast<double>(at.size() - 1);
        put("orbit_period_s", period);
        if (case_.shear_rate) put("orbit_period_strain", period * *case_.shear_rate);
    }
    return all;
}

RigidBodies::Frame RigidBodies::frame() const {
    Frame frame;
    constexpr double piconewton = 1e12;
    for (const auto& body : bodies_) {
        meshing::SurfaceMesh mesh = body->surface().mesh;
        const coupling::Matrix3 turn = coupling::rotation(body->state().orientation);
        for (Vec3d& x : mesh.vertices) x = body->state().centre + turn * x;
        frame.meshes.push_back(std::move(mesh));
        const std::vector<Vec3d> t = body->tractions();
        for (std::size_t j = 0; j < t.size(); ++j)
            frame.forces_pn.push_back((newton() * piconewton * body->surface().areas[j]) * t[j]);
    }
    return frame;
}

std::vector<coupling::RigidBody*> RigidBodies::all() const {
    std::vector<coupling::RigidBody*> pointers;
    for (const auto& body : bodies_) pointers.push_back(body.get());
    return pointers;
}

void RigidBodies::save(output::Checkpoint& checkpoint) const {
    for (const auto& body : bodies_) {
        const coupling::BodyMemory m = body->memory();
        const coupling::BodyState& s = m.state;
        std::vector<double> state(s.orientation.begin(), s.orientation.end());
        for (const Vec3d& v :
             {s.centre, s.velocity, s.angular_velocity, s.acceleration, s.angular_acceleration})
            state.insert(state.end(), {v.x, v.y, v.z});
        state.push_back(m.stiffness);
        checkpoint.put("body." + body->name(), std::move(state));
        for (std::size_t q = 0; q < 3; ++q)
            checkpoint.put(fmt::format("body.{}.force_{}", body->name(), "xyz"[q]), m.forces[q]);
    }
}

void RigidBodies::load(const output::Checkpoint& checkpoint) {
    for (const auto& body : bodies_) {
        const std::vector<double>& v = checkpoint.array("body." + body->name(), 20);
        const auto at = [&](std::size_t k) { return Vec3d{v[k], v[k + 1], v[k + 2]}; };
        coupling::BodyMemory m;
        m.state = {at(4), {v[0], v[1], v[2], v[3]}, at(7), at(10), at(13), at(16)};
        m.stiffness = v[19];
        for (std::size_t q = 0; q < 3; ++q)
            m.forces[q] =
                checkpoint.array(fmt::format("body.{}.force_{}", body->name(), "xyz"[q]), body->nodes());
        body->restore(m);
    }
}

}  // namespace hemoflux::apps
