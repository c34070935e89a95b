#include "coupling/rigid_body.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// Square of the springs' frequency times dt that is used where no stiffness is given; 4 is the limit.
constexpr double spring_share = 0.02;

exchange::FieldView view(exchange::Buffer<double> (&b)[3]) {
    return {{b[0].data(), b[1].data(), b[2].data()}, b[0].size()};
}

void refuse_impossible(const BodySurface& surface, const BodyOptions& o) {
    if (!(o.density_ratio >= 1))
        throw InputError(
            fmt::format("{} has {} times the fluid's density", o.name, o.density_ratio),
            "a lighter body is accelerated by the fluid inside it, which makes the step unstable",
            "Give a density of at least the fluid's");
    if (!(o.stiffness >= 0 && std::isfinite(o.stiffness)))
        throw InputError(fmt::format("{} has stiffness {}", o.name, o.stiffness), "springs pull back",
                         "Give a positive stiffness, or none");
    if (o.iterations < 1)
        throw InputError(fmt::format("{}: {} iterations of direct forcing", o.name, o.iterations),
                         "the velocity is corrected at least once", "Give 1 or more");
    if (!surface.closed && o.freedom != BodyFreedom::prescribed)
        throw InputError(fmt::format("{} is open and moves freely", o.name),
                         "an open surface has no inertia of its own",
                         "Give it a closed surface or a prescribed motion");
}

}  // namespace

RigidBody::RigidBody(BodySurface surface, const FluidGrid& grid, const BodyOptions& options,
                     const BodyState& start)
    : surface_(std::move(surface)),
      options_(options),
      state_(start),
      before_(start),
      nodes_((refuse_impossible(surface_, options), surface_)),
      stiffness_(options.stiffness) {
    nodes_.place(state_);
    for (int q = 0; q < 3; ++q) {
        density_[q] = exchange::Buffer<double>(grid.field_size());
        predicted_[q] = exchange::Buffer<double>(nodes());
    }
}

RigidBody::~RigidBody() = default;

bool RigidBody::moves() const {
    return options_.freedom != BodyFreedom::prescribed || norm(state_.velocity) > 0 ||
           norm(state_.angular_velocity) > 0;
}

void RigidBody::find_gains(double dt, const NodeLink& link) {
    const bool springs = options_.forcing == BodyForcing::feedback;
    if (gains_for_ == dt && (springs || !moves())) return;
    gains_for_ = dt;
    if (!springs || stiffness_ == 0) {
        nodes_.areas_to_increments();
        spreader_->spread(nodes_.increments(), 1, view(density_));
        link.interpolate(view(density_), nodes_.velocities());
    }
    if (!springs) return nodes_.set_gains_from_response(dt);
    if (stiffness_ == 0) stiffness_ = spring_share / (dt * dt * nodes_.largest_response());
    nodes_.set_uniform_gains(stiffness_ * dt);
}

void RigidBody::exchange_momentum(double dt, const exchange::FieldView& u, bool add) {
    const NodeSums sums = nodes_.sums(state_.centre, u);
    BodyLoad load{(options_.density_ratio - 1) * surface_.volume, {}, options_.force, options_.torque};
    const Matrix3 turn = rotation(state_.orientation), inertia = turn * surface_.inertia * turn.transposed();
    for (int i = 0; i < 3; ++i) load.excess_inertia.row[i] = (options_.density_ratio - 1) * inertia.row[i];
    const BodyVelocity v = balance(options_.freedom, before_, sums, load, dt);
    state_.velocity = v.velocity;
    state_.angular_velocity = v.angular_velocity;
    nodes_.correct(state_, u, add);
}

void RigidBody::correct(double dt, const NodeLink& link, const FluidFields& fluid) {
    if (!spreader_) spreader_ = link.spreader(nullptr);
    find_gains(dt, link);
    before_ = state_;
    if (options_.forcing == BodyForcing::feedback) return;
    const exchange::FieldView u = nodes_.velocities(), start = view(predicted_), density = view(density_);
    link.interpolate(fluid.velocity, start);
    exchange_momentum(dt, start, false);
    const auto spread = [&] { spreader_->spread(nodes_.increments(), 1, density); };
    for (int i = 1; i < options_.iterations; ++i) {
        spread();
        link.interpolate(density, u);
        nodes_.combine(start, dt);
        exchange_momentum(dt, u, true);
    }
    spread();
    spreader_->accelerate(dt, density, fluid);
}

void RigidBody::advance(double dt, const exchange::FieldView& velocity) {
    if (options_.forcing == BodyForcing::feedback) exchange_momentum(dt, velocity, false);
    const SlipSums slip = nodes_.slip(state_, velocity);
    slip_ = std::sqrt(slip.square / slip.area);
    const NodeSums sums = nodes_.sums(state_.centre, velocity);
    on_fluid_ = {sums.force, sums.torque};
    state_.acceleration = (1 / dt) * (state_.velocity - before_.velocity);
    state_.angular_acceleration = (1 / dt) * (state_.angular_velocity - before_.angular_velocity);
    if (!moves()) return;
    coupling::advance(state_, dt);
    nodes_.place(state_);
}

void RigidBody::report_lost(std::size_t node) const {
    throw NumericalError(fmt::format("node {} of {}", node, options_.name),
                         "it has left the box or its position is no longer a number",
                         "enlarge the box, move the body away from its sides, or shorten the time step");
}

BodyForces RigidBody::fluid_forces() const {
    const Matrix3 turn = rotation(state_.orientation), inertia = turn * surface_.inertia * turn.transposed();
    const Vec3d& spin = state_.angular_velocity;
    return {surface_.volume * state_.acceleration - on_fluid_.force,
            inertia * state_.angular_acceleration + cross(spin, inertia * spin) - on_fluid_.torque};
}

std::vector<Vec3d> RigidBody::host_positions() const {
    const Matrix3 turn = rotation(state_.orientation);
    std::vector<Vec3d> x;
    for (const Vec3d& own : surface_.mesh.vertices) x.push_back(state_.centre + turn * own);
    return x;
}

std::vector<Vec3d> RigidBody::tractions() const {
    const std::array<std::vector<double>, 3> f = memory().forces;
    std::vector<Vec3d> t;
    for (std::size_t j = 0; j < nodes_.size(); ++j)
        t.push_back((-1 / surface_.areas[j]) * Vec3d{f[0][j], f[1][j], f[2][j]});
    return t;
}

BodyMemory RigidBody::memory() const {
    return {state_, {nodes_.host_forces(0), nodes_.host_forces(1), nodes_.host_forces(2)}, stiffness_};
}

void RigidBody::restore(const BodyMemory& memory) {
    state_ = before_ = memory.state;
    stiffness_ = memory.stiffness;
    gains_for_ = 0;
    for (int q = 0; q < 3; ++q) nodes_.set_forces(q, memory.forces[static_cast<std::size_t>(q)]);
    nodes_.place(state_);
}

}  // namespace hemoflux::coupling
