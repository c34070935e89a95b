#include "coupling/held_bodies.hpp"

#include <cmath>

#include "coupling/interpolate.hpp"
#include "exchange/error.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// c_j rho nu / h_j (see the header).
constexpr double compliance = 0.02;
/// Velocity of a node over stress h / (rho nu), for the estimate.
constexpr double response = 0.7;

struct Violation {
    std::size_t nodes;
    const double *velocity[3], *density[3], *weight, *slip_per_force, *slip_per_density, *force;
    double* g;
    HEMOFLUX_FN void operator()(std::size_t j) const {
        for (std::size_t q = 0; q < 3; ++q) {
            const std::size_t at = q * nodes + j;
            const double slip = slip_per_force[j] * force[at] - slip_per_density[j] * density[q][j];
            g[at] = -weight[j] * (velocity[q][j] + slip);
        }
    }
};

struct Estimate {
    std::size_t nodes;
    const double* gain;
    const float* g;
    double* force;
    HEMOFLUX_FN void operator()(std::size_t j) const {
        for (std::size_t q = 0; q < 3; ++q) {
            const std::size_t at = q * nodes + j;
            force[at] = gain[j] * static_cast<double>(g[at]);
        }
    }
};

std::size_t total_nodes(const std::vector<RigidBody*>& bodies) {
    std::size_t n = 0;
    for (const RigidBody* b : bodies) n += b->nodes();
    return n;
}

void refuse_moving(const std::vector<RigidBody*>& bodies) {
    for (const RigidBody* b : bodies)
        if (b->options().freedom != BodyFreedom::prescribed || norm(b->state().velocity) > 0 ||
            norm(b->state().angular_velocity) > 0)
            throw InputError(b->name() + " moves in a steady flow",
                             "the steady state is found with bodies that are held where they are",
                             "Leave out its motion and velocities, or run it in time: [time] with steady");
}

}  // namespace

HeldBodies::HeldBodies(fluid::Solver& fluid, Kernel kernel, const std::vector<RigidBody*>& bodies)
    : fluid_((refuse_moving(bodies), fluid)),
      bodies_(bodies),
      grid_(fluid.grid().rectilinear(), fluid.grid().periodic()),
      stencils_(grid_, kernel, total_nodes(bodies)),
      spreader_(stencils_),
      force_(size()) {
    const fluid::StateView& state = fluid.state().view();
    const std::size_t padded = fluid.grid().view().layout.size, n = stencils_.size();
    velocity_ = {{state.q[1], state.q[2], state.q[3]}, padded};
    force_density_ = {{state.force[0], state.force[1], state.force[2]}, padded};
    std::vector<double> x[3], areas, weight, slip, gain;
    const double nu = fluid.options().nu, speed = fluid.largest_speed();
    const CellGridView view = grid_.view();
    for (const RigidBody* b : bodies)
        for (std::size_t j = 0; j < b->nodes(); ++j) {
            const Vec3d at = b->state().centre + rotation(b->state().orientation) * b->surface().nodes[j];
            const double place[3] = {at.x, at.y, at.z}, area = b->surface().areas[j];
            double volume = 1;
            for (std::size_t d = 0; d < 3; ++d) {
                x[d].push_back(place[d]);
                volume *= view.axis[d].width_at(place[d]);
            }
            const double h = std::cbrt(volume), rate = std::sqrt(area) / h * (nu / h + speed) / h;
            areas.push_back(area);
            weight.push_back(rate);
            slip.push_back(compliance * h / (nu * area));
            gain.push_back(area * nu / (response * h * rate));
        }
    exchange::Buffer<double> position[3];
    for (int d = 0; d < 3; ++d) {
        position[d] = exchange::Buffer<double>(x[d]);
        node_velocity_[d] = exchange::Buffer<double>(n);
        node_density_[d] = exchange::Buffer<double>(n);
    }
    stencils_.update(position[0].data(), position[1].data(), position[2].data());
    weight_ = exchange::Buffer<double>(weight);
    slip_per_force_ = exchange::Buffer<double>(slip);
    force_per_violation_ = exchange::Buffer<double>(gain);
    const exchange::Buffer<double> unit(areas);
    spreader_.spread(unit.data(), unit.data(), unit.data(), 1, force_density_);
    interpolate(stencils_, force_density_, node_density_[0].data(), node_density_[1].data(),
                node_density_[2].data());
    const std::vector<double> density_of_unit = node_density_[0].to_host();
    for (std::size_t j = 0; j < n; ++j) slip[j] *= areas[j] / std::fabs(density_of_unit[j]);
    slip_per_density_ = exchange::Buffer<double>(slip);
    exert(exchange::Buffer<double>(size()).data());  // none yet
}

exchange::FieldView HeldBodies::velocities() {
    return {{node_velocity_[0].data(), node_velocity_[1].data(), node_velocity_[2].data()}, stencils_.size()};
}

void HeldBodies::exert(const double* forces) {
    const std::size_t n = stencils_.size();
    exchange::copy_on_device(force_.data(), forces, size() * sizeof(double));
    spreader_.spread(force_.data(), force_.data() + n, force_.data() + 2 * n, 1, force_density_);
    fluid_.boundary().fill_force(fluid_.grid().view(), fluid_.state().view());
}

void HeldBodies::violation(const double* forces, double* g) {
    const exchange::FieldView u = velocities();
    interpolate(stencils_, velocity_, u.component[0], u.component[1], u.component[2]);
    interpolate(stencils_, force_density_, node_density_[0].data(), node_density_[1].data(),
                node_density_[2].data());
    exchange::for_each_index(
        stencils_.size(),
        Violation{stencils_.size(),
                  {u.component[0], u.component[1], u.component[2]},
                  {node_density_[0].data(), node_density_[1].data(), node_density_[2].data()},
                  weight_.data(),
                  slip_per_force_.data(),
                  slip_per_density_.data(),
                  forces,
                  g},
        exchange::Cost::cheap);
}

void HeldBodies::estimate(const float* g, double* forces) {
    exchange::for_each_index(stencils_.size(),
                             Estimate{stencils_.size(), force_per_violation_.data(), g, forces},
                             exchange::Cost::cheap);
}

void HeldBodies::settle() {
    const exchange::FieldView u = velocities();
    interpolate(stencils_, velocity_, u.component[0], u.component[1], u.component[2]);
    const std::vector<double> all = force_.to_host();
    std::size_t first = 0;
    for (RigidBody* b : bodies_) {
        const std::size_t n = b->nodes();
        BodyMemory memory = b->memory();
        for (std::size_t q = 0; q < 3; ++q) {
            const auto begin = all.begin() + static_cast<std::ptrdiff_t>(q * stencils_.size() + first);
            memory.forces[q].assign(begin, begin + static_cast<std::ptrdiff_t>(n));
        }
        b->restore(memory);
        b->advance(1, {{u.component[0] + first, u.component[1] + first, u.component[2] + first}, n});
        first += n;
    }
}

}  // namespace hemoflux::coupling
