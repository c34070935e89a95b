#include "fluid/krylov.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/backend.hpp"

namespace hemoflux::fluid {
namespace {

/// A non-symmetric matrix: 3 on the diagonal, -1 and -1.5 beside it.
std::vector<double> apply(const std::vector<double>& x) {
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        y[i] = 3 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < x.size() ? 1.5 * x[i + 1] : 0);
    return y;
}

struct Solution {
    std::vector<double> x, norms;
};

Solution gmres(const std::vector<double>& right, std::size_t most) {
    const std::size_t n = right.size();
    KrylovBasis basis(n, most);
    exchange::Buffer<double> w(right);
    HessenbergProblem problem(basis.start(w.data()));
    Solution s;
    for (std::size_t k = 1; k <= most; ++k) {
        std::vector<float> v(n);
        exchange::copy_to_host(v.data(), basis.vector(k - 1), n * sizeof(float));
        w.assign(apply(std::vector<double>(v.begin(), v.end())));
        s.norms.push_back(problem.add(basis.add(k, w.data())));
    }
    exchange::Buffer<float> x(n);
    basis.combine(problem.solve(), x.data());
    const auto values = x.to_host();
    s.x.assign(values.begin(), values.end());
    return s;
}

}  // namespace

TEST(Krylov, SolvesALinearSystem) {
    std::vector<double> x(300);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(0.3 * static_cast<double>(i * i));
    const auto right = apply(x);
    const Solution s = gmres(right, 40);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(s.x[i], x[i], 1e-4);
    // The residual that the small problem knows is that of the solution, and it never grows.
    const Solution few = gmres(right, 6);
    double rest = 0;
    const auto product = apply(few.x);
    for (std::size_t i = 0; i < x.size(); ++i) rest += (right[i] - product[i]) * (right[i] - product[i]);
    EXPECT_NEAR(few.norms.back(), std::sqrt(rest), 1e-4 * few.norms[0]);
    for (std::size_t k = 1; k < s.norms.size(); ++k) EXPECT_LE(s.norms[k], s.norms[k - 1]);
}

TEST(Krylov, SumsDoNotDependOnThreads) {
    std::vector<double> w(100003);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = std::sin(static_cast<double>(i));
    const exchange::Buffer<double> device(w);
    double sum[2];
    for (const int threads : {1, 3}) {
        exchange::set_threads(threads);
        sum[threads == 3] = sum_of_squares(device.data(), w.size());
    }
    exchange::set_threads(0);
    EXPECT_EQ(sum[0], sum[1]);
    double exact = 0;
    for (const double v : w) exact += v * v;
    EXPECT_NEAR(sum[0], exact, 1e-8);
}

}  // namespace hemoflux::fluid
