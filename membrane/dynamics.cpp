#include "membrane/dynamics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exchange/error.hpp"
#include "membrane/viscosity.hpp"

namespace hemoflux::membrane {
namespace {

/// Drag and dashpots of one time step as a potential.
class Dissipation {
  public:
    Dissipation(const Batch& batch, double drag)
        : topology_(batch.topology()),
          dashpot_(dashpot_coefficient(batch.parameters().network.viscosity)),
          node_drag_(batch.vertices(), 0.0) {
        const auto& areas = batch.reference().triangle_areas;
        for (std::size_t k = 0; k < areas.size(); ++k)
            for (const int v : topology_.triangles()[k])
                node_drag_[static_cast<std::size_t>(v)] += drag * areas[k] / 3;
    }

    /// Begins a step of length dt from the shape R*, L*; `weight` is 1/2 or 3/4.
    void begin(double dt, double weight, const std::vector<Vec3d>& position,
               const std::vector<double>& length) {
        factor_ = weight / dt;
        position_ = position;
        length_ = length;
    }

    double operator()(std::span<const double> r, std::span<double> gradient) const {
        const std::size_t n = node_drag_.size();
        double sum = 0;
        for (std::size_t v = 0; v < n; ++v) {
            const double c = factor_ * node_drag_[v];
            const double x = r[v] - position_[v].x, y = r[n + v] - position_[v].y,
                         z = r[2 * n + v] - position_[v].z;
            sum += c * (x * x + y * y + z * z);
            gradient[v] += 2 * c * x;
            gradient[n + v] += 2 * c * y;
            gradient[2 * n + v] += 2 * c * z;
        }
        const double g = factor_ * dashpot_;
        if (g > 0) {
            for (std::size_t e = 0; e < length_.size(); ++e) {
                const auto a = static_cast<std::size_t>(topology_.edges()[e].v1),
                           b = static_cast<std::size_t>(topology_.edges()[e].v2);
                const double x = r[b] - r[a], y = r[n + b] - r[n + a], z = r[2 * n + b] - r[2 * n + a];
                const double now = std::sqrt(x * x + y * y + z * z), change = now - length_[e];
                sum += g * change * change;
                const double pull = 2 * g * change / now;
                gradient[a] -= pull * x, gradient[n + a] -= pull * y, gradient[2 * n + a] -= pull * z;
                gradient[b] += pull * x, gradient[n + b] += pull * y, gradient[2 * n + b] += pull * z;
            }
        }
        return sum;
    }

  private:
    const Topology& topology_;
    double dashpot_, factor_ = 0;
    std::vector<double> node_drag_;
    std::vector<Vec3d> position_;
    std::vector<double> length_;
};

}  // namespace

double stokes_drag(double outer_viscosity, double inner_viscosity, double radius) {
    return 2 * (outer_viscosity + inner_viscosity) / radius;
}

void DynamicsOptions::check() const {
    const auto positive = [](const char* name, double value) {
        if (!(value > 0) || std::isinf(value))
            throw InputError(fmt::format("overdamped motion: {} = {}", name, value),
                             "it must be positive and finite", "Correct it");
    };
    positive("drag", drag);
    positive("step", step);
    positive("steps", steps);
    solver.check();
}

void evolve(Batch& batch, const DynamicsOptions& options, const std::vector<Vec3d>& load,
            const std::function<bool(double time)>& observe) {
    options.check();
    if (!load.empty() && load.size() != batch.vertices())
        throw InputError(fmt::format("{} loads", load.size()),
                         fmt::format("the cell has {} vertices", batch.vertices()),
                         "Give one load per vertex, or none");
    const Potential weight = dead_load(load);
    Dissipation dissipation(batch, options.drag);
    const Potential potential = [&](std::span<const double> r, std::span<double> gradient) {
        return dissipation(r, gradient) + (weight ? weight(r, gradient) : 0);
    };
    std::vector<Vec3d> now = batch.positions(0), before;
    std::vector<double> length = edge_lengths(batch.topology(), now), length_before;
    for (int k = 1; k <= options.steps; ++k) {
        if (k == 1) {
            dissipation.begin(options.step, 0.5, now, length);
        } else {
            std::vector<Vec3d> target(now.size());
            std::vector<double> target_length(length.size());
            for (std::size_t v = 0; v < now.size(); ++v) target[v] = (1.0 / 3) * (4.0 * now[v] - before[v]);
            for (std::size_t e = 0; e < length.size(); ++e)
                target_length[e] = (4 * length[e] - length_before[e]) / 3;
            dissipation.begin(options.step, 0.75, target, target_length);
        }
        minimise(batch, options.solver, potential);
        before = std::move(now);
        length_before = std::move(length);
        now = batch.positions(0);
        length = edge_lengths(batch.topology(), now);
        if (!observe(k * options.step)) return;
    }
}

}  // namespace hemoflux::membrane
