#include "membrane/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

#include "exchange/error.hpp"

namespace hemoflux::membrane {
namespace {

/// The residuals as functions of the free variables u.
class Free {
  public:
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

    Free(const std::vector<FitParameter>& parameters, const Residuals& residuals)
        : parameters_(parameters), residuals_(residuals) {}

    [[nodiscard]] Eigen::VectorXd start() const {
        Eigen::VectorXd u(inputs());
        for (int i = 0; i < inputs(); ++i) {
            const FitParameter& p = at(i);
            // at a bound itself the derivative by u vanishes, and the fit would never leave it
            const double t = std::clamp((p.start - p.low) / (p.high - p.low), 0.01, 0.99);
            u[i] = std::asin(2 * t - 1);
        }
        return u;
    }
    [[nodiscard]] std::vector<double> bounded(const Eigen::VectorXd& u) const {
        std::vector<double> p;
        for (int i = 0; i < inputs(); ++i)
            p.push_back(at(i).low + (at(i).high - at(i).low) * (1 + std::sin(u[i])) / 2);
        return p;
    }
    Eigen::VectorXd at_parameters(const std::vector<double>& p) {
        ++evaluations;
        const std::vector<double> r = residuals_(p);
        values_ = static_cast<int>(r.size());
        return Eigen::Map<const Eigen::VectorXd>(r.data(), values_);
    }
    /// dr/dp by central differences, one-sided next to a bound.
    Eigen::MatrixXd jacobian(const std::vector<double>& p) {
        Eigen::MatrixXd j(values_, inputs());
        for (int i = 0; i < inputs(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            auto up = p, down = p;
            up[k] = std::min(p[k] + at(i).step, at(i).high);
            down[k] = std::max(p[k] - at(i).step, at(i).low);
            j.col(i) = (at_parameters(up) - at_parameters(down)) / (up[k] - down[k]);
        }
        return j;
    }

    int operator()(const Eigen::VectorXd& u, Eigen::VectorXd& r) {
        r = at_parameters(bounded(u));
        return 0;
    }
    int df(const Eigen::VectorXd& u, Eigen::MatrixXd& j) {
        j = jacobian(bounded(u));
        for (int i = 0; i < inputs(); ++i) j.col(i) *= (at(i).high - at(i).low) / 2 * std::cos(u[i]);
        return 0;
    }
    [[nodiscard]] int inputs() const { return static_cast<int>(parameters_.size()); }
    [[nodiscard]] int values() const { return values_; }
    void prepare(const Eigen::VectorXd& u) { at_parameters(bounded(u)); }

    int evaluations = 0;

  private:
    [[nodiscard]] const FitParameter& at(int i) const { return parameters_[static_cast<std::size_t>(i)]; }
    const std::vector<FitParameter>& parameters_;
    const Residuals& residuals_;
    int values_ = 0;
};

void check(const std::vector<FitParameter>& parameters) {
    for (const FitParameter& p : parameters)
        if (!(p.low < p.high) || !(p.step > 0))
            throw InputError(fmt::format("a parameter between {} and {}, step {}", p.low, p.high, p.step),
                             "the range must not be empty and the step be positive", "Correct the bounds");
}

}  // namespace

FitResult fit(const std::vector<FitParameter>& parameters, const Residuals& residuals) {
    check(parameters);
    Free problem(parameters, residuals);
    Eigen::VectorXd u = problem.start();
    problem.prepare(u);
    const int n = problem.values(), p = problem.inputs();
    if (n <= p)
        throw InputError(fmt::format("{} measurements for {} parameters", n, p),
                         "a fit needs more measurements than parameters", "Give more forces");
    Eigen::LevenbergMarquardt<Free> method(problem);
    method.parameters.ftol = 1e-6;
    method.parameters.xtol = 1e-5;
    method.parameters.maxfev = 60;
    method.minimize(u);

    FitResult result;
    result.parameters = problem.bounded(u);
    const Eigen::VectorXd r = problem.at_parameters(result.parameters);
    result.residuals.assign(r.data(), r.data() + r.size());
    result.chi2 = r.squaredNorm();
    const Eigen::MatrixXd j = problem.jacobian(result.parameters);
    const Eigen::MatrixXd covariance = (j.transpose() * j).inverse();
    const double scatter = std::sqrt(result.chi2 / (n - p));
    const double t = boost::math::quantile(boost::math::students_t(n - p), 0.975);
    for (int i = 0; i < p; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const FitParameter& range = parameters[k];
        result.by_weights.push_back(std::sqrt(covariance(i, i)));
        result.by_scatter.push_back(result.by_weights.back() * scatter);
        result.half_95.push_back(t * result.by_scatter.back());
        const double value = result.parameters[k], margin = 1e-3 * (range.high - range.low);
        result.at_bound.push_back(value < range.low + margin || value > range.high - margin);
    }
    if (p > 1) result.correlation = covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
    result.evaluations = problem.evaluations;
    return result;
}

}  // namespace hemoflux::membrane
