#include "membrane/relax.hpp"

#include <LBFGS.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

#include "exchange/error.hpp"
#include "exchange/memory.hpp"

namespace hemoflux::membrane {
namespace {

using Vector = Eigen::VectorXd;

/// The energy as a function of all coordinates: x of every vertex, then y, then z.
class Objective {
  public:
    Objective(Batch& batch, const Potential& potential, double tolerated_force, double first_move)
        : tolerance(tolerated_force),
          largest_move(first_move),
          batch_(batch),
          n_(batch.vertices()),
          potential_(potential) {}

    /// Energy with the added potential at r, and its gradient; huge, the gradient unchanged, where a spring
    /// is beyond its contour length, so that a line search turns back.
    double operator()(const Vector& r, Vector& gradient) {
        ++evaluations;
        write(r);
        if (!batch_.try_compute_forces()) return 1e100;
        read(batch_.fx(), 0, gradient);
        read(batch_.fy(), 1, gradient);
        read(batch_.fz(), 2, gradient);
        gradient = -gradient;
        double energy = batch_.energies(0).total();
        if (potential_) {
            const auto size = static_cast<std::size_t>(dimension());
            energy += potential_({r.data(), size}, {gradient.data(), size});
        }
        const auto n = static_cast<Eigen::Index>(n_);
        const auto f = gradient.reshaped(n, 3);
        const double force = f.rowwise().norm().maxCoeff();
        if (energy < best_energy) {
            best_energy = energy;
            best = r;
        }
        largest_force = force;
        return energy;
    }

    [[nodiscard]] bool converged() const { return largest_force <= tolerance; }

    [[nodiscard]] Vector start() const {
        Vector r(dimension());
        read(batch_.x(), 0, r);
        read(batch_.y(), 1, r);
        read(batch_.z(), 2, r);
        return r;
    }

    void write(const Vector& r) {
        exchange::copy_to_device(batch_.x().data(), r.data(), n_ * sizeof(double));
        exchange::copy_to_device(batch_.y().data(), r.data() + n_, n_ * sizeof(double));
        exchange::copy_to_device(batch_.z().data(), r.data() + 2 * n_, n_ * sizeof(double));
    }

    [[nodiscard]] Eigen::Index dimension() const { return static_cast<Eigen::Index>(3 * n_); }

    const double tolerance, largest_move;
    int iterations = 0, evaluations = 0;
    double largest_force = 0, best_energy = 1e99;
    Vector best;

  private:
    void read(const exchange::Buffer<double>& field, std::size_t axis, Vector& r) const {
        exchange::copy_to_host(r.data() + axis * n_, field.data(), n_ * sizeof(double));
    }

    Batch& batch_;
    std::size_t n_;
    const Potential& potential_;
};

/// The library's backtracking, with the first trial shortened to `largest_move`. LBFGSSolver stops on the
/// 2-norm of the gradient; a gradient of zero tells it that the largest force has met the tolerance.
template <class Scalar>
struct ShortSteps {
    template <class Function>
    static void LineSearch(Function& f, Scalar& fx, Vector& x, Vector& gradient, Scalar& step,
                           const Vector& direction, const Vector& start,
                           const LBFGSpp::LBFGSParam<Scalar>& parameters) {
        step = std::min(step, f.largest_move / direction.cwiseAbs().maxCoeff());
        LBFGSpp::LineSearchBacktracking<Scalar>::LineSearch(f, fx, x, gradient, step, direction, start,
                                                            parameters);
        ++f.iterations;
        if (f.converged()) gradient.setZero();
    }
};

/// Restarts that forget the history after a line search without success; rounding may need one.
constexpr int restarts = 4;

void check_cells(const Batch& batch) {
    if (batch.cells() != 1)
        throw InputError(fmt::format("a batch of {} cells", batch.cells()), "one cell is relaxed at a time",
                         "Make a batch of one cell");
}

void check_load(const Batch& batch, const std::vector<Vec3d>& load) {
    if (!load.empty() && load.size() != batch.vertices())
        throw InputError(fmt::format("{} loads", load.size()),
                         fmt::format("the cell has {} vertices", batch.vertices()),
                         "Give one load per vertex, or none");
}

}  // namespace

void RelaxOptions::check() const {
    const auto positive = [](const char* name, double value) {
        if (!(value > 0))
            throw InputError(fmt::format("relaxation: {} = {}", name, value), "it must be positive",
                             "Correct it");
    };
    positive("tolerance", tolerance);
    positive("max_iterations", max_iterations);
    positive("history", history);
    positive("largest_move", largest_move);
}

Potential dead_load(const std::vector<Vec3d>& load) {
    if (load.empty()) return {};
    return [load](std::span<const double> r, std::span<double> gradient) {
        const std::size_t n = load.size();
        double work = 0;
        for (std::size_t v = 0; v < n; ++v) {
            work += load[v].x * r[v] + load[v].y * r[n + v] + load[v].z * r[2 * n + v];
            gradient[v] -= load[v].x;
            gradient[n + v] -= load[v].y;
            gradient[2 * n + v] -= load[v].z;
        }
        return -work;
    };
}

RelaxResult relax(Batch& batch, const RelaxOptions& options, const std::vector<Vec3d>& load) {
    check_cells(batch);
    check_load(batch, load);
    return minimise(batch, options, dead_load(load));
}

RelaxResult minimise(Batch& batch, const RelaxOptions& options, const Potential& potential) {
    options.check();
    check_cells(batch);
    batch.compute_forces();  // names the spring when the start is beyond a contour length
    const std::vector<double>& lengths = batch.reference().edge_lengths;
    const double mean =
        std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
    Objective objective(batch, potential, options.tolerance, options.largest_move * mean);

    LBFGSpp::LBFGSParam<double> parameters;
    parameters.m = options.history;
    parameters.epsilon = 0;
    parameters.epsilon_rel = 0;
    parameters.linesearch = LBFGSpp::LBFGS_LINESEARCH_BACKTRACKING_WOLFE;
    parameters.max_linesearch = 40;

    Vector r = objective.start(), gradient(objective.dimension());
    double energy = objective(r, gradient);
    RelaxResult result;
    for (int attempt = 0; attempt <= restarts && !objective.converged(); ++attempt) {
        parameters.max_iterations = options.max_iterations - objective.iterations;
        if (parameters.max_iterations <= 0) break;
        LBFGSpp::LBFGSSolver<double, ShortSteps> solver(parameters);
        try {
            solver.minimize(objective, r, energy);
        } catch (const std::exception&) {  // no lower energy found along the direction
            r = objective.best;
            energy = objective(r, gradient);
        }
    }
    result.iterations = objective.iterations;
    result.evaluations = objective.evaluations;
    result.largest_force = objective.largest_force;
    result.energy = batch.energies(0).total();
    if (!objective.converged())
        throw NumericalError(
            fmt::format("relaxation stopped at a force of {:.3g} after {} iterations", result.largest_force,
                        result.iterations),
            fmt::format("the tolerance is {:.3g}", options.tolerance),
            "Start nearer to the minimum, take smaller load or volume steps, or allow more iterations");
    return result;
}

RelaxResult approach(Batch& batch, const Reference& target, const RelaxOptions& options, int steps) {
    if (steps < 1)
        throw InputError(fmt::format("references reached in {} steps", steps), "it needs one", "Use 12");
    batch.compute_forces();
    const double volume = batch.sums(0).volume, curvature = batch.reference().curvature,
                 total = batch.reference().total_curvature;
    RelaxOptions coarse = options;
    coarse.tolerance *= 100;
    RelaxResult sum;
    for (int k = 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        Reference step = target;
        if (k < steps) {
            step.volume = volume + t * (target.volume - volume);
            step.curvature = curvature + t * (target.curvature - curvature);
            step.total_curvature = total + t * (target.total_curvature - total);
        }
        batch.set_reference(step);
        const RelaxResult result = relax(batch, k == steps ? options : coarse);
        sum = {.iterations = sum.iterations + result.iterations,
               .evaluations = sum.evaluations + result.evaluations,
               .largest_force = result.largest_force,
               .energy = result.energy};
    }
    return sum;
}

RelaxResult deflate(Batch& batch, double volume, const RelaxOptions& options, int steps) {
    Reference target = batch.reference();
    target.volume = volume;
    return approach(batch, target, options, steps);
}

}  // namespace hemoflux::membrane
