#include "fluid/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "exchange/error.hpp"
#include "fluid/border_flux.hpp"
#include "fluid/local_step.hpp"
#include "fluid/update.hpp"

namespace hemoflux::fluid {

double largest_delta(const SolverOptions& o) {
    const double nu = o.smallest_nu > 0 ? o.smallest_nu : o.nu;
    return o.tau_floor > 0 ? 3 * nu / (o.gamma * o.tau_floor) : 1e300;
}

const SolverOptions& checked(const SolverOptions& o) {
    if (!(o.nu > 0))
        throw InputError(fmt::format("viscosity {}", o.nu), "it must be positive",
                         "give a positive viscosity");
    if (!(o.gamma > 0 && o.gamma <= 1))
        throw InputError(fmt::format("gamma {}", o.gamma), "the preconditioning parameter lies in (0, 1]",
                         "use 1 for no preconditioning");
    return o;
}

FlowParameters parameters_at(const SolverOptions& o, double t) {
    const Vec3d wave = o.oscillating_force.at(t);
    return {o.nu,
            o.gamma,
            {o.uniform_force[0] + wave.x, o.uniform_force[1] + wave.y, o.uniform_force[2] + wave.z},
            o.with_force,
            o.with_viscosity};
}

Solver::Solver(const meshing::RectilinearGrid& grid, const Patches& patches, const SolverOptions& options)
    : options_(checked(options)),
      grid_(grid, (check(patches), periodic_axes(patches)), largest_delta(options), options.gradient),
      boundary_(patches, grid_),
      state_(grid_.view().layout, options.with_force, options.with_viscosity, options.nu),
      residual_(grid_.view().layout, false, false, 0) {
    if (options_.largest_nu < options_.nu) options_.largest_nu = options_.nu;
    boundary_.check_mass_balance();
    if (options_.single_precision) {
        if (exchange::on_gpu || grid_.view().delta == 0 || options_.with_force || options_.with_viscosity)
            throw InputError("single precision",
                             "it is for cubic cells whose streaming distance is half their width, without a "
                             "body force or a varying viscosity, on a processor",
                             "use double precision, or a uniform grid of cubes and a smaller tau_floor");
        single_ = std::make_unique<SingleResidual>(grid_.view());
    }
}

namespace {

/// Indices along the axes of a cell numbered x fastest.
std::array<std::size_t, 3> indices(const exchange::Layout& layout, std::size_t cell) {
    return {cell % layout.n[0], cell / layout.n[0] % layout.n[1], cell / (layout.n[0] * layout.n[1])};
}

}  // namespace

Vec3d Solver::centre(std::size_t cell) const {
    const auto index = indices(grid_.view().layout, cell);
    double x[3];
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& faces = grid_.rectilinear().axes[a].faces;
        x[a] = (faces[index[a]] + faces[index[a] + 1]) / 2;
    }
    return {x[0], x[1], x[2]};
}

double Solver::volume(std::size_t cell) const {
    const auto index = indices(grid_.view().layout, cell);
    double volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& faces = grid_.rectilinear().axes[a].faces;
        volume *= faces[index[a] + 1] - faces[index[a]];
    }
    return volume;
}

std::vector<std::string> Solver::patches() const { return {"x-", "x+", "y-", "y+", "z-", "z+"}; }

std::vector<double> Solver::values(int component) const {
    return state_.interior(state_.view().q[component]);
}

void Solver::set_values(int component, const std::vector<double>& values) {
    state_.set_interior(state_.view().q[component], values);
}

FlowParameters Solver::flow_parameters() const { return parameters_at(options_, stage_time_); }

ResidualView Solver::residual_view(const State& fields) const {
    const auto& q = fields.view().q;
    return {{q[0], q[1], q[2], q[3]}};
}

void Solver::evaluate() {
    boundary_.fill(grid_.view(), state_.view());
    if (single_)
        single_->evaluate(state_.view(), boundary_.view(), flow_parameters(), residual_view(residual_));
    else
        evaluate_residual(grid_.view(), state_.view(), boundary_.view(), flow_parameters(),
                          residual_view(residual_));
    ++evaluations_;
}

std::array<Vec3d, 6> Solver::border_momentum() {
    fill_coefficients();
    boundary_.fill(grid_.view(), state_.view());
    return fluid::border_momentum(grid_.view(), state_.view(), boundary_.view(), flow_parameters());
}

void Solver::set_time(double t) {
    time_ = t;
    if (t == stage_time_) return;
    stage_time_ = t;
    if (boundary_.unsteady()) boundary_.set_time(t, grid_);
}

void Solver::evaluate_at(double t) {
    set_time(t);
    evaluate();
}

void Solver::fill_coefficients() {
    if (options_.with_force) boundary_.fill_force(grid_.view(), state_.view());
    if (options_.with_viscosity) boundary_.fill_viscosity(grid_.view(), state_.view());
}

void Solver::step(double dt) {
    const double start = time_;
    fill_coefficients();
    const exchange::Layout& layout = grid_.view().layout;
    const ResidualView r = residual_view(residual_);
    if (options_.scheme == Scheme::euler) {
        evaluate_at(start);
        update(layout, state_.view(), r, r, {dt, 0, false, false, false, nullptr}, state_.view());
    } else if (options_.scheme == Scheme::factored) {
        if (!factored_ || factored_->dt() != dt)
            factored_ =
                std::make_unique<Factored>(grid_, boundary_, options_.largest_nu / options_.gamma, dt);
        evaluate_at(start + dt);
        factored_->solve(r);
        if (factored_->implicit_density()) factored_->solve_density(grid_.view(), boundary_, r);
        update_factored(layout, r, dt, state_.view());
    } else {
        step_rk4(start, dt, dt, nullptr);
    }
    set_time(start + dt);
}

void Solver::step_rk4(double start, double dt, double scale, const double* local_dt) {
    const exchange::Layout& layout = grid_.view().layout;
    const ResidualView r = residual_view(residual_);
    if (!base_) {
        base_ = std::make_unique<State>(layout, false, false, 0);
        sum_ = std::make_unique<State>(layout, false, false, 0);
    }
    for (int c = 0; c < 4; ++c)
        exchange::copy_on_device(base_->view().q[c], state_.view().q[c], layout.size * sizeof(double));
    const ResidualView sum = residual_view(*sum_);
    const double time[4] = {start, start + dt / 2, start + dt / 2, start + dt};
    const double advance[3] = {scale / 2, scale / 2, scale}, weight[4] = {1, 2, 2, 1};
    for (int stage = 0; stage < 3; ++stage) {
        evaluate_at(time[stage]);
        update(layout, base_->view(), r, sum,
               {advance[stage], weight[stage], true, stage == 0, false, local_dt}, state_.view());
    }
    evaluate_at(time[3]);
    update(layout, base_->view(), r, sum, {scale / 6, weight[3], false, false, true, local_dt},
           state_.view());
}

void Solver::set_local_steps(double sigma, double c) {
    if (local_dt_.size() == 0) {
        local_dt_ = exchange::Buffer<double>(grid_.view().layout.size);
        local_dt_.fill(0);
    }
    local_steps(grid_.view(), state_.view(), {sigma, c, options_.nu, options_.gamma}, local_dt_.data());
}

void Solver::local_step() {
    if (local_dt_.size() == 0) throw std::logic_error("Solver::local_step: set_local_steps() comes first");
    fill_coefficients();
    step_rk4(time_, 0, 1, local_dt_.data());
}

void Solver::offer(exchange::FieldTable& table) {
    using exchange::Shape;
    const StateView& v = state_.view();
    const std::size_t size = grid_.view().layout.size;
    table.offer("fluid", {"density", Shape::scalar, "rho_0"}, {{v.q[0], nullptr, nullptr}, size});
    table.offer("fluid", {"velocity", Shape::vector, "c"}, {{v.q[1], v.q[2], v.q[3]}, size});
    if (v.force[0])
        table.offer("fluid", {"force_density", Shape::vector, "rho_0 c^2 / um"},
                    {{v.force[0], v.force[1], v.force[2]}, size});
    if (v.nu) table.offer("fluid", {"viscosity", Shape::scalar, "um c"}, {{v.nu, nullptr, nullptr}, size});
}

}  // namespace hemoflux::fluid
