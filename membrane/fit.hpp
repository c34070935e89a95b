/// Least squares with bounds: Levenberg and Marquardt's method (Eigen's translation of MINPACK) on
///   p_i = a_i + (b_i - a_i) (1 + sin u_i)/2,  u free.
#pragma once

#include <functional>
#include <vector>

namespace hemoflux::membrane {

/// Residuals of parameters, each divided by its standard deviation.
using Residuals = std::function<std::vector<double>(const std::vector<double>& parameters)>;

/// One parameter to be found.
struct FitParameter {
    double start, low, high;  ///< low < high; a start outside is moved inside
    double step;              ///< for derivatives by central differences, in its own unit; positive
};

/// Optimum and how sure it is.
struct FitResult {
    std::vector<double> parameters;
    std::vector<double> residuals;   ///< at the optimum
    double chi2 = 0;                 ///< sum of their squares
    std::vector<double> by_weights;  ///< standard errors if the standard deviations are right:
                                     ///< (J^T J)^{-1}_ii to the power 1/2
    std::vector<double> by_scatter;  ///< the same times (chi2/(n - p))^{1/2}: from the residuals themselves
    std::vector<double> half_95;     ///< half the 95 % interval, Student's t of n - p on by_scatter
    double correlation = 0;          ///< of the first two parameters
    int evaluations = 0;
    std::vector<bool> at_bound;  ///< within a thousandth of the range from a bound
};

/// The fit. InputError when a range is empty, a step is not positive, or there are no more residuals than
/// parameters; what `residuals` throws goes through.
FitResult fit(const std::vector<FitParameter>& parameters, const Residuals& residuals);

}  // namespace hemoflux::membrane
