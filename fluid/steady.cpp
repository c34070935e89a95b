#include "fluid/steady.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <optional>

#include "exchange/error.hpp"
#include "fluid/cell_report.hpp"

namespace hemoflux::fluid {
namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Turns residuals or velocities into what the criterion compares.
class Measure {
  public:
    Measure(Flow& flow, SteadyCriterion criterion) : flow_(flow), criterion_(criterion) {
        if (criterion_ != SteadyCriterion::velocity_change) return;
        before_ = exchange::Buffer<double>(4 * flow.cells());
        now_ = exchange::Buffer<double>(4 * flow.cells());
        flow_.read_conserved(before_.data());
    }

    double operator()(const ResidualNorm& r) {
        if (criterion_ == SteadyCriterion::velocity_change) return velocity_change();
        double all = r.density * r.density;
        for (const double m : r.momentum) all += m * m;
        if (reference_ == 0) {
            // A flow without any rho u residual is judged by all components.
            momentum_x_ = criterion_ == SteadyCriterion::momentum_x && r.momentum[0] > 0;
            reference_ = momentum_x_ ? r.momentum[0] : std::sqrt(all);
            if (reference_ == 0) return 0;
        }
        return (momentum_x_ ? r.momentum[0] : std::sqrt(all)) / reference_;
    }

  private:
    double velocity_change() {
        const std::size_t cells = flow_.cells(), n = 3 * cells;
        flow_.read_conserved(now_.data());
        perturb(now_.data(), before_.data(), -1, before_.data(), 4 * cells);
        const double change = sum_of_squares(before_.data() + cells, n),
                     all = sum_of_squares(now_.data() + cells, n);
        std::swap(before_, now_);
        return all > 0 ? std::sqrt(change / all) : std::sqrt(change);
    }

    Flow& flow_;
    SteadyCriterion criterion_;
    exchange::Buffer<double> before_, now_;
    double reference_ = 0;
    bool momentum_x_ = false;
};

void check_finite(Flow& flow, const SteadyRecord& record) {
    if (std::isfinite(record.measure) && record.measure < 1e3 && record.iteration % 100 != 0) return;
    const std::size_t bad = flow.first_bad_cell();
    if (bad == flow.cells() && std::isfinite(record.measure)) return;
    throw NumericalError(
        describe_cell(flow, bad < flow.cells() ? bad : 0),
        fmt::format("density or speed left its range in iteration {} on the way to the steady state",
                    record.iteration),
        "lower the Courant number, or raise tau_floor or the viscosity");
}

}  // namespace

SteadyResult find_steady_state(Flow& flow, const SteadyOptions& options, const SteadyObserver& observer,
                               Constraint* constraint) {
    if (!(options.tolerance > 0))
        throw InputError(fmt::format("tolerance {}", options.tolerance), "a residual never falls to zero",
                         "give a positive tolerance");
    const double start = processor_seconds();
    const std::size_t before = flow.evaluations();
    const bool implicit = options.method == SteadyMethod::newton;
    if (constraint && !implicit)
        throw InputError("local time steps with a constraint",
                         "its forces are unknowns that only the implicit method solves for",
                         "use the implicit method");
    const std::size_t patience = implicit ? options.newton_patience : options.patience;
    Measure measure(flow, options.criterion);
    std::optional<NewtonKrylov> newton;
    SteadyResult result;
    std::size_t lowest_at = 0;
    if (constraint && flow.largest_speed() == 0) {  // differences of residuals need a scale of velocity
        flow.set_local_steps(options.sigma, options.c);
        flow.local_step();
    }
    for (std::size_t iteration = 1; iteration <= options.most_iterations; ++iteration) {
        SteadyRecord record;
        record.iteration = iteration;
        bool moved = true;
        if (constraint || (implicit && iteration > 1)) {
            if (!newton) {
                newton.emplace(flow, options.newton, constraint);
                result.bytes = newton->bytes();
            }
            const NewtonKrylov::Step step = newton->step();
            record.krylov = step.krylov;
            record.courant = step.courant;
            moved = step.accepted;
        } else {
            flow.set_local_steps(options.sigma, options.c);
            flow.local_step();
            record.courant = options.sigma;
        }
        record.residual = flow.residual_norm();
        if (constraint)
            record.measure = newton->relative_residual();
        else
            record.measure = moved ? measure(record.residual) : result.last.measure;
        record.evaluations = flow.evaluations() - before;
        record.seconds = processor_seconds() - start;
        check_finite(flow, record);
        result.last = record;
        if (iteration == 1 || record.measure < result.lowest) {
            result.lowest = record.measure;
            lowest_at = iteration;
        }
        if (observer && !observer(record)) {
            result.end = SteadyEnd::interrupted;
            return result;
        }
        if (moved && iteration > 1 && record.measure < options.tolerance) {
            result.end = SteadyEnd::converged;
            return result;
        }
        if (iteration - lowest_at >= patience) {
            result.end = SteadyEnd::stalled;
            return result;
        }
    }
    return result;
}

std::string describe(SteadyEnd end) {
    switch (end) {
        case SteadyEnd::converged:
            return "steady";
        case SteadyEnd::most_iterations:
            return "not steady after the most iterations allowed";
        case SteadyEnd::stalled:
            return "stalled: the residual no longer falls";
        case SteadyEnd::interrupted:
            return "interrupted";
    }
    return "";
}

}  // namespace hemoflux::fluid
