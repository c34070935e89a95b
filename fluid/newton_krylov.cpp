#include "fluid/newton_krylov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

/// Rise of the residual at which a step is taken back.
constexpr double most_rise = 2;
/// Halvings of a step that raises the residual of a flow with a constraint.
constexpr int most_halvings = 4;
/// CFL below which steps make no progress.
constexpr double smallest_courant = 1e-3;

std::vector<double> volumes(const Flow& flow) {
    std::vector<double> v(flow.cells());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = flow.volume(i);
    return v;
}

}  // namespace

NewtonKrylov::NewtonKrylov(Flow& flow, const NewtonOptions& options, Constraint* constraint)
    : flow_(flow),
      options_(options),
      constraint_(constraint),
      cells_(flow.cells()),
      fluid_unknowns_(4 * cells_),
      forces_(constraint ? constraint->size() : 0),
      matrix_(flow.compact_model(), volumes(flow), options.fill),
      basis_(fluid_unknowns_ + forces_, options.krylov),
      q_(fluid_unknowns_ + forces_),
      r_(q_.size()),
      moved_(q_.size()),
      product_(q_.size()),
      change_(q_.size()),
      trial_(q_.size()),
      dt_(cells_),
      combined_(q_.size()),
      shifted_(constraint ? fluid_unknowns_ : 0),
      courant_(options.first_courant) {
    q_.fill(0);
    flow_.read_conserved(q_.data());
    residual_at(q_.data(), r_.data());
    set_scales();
    first_norm_ = norm_ = norm(r_.data());
    if (!constraint_ || norm_ == 0) return;
    basis_.start(r_.data());
    constraint_->estimate(basis_.vector(0) + fluid_unknowns_, change_.data() + fluid_unknowns_);
    typical_force_ = norm_ * std::sqrt(sum_of_squares(change_.data() + fluid_unknowns_, forces_));
}

std::size_t NewtonKrylov::bytes() const {
    return matrix_.bytes() + basis_.bytes() + (6 * q_.size() + dt_.size()) * sizeof(double) +
           (combined_.size() + shifted_.size()) * sizeof(float);
}

/// Continuity and momentum count alike at the start, the three momenta with one scale. With c = 1 both residuals are of one
/// kind (sound turns one into the other), so that neither is blown up where the start leaves it without residual, as a
/// sheared layer leaves continuity: its rounding would drown the other. A constraint brings its own scale: all then
/// count alike.
void NewtonKrylov::set_scales() {
    if (constraint_) return;
    const ResidualNorm r = flow_.residual_norm();
    const double momentum = std::sqrt(r.momentum[0] * r.momentum[0] + r.momentum[1] * r.momentum[1] +
                                      r.momentum[2] * r.momentum[2]);
    const double density = std::max(r.density, momentum);
    if (!(density > 0)) return;
    scale_[0] = 1 / density;
    for (int c = 1; c < 4; ++c) scale_[c] = 1 / std::max(momentum, 1e-3 * density);
}

void NewtonKrylov::scale(const double* r, double* out) {
    scaled(r, scale_, cells_, out);
    if (constraint_)
        exchange::copy_on_device(out + fluid_unknowns_, r + fluid_unknowns_, forces_ * sizeof(double));
}

double NewtonKrylov::norm(const double* r) {
    scale(r, product_.data());
    return std::sqrt(sum_of_squares(product_.data(), product_.size()));
}

void NewtonKrylov::residual_at(const double* x, double* r) {
    flow_.write_conserved(x);
    if (constraint_) constraint_->exert(x + fluid_unknowns_);
    flow_.evaluate();
    if (constraint_) constraint_->violation(x + fluid_unknowns_, r + fluid_unknowns_);
    flow_.read_residual(r);
}

void NewtonKrylov::precondition(const float* v, double* z) {
    if (!constraint_) return matrix_.solve(v, scale_, z);
    double* dF = z + fluid_unknowns_;
    constraint_->estimate(v + fluid_unknowns_, dF);
    const double length = std::sqrt(sum_of_squares(dF, forces_));
    if (length == 0) return matrix_.solve(v, scale_, z);
    // R is all but linear in F: the difference may be large.
    const double force = std::sqrt(sum_of_squares(q_.data() + fluid_unknowns_, forces_));
    const double difference = 1e-4 * std::max(force, typical_force_) / length;
    perturb(q_.data() + fluid_unknowns_, dF, difference, moved_.data(), forces_);
    constraint_->exert(moved_.data());
    flow_.write_conserved(q_.data());
    flow_.evaluate();
    flow_.read_residual(moved_.data());
    add_difference(v, moved_.data(), r_.data(), 1 / difference, shifted_.data(), fluid_unknowns_);
    matrix_.solve(shifted_.data(), scale_, z);
}

void NewtonKrylov::multiply_change() {
    const double momentum = std::sqrt(sum_of_squares(q_.data() + cells_, 3 * cells_));
    const double length = std::sqrt(sum_of_squares(change_.data(), fluid_unknowns_));
    // The velocity changes by a millionth of itself: far above rounding, far below where R bends.
    const double difference =
        1e-6 * std::max(momentum, 1e-9 * std::sqrt(static_cast<double>(fluid_unknowns_))) / length;
    perturb(q_.data(), change_.data(), difference, moved_.data(), q_.size());
    residual_at(moved_.data(), moved_.data());
    difference_product(change_.data(), dt_.data(), moved_.data(), r_.data(), difference, scale_, cells_,
                       product_.data());
    if (!constraint_) return;
    double* rows = product_.data() + fluid_unknowns_;
    perturb(r_.data() + fluid_unknowns_, moved_.data() + fluid_unknowns_, -1, rows, forces_);
    multiply(rows, 1 / difference, forces_);
}

std::size_t NewtonKrylov::solve() {
    scale(r_.data(), product_.data());
    const double beta = basis_.start(product_.data());
    HessenbergProblem problem(beta);
    std::size_t k = 0;
    while (k < basis_.most()) {
        precondition(basis_.vector(k), change_.data());
        multiply_change();
        ++k;
        const double left = problem.add(basis_.add(k, product_.data()));
        if (!(left > options_.linear_tolerance * beta)) break;
    }
    basis_.combine(problem.solve(), combined_.data());
    precondition(combined_.data(), change_.data());
    return k;
}

NewtonKrylov::Step NewtonKrylov::step() {
    Step step;
    step.courant = courant_;
    if (norm_ == 0) {
        step.accepted = true;
        return step;
    }
    flow_.write_conserved(q_.data());
    flow_.set_local_steps(courant_, 0);
    flow_.read_local_steps(dt_.data());
    matrix_.factor(q_.data(), dt_.data());
    step.krylov = solve();
    double norm_new = 0;
    // A body put into the stream changes it at once: the linear answer may overshoot and is then shortened.
    for (int halving = 0; halving <= (constraint_ ? most_halvings : 0) && !step.accepted; ++halving) {
        perturb(q_.data(), change_.data(), std::ldexp(1.0, -halving), trial_.data(), q_.size());
        residual_at(trial_.data(), moved_.data());
        norm_new = norm(moved_.data());
        step.accepted = norm_new < (constraint_ ? 1 : most_rise) * norm_;
    }
    if (step.accepted) {
        std::swap(q_, trial_);
        std::swap(r_, moved_);
        courant_ =
            std::min(options_.largest_courant, courant_ * std::clamp(norm_ / norm_new, 1.5, options_.growth));
        norm_ = norm_new;
        return step;
    }
    courant_ /= 4;
    if (courant_ < smallest_courant)
        throw NumericalError(
            "steady flow",
            fmt::format("no implicit step lowers the residual, not even with a Courant number of {:.1g}",
                        courant_),
            "use local time steps, or a larger tau_floor or viscosity");
    residual_at(q_.data(), r_.data());
    return step;
}

}  // namespace hemoflux::fluid
