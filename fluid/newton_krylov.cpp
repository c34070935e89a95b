#include "fluid/newton_krylov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

/// Rise of the residual at which a step is taken back.
constexpr double most_rise = 2;
/// CFL below which steps make no progress.
constexpr double smallest_courant = 1e-3;

std::vector<double> volumes(const Flow& flow) {
    std::vector<double> v(flow.cells());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = flow.volume(i);
    return v;
}

}  // namespace

NewtonKrylov::NewtonKrylov(Flow& flow, const NewtonOptions& options)
    : flow_(flow),
      options_(options),
      matrix_(flow.compact_model(), volumes(flow), options.fill),
      basis_(4 * flow.cells(), options.krylov),
      q_(4 * flow.cells()),
      r_(4 * flow.cells()),
      moved_(4 * flow.cells()),
      product_(4 * flow.cells()),
      change_(4 * flow.cells()),
      dt_(flow.cells()),
      combined_(4 * flow.cells()),
      courant_(options.first_courant) {
    flow_.read_conserved(q_.data());
    flow_.evaluate();
    flow_.read_residual(r_.data());
    set_scales();
    norm_ = norm(r_.data());
}

std::size_t NewtonKrylov::bytes() const {
    return matrix_.bytes() + basis_.bytes() + (5 * q_.size() + dt_.size()) * sizeof(double) +
           combined_.size() * sizeof(float);
}

/// Continuity and momentum count alike at the start, the three momenta with one scale. With c = 1 both residuals are of one
/// kind (sound turns one into the other), so that neither is blown up where the start leaves it without residual, as a sheared
/// layer leaves continuity: its rounding would drown the other.
void NewtonKrylov::set_scales() {
    const ResidualNorm r = flow_.residual_norm();
    const double momentum = std::sqrt(r.momentum[0] * r.momentum[0] + r.momentum[1] * r.momentum[1] +
                                      r.momentum[2] * r.momentum[2]);
    const double density = std::max(r.density, momentum);
    if (!(density > 0)) return;
    scale_[0] = 1 / density;
    for (int c = 1; c < 4; ++c) scale_[c] = 1 / std::max(momentum, 1e-3 * density);
}

double NewtonKrylov::norm(const double* r) {
    scaled(r, scale_, flow_.cells(), product_.data());
    return std::sqrt(sum_of_squares(product_.data(), product_.size()));
}

void NewtonKrylov::residual_at(const double* q, double* r) {
    flow_.write_conserved(q);
    flow_.evaluate();
    flow_.read_residual(r);
}

std::size_t NewtonKrylov::solve() {
    const std::size_t n = q_.size(), cells = flow_.cells();
    const double momentum = std::sqrt(sum_of_squares(q_.data() + cells, 3 * cells));
    scaled(r_.data(), scale_, cells, product_.data());
    const double beta = basis_.start(product_.data());
    HessenbergProblem problem(beta);
    std::size_t k = 0;
    while (k < basis_.most()) {
        matrix_.solve(basis_.vector(k), scale_, change_.data());
        const double length = std::sqrt(sum_of_squares(change_.data(), n));
        // The velocity changes by a millionth of itself: far above rounding, far below where R bends.
        const double difference =
            1e-6 * std::max(momentum, 1e-9 * std::sqrt(static_cast<double>(n))) / length;
        perturb(q_.data(), change_.data(), difference, moved_.data(), n);
        residual_at(moved_.data(), moved_.data());
        difference_product(change_.data(), dt_.data(), moved_.data(), r_.data(), difference, scale_, cells,
                           product_.data());
        ++k;
        const double left = problem.add(basis_.add(k, product_.data()));
        if (!(left > options_.linear_tolerance * beta)) break;
    }
    basis_.combine(problem.solve(), combined_.data());
    matrix_.solve(combined_.data(), scale_, change_.data());
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
    perturb(q_.data(), change_.data(), 1, change_.data(), q_.size());
    residual_at(change_.data(), moved_.data());
    const double norm_new = norm(moved_.data());
    step.accepted = norm_new < most_rise * norm_;
    if (step.accepted) {
        std::swap(q_, change_);
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
