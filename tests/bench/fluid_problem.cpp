#include "fluid_problem.hpp"

#include <cmath>

#include "scalar_lbfs.hpp"

namespace hemoflux::bench {
namespace {

constexpr double viscosity = 0.5 * FluidProblem::width;  // nu/h of the tank-treading case

meshing::Axis axis_of(int n, Features features) {
    const double half = n * FluidProblem::width / 2;
    if (features == Features::plain) return meshing::uniform_axis(-half, half, n);
    return meshing::plateau_axis(-half, half, n, n / 3.0, 6.0 / n);  // n = 30: a = 10, b = 0.2
}

fluid::Patches patches_of(Features features) {
    fluid::Patches patches;
    patches.fill(features == Features::plain ? fluid::periodic_patch()
                                             : fluid::velocity_patch([](const Vec3d& x) {
                                                   return Vec3d{0.002 * x.y, 0, 0};
                                               }));
    return patches;
}

/// mean + amplitude * a smooth wave, different for each `phase`.
std::vector<double> wave(const exchange::Layout& layout, double mean, double amplitude, double phase) {
    std::vector<double> values;
    const auto turn = [](std::size_t i, std::size_t n) {
        return 2 * M_PI * static_cast<double>(i) / static_cast<double>(n);
    };
    for (std::size_t k = 0; k < layout.n[2]; ++k)
        for (std::size_t j = 0; j < layout.n[1]; ++j)
            for (std::size_t i = 0; i < layout.n[0]; ++i)
                values.push_back(mean + amplitude * std::sin(turn(i, layout.n[0]) + phase) *
                                            std::cos(turn(j, layout.n[1]) + 2 * phase) *
                                            std::sin(turn(k, layout.n[2]) + 3 * phase));
    return values;
}

}  // namespace

FluidProblem::FluidProblem(std::array<int, 3> n, Features features)
    : patches(patches_of(features)),
      grid({{axis_of(n[0], features), axis_of(n[1], features), axis_of(n[2], features)}},
           fluid::periodic_axes(patches)),
      boundary(patches, grid),
      state(grid.view().layout, features == Features::full, features == Features::full, viscosity),
      residual(grid.view().layout, false, false, 0),
      parameters{.nu = viscosity,
                 .with_force = features == Features::full,
                 .with_viscosity = features == Features::full} {
    const exchange::Layout& layout = grid.view().layout;
    const fluid::StateView& s = state.view();
    for (int c = 0; c < 4; ++c)
        state.set_interior(s.q[c], wave(layout, c == 0 ? 1 : 0, c == 0 ? 0.01 : 0.05, c));
    boundary.fill(grid.view(), s);
    if (features == Features::plain) return;
    for (int c = 0; c < 3; ++c) state.set_interior(s.force[c], wave(layout, 0, 1e-3, 4 + c));
    state.set_interior(s.nu, wave(layout, viscosity, viscosity / 2, 7));
    boundary.fill_force(grid.view(), s);
    boundary.fill_viscosity(grid.view(), s);
}

fluid::ResidualView FluidProblem::out() const {
    const auto& q = residual.view().q;
    return {{q[0], q[1], q[2], q[3]}};
}

void FluidProblem::evaluate() const {
    fluid::evaluate_residual(grid.view(), state.view(), boundary.view(), parameters, out());
}

void FluidProblem::evaluate_by_cell() const {
    fluid::evaluate_residual_by_cell(grid.view(), state.view(), boundary.view(), parameters, out());
}

double scalar_kernel_error() {
    const FluidProblem problem({19, 12, 7}, Features::plain);
    problem.evaluate();
    ScalarFlow scalar({19, 12, 7}, FluidProblem::width, viscosity);
    for (std::size_t c = 0; c < 4; ++c)
        scalar.fields()[c] = problem.state.interior(problem.state.view().q[c]);
    scalar.evaluate();
    double sum = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const std::vector<double> fast = problem.residual.interior(problem.residual.view().q[c]);
        double error = 0, reference = 0;
        for (std::size_t i = 0; i < fast.size(); ++i) {
            error += std::pow(fast[i] - scalar.residual()[c][i], 2);
            reference += std::pow(fast[i], 2);
        }
        sum += std::sqrt(error / reference);
    }
    return sum;
}

}  // namespace hemoflux::bench
