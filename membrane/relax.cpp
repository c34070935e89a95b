#include "membrane/relax.hpp"

#include <LBFGS.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <string>

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

std::string name_triangle(const Topology& topology, std::size_t k) {
    const auto& t = topology.triangles()[k];
    return fmt::format("triangle {} of vertices {}, {} and {}", k, t[0], t[1], t[2]);
}

/// Share of its contour length from which a chain is too stiff for its neighbours to converge beside it.
constexpr double stiff_chain = 0.9;

/// Throws the reason why a relaxation ended without success.
[[noreturn]] void report_failure(const Batch& batch, const RelaxResult& result, double tolerance) {
    const auto positions = batch.positions(0);
    const Topology& topology = batch.topology();
    const std::string what = fmt::format("relaxation stopped at a force of {:.3g} after {} iterations",
                                         result.largest_force, result.iterations);
    if (!is_continuum(batch.parameters().network.law)) {
        const auto lengths = edge_lengths(topology, positions);
        std::size_t longest = 0;
        double share = 0;
        for (std::size_t e = 0; e < lengths.size(); ++e) {
            const double l =
                lengths[e] / (batch.reference().stretch_ratio * batch.reference().edge_lengths[e]);
            if (l > share) share = l, longest = e;
        }
        if (share > stiff_chain)
            throw NumericalError(
                what,
                fmt::format("spring {} between vertices {} and {} is stretched to {:.1f} % of its contour "
                            "length, which no force can exceed",
                            longest, topology.edges()[longest].v1, topology.edges()[longest].v2, 100 * share),
                "Take smaller forces, or longer or stiffer springs");
    }
    const std::size_t fold = folded_triangle(topology, positions);
    if (fold < topology.triangles().size())
        throw NumericalError(
            what, name_triangle(topology, fold) + " is folded over",
            "Take smaller load or volume steps, smaller forces, or a larger local area modulus");
    throw NumericalError(what, fmt::format("the tolerance is {:.3g}", tolerance),
                         "Start nearer to the minimum, take smaller load or volume steps, or allow more "
                         "iterations");
}

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

std::size_t folded_triangle(const Topology& topology, const std::vector<Vec3d>& positions) {
    const auto at = [&positions](int v) { return positions[static_cast<std::size_t>(v)]; };
    std::vector<Vec3d> normals, around(topology.triangles().size(), Vec3d{0, 0, 0});
    for (const auto& t : topology.triangles()) {
        const Vec3d xi = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
        normals.push_back((1 / norm(xi)) * xi);
    }
    for (const Edge& e : topology.edges()) {
        around[static_cast<std::size_t>(e.a)] += normals[static_cast<std::size_t>(e.b)];
        around[static_cast<std::size_t>(e.b)] += normals[static_cast<std::size_t>(e.a)];
    }
    std::size_t k = 0;
    while (k < normals.size() && dot(normals[k], around[k]) >= 0) ++k;
    return k;
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
    if (!objective.converged()) report_failure(batch, result, options.tolerance);
    const std::size_t fold = folded_triangle(batch.topology(), batch.positions(0));
    if (fold < batch.topology().triangles().size())
        throw NumericalError(name_triangle(batch.topology(), fold) + " is folded over at the minimum",
                             "the surface has turned inside out there",
                             "Start nearer to the minimum, or take smaller load or volume steps");
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
