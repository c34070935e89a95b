#include "fluid/hex_solver.hpp"

#include <algorithm>
#include <stdexcept>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "fluid/hex_time_step.hpp"
#include "fluid/hex_update.hpp"

namespace hemoflux::fluid {
namespace {

const SolverOptions& checked_without_rows(const SolverOptions& o) {
    if (o.scheme == Scheme::factored)
        throw InputError("scheme factored", "it needs rows of cells, which an unstructured grid has not",
                         "use rk4 or euler, or a rectilinear grid");
    return checked(o);
}

/// Viscosity stands in the records of the body force.
SolverOptions with_place_for_viscosity(SolverOptions o) {
    o.with_force = o.with_force || o.with_viscosity;
    return o;
}

}  // namespace

HexSolver::HexSolver(meshing::HexGrid grid, const HexPatches& patches, const SolverOptions& options)
    : options_(with_place_for_viscosity(checked_without_rows(options))),
      grid_(std::move(grid)),
      geometry_(grid_, options.gradient, largest_delta(options), idle_faces(grid_, patches)),
      boundary_(grid_, patches),
      rate_(4 * grid_.cells()) {
    boundary_.check_mass_balance();
    const std::size_t all = grid_.cells() + grid_.border_faces();
    std::vector<double> rest(4 * all, 0.0);
    for (std::size_t i = 0; i < all; ++i) rest[4 * i] = 1;
    values_ = exchange::Buffer<double>(rest);
    if (!options_.with_force) return;
    std::vector<double> coefficients(4 * all, 0.0);
    for (std::size_t i = 0; i < all; ++i) coefficients[4 * i + 3] = options_.nu;
    force_ = exchange::Buffer<double>(coefficients);
}

std::vector<std::string> HexSolver::patches() const {
    std::vector<std::string> names;
    for (const auto& p : grid_.patches) names.push_back(p.name);
    return names;
}

std::vector<double> HexSolver::column(const exchange::Buffer<double>& records, int component) const {
    const std::vector<double> all = records.to_host();
    std::vector<double> one;
    one.reserve(cells());
    for (std::size_t i = 0; i < cells(); ++i) one.push_back(all[4 * i + static_cast<std::size_t>(component)]);
    return one;
}

void HexSolver::set_column(exchange::Buffer<double>& records, int component,
                           const std::vector<double>& values) {
    if (values.size() != cells()) throw std::length_error("HexSolver: wrong number of cells");
    std::vector<double> all = records.to_host();
    for (std::size_t i = 0; i < cells(); ++i) all[4 * i + static_cast<std::size_t>(component)] = values[i];
    records.assign(all);
}

std::vector<double> HexSolver::values(int component) const { return column(values_, component); }
void HexSolver::set_values(int component, const std::vector<double>& values) {
    set_column(values_, component, values);
}
void HexSolver::set_force(int component, const std::vector<double>& values) {
    if (!options_.with_force) throw std::logic_error("HexSolver::set_force: this flow has no body force");
    set_column(force_, component, values);
}
void HexSolver::set_viscosity(const std::vector<double>& values) {
    if (!options_.with_viscosity)
        throw std::logic_error("HexSolver::set_viscosity: this flow has one viscosity");
    set_column(force_, 3, values);
}
std::vector<double> HexSolver::coefficient(int component) const {
    if (component < 3 ? !options_.with_force : !options_.with_viscosity) return {};
    return column(force_, component);
}

void HexSolver::offer(exchange::FieldTable& table) {
    using exchange::Shape;
    const std::size_t size = cells();
    double *q = values_.data(), *f = force_.data();
    table.offer("fluid", {"density", Shape::scalar, "rho_0"}, {{q, nullptr, nullptr}, size, 4});
    table.offer("fluid", {"velocity", Shape::vector, "c"}, {{q + 1, q + 2, q + 3}, size, 4});
    if (options_.with_force)
        table.offer("fluid", {"force_density", Shape::vector, "rho_0 c^2 / um"},
                    {{f, f + 1, f + 2}, size, 4});
    if (options_.with_viscosity)
        table.offer("fluid", {"viscosity", Shape::scalar, "um c"}, {{f + 3, nullptr, nullptr}, size, 4});
}

FlowParameters HexSolver::flow_parameters() const { return parameters_at(options_, stage_time_); }

HexFields HexSolver::fields() const {
    return {values_.data(), force_.data(), records_.data(), flux_.data(), rate_.data(), rings_};
}

void HexSolver::evaluate() {
    const auto rings = exchange::on_gpu ? std::size_t{1} : static_cast<std::size_t>(exchange::threads());
    if (rings != rings_) {
        records_ = exchange::Buffer<double>(16 * geometry_.records() * rings);
        flux_ = exchange::Buffer<double>(4 * geometry_.fluxes() * rings);
        rings_ = rings;
    }
    evaluate_hex_residual(geometry_, boundary_.view(), flow_parameters(), fields());
    ++evaluations_;
}

void HexSolver::set_time(double t) {
    time_ = t;
    if (t == stage_time_) return;
    stage_time_ = t;
    boundary_.set_time(t);
}

void HexSolver::evaluate_at(double t) {
    set_time(t);
    evaluate();
}

void HexSolver::step(double dt) {
    const double start = time_;
    if (options_.scheme == Scheme::euler) {
        evaluate_at(start);
        update_hex(cells(), values_.data(), rate_.data(), nullptr, {dt, 0, false, false, false, nullptr},
                   values_.data());
    } else {
        runge_kutta(dt, nullptr, dt);
    }
    set_time(start + dt);
}

void HexSolver::runge_kutta(double dt, const double* local_dt, double advance) {
    if (base_.size() == 0) {
        base_ = exchange::Buffer<double>(4 * cells());
        sum_ = exchange::Buffer<double>(4 * cells());
    }
    exchange::copy_on_device(base_.data(), values_.data(), base_.size() * sizeof(double));
    const double start = time_;
    const double time[4] = {0, 0.5, 0.5, 1}, factor[3] = {0.5, 0.5, 1}, weight[4] = {1, 2, 2, 1};
    for (int stage = 0; stage < 3; ++stage) {
        evaluate_at(start + time[stage] * advance);
        update_hex(cells(), base_.data(), rate_.data(), sum_.data(),
                   {factor[stage] * dt, weight[stage], true, stage == 0, false, local_dt}, values_.data());
    }
    evaluate_at(start + advance);
    update_hex(cells(), base_.data(), rate_.data(), sum_.data(),
               {dt / 6, weight[3], false, false, true, local_dt}, values_.data());
}

double HexSolver::largest_step(double speed) const {
    return stable_step(grid_, largest_delta(options_), idle_faces(grid_, boundary_.patches()),
                       options_.scheme, std::max(options_.nu, options_.largest_nu), speed, options_.gamma);
}

void HexSolver::set_local_steps(double sigma, double c) {
    if (local_dt_.size() == 0) local_dt_ = exchange::Buffer<double>(cells());
    hex_local_steps(geometry_.view(), values_.data(), {sigma, c, options_.nu, options_.gamma},
                    local_dt_.data());
}

void HexSolver::local_step() {
    if (local_dt_.size() == 0) throw std::logic_error("HexSolver::local_step: set_local_steps() comes first");
    runge_kutta(1, local_dt_.data(), 0);
}

void HexSolver::read_conserved(double* q) const { hex_conserved(cells(), values_.data(), q); }
void HexSolver::write_conserved(const double* q) { hex_values(cells(), q, values_.data()); }
void HexSolver::read_residual(double* r) const { hex_components(cells(), rate_.data(), r); }
void HexSolver::read_local_steps(double* dt) const {
    if (local_dt_.size() == 0)
        throw std::logic_error("HexSolver::read_local_steps: set_local_steps() comes first");
    exchange::copy_on_device(dt, local_dt_.data(), cells() * sizeof(double));
}

ResidualNorm HexSolver::residual_norm() {
    if (evaluations_ == 0) return {NAN, {NAN, NAN, NAN}};
    return hex_norm(cells(), rate_.data());
}
double HexSolver::mean_density() { return hex_mean_density(geometry_.view(), values_.data()); }
double HexSolver::largest_speed() { return hex_largest_speed(cells(), values_.data()); }
std::size_t HexSolver::first_bad_cell() { return hex_first_bad(cells(), values_.data()); }

std::vector<std::array<Vec3d, 4>> HexSolver::gradients() const {
    fill_ghost_values(geometry_.view(), boundary_.view(), values_.data());
    exchange::Buffer<double> all_records(16 * cells());
    HexFields whole = fields();
    whole.records = all_records.data();
    evaluate_gradients(geometry_.whole_view(), whole);
    const std::vector<double> records = all_records.to_host();
    std::vector<std::array<Vec3d, 4>> all(cells());
    for (std::size_t i = 0; i < cells(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            all[i][c] = {records[16 * i + 4 + c], records[16 * i + 8 + c], records[16 * i + 12 + c]};
    return all;
}

}  // namespace hemoflux::fluid
