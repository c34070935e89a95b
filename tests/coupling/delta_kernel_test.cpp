#include "coupling/delta_kernel.hpp"

#include <gtest/gtest.h>

#include <random>

#include "grids.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

namespace {

/// Positions where a kernel may go wrong: at random, at centres, at faces (the walls among them).
std::vector<double> positions(const meshing::Axis& axis) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> uniform(axis.lower(), axis.upper());
    std::vector<double> points;
    for (int i = 0; i < 2000; ++i) points.push_back(uniform(engine));
    const auto centres = axis.centres();
    points.insert(points.end(), centres.begin(), centres.end());
    points.insert(points.end(), axis.faces.begin(), axis.faces.end());
    return points;
}

template <class Function>
void for_all_axes(Function check) {
    if (exchange::on_gpu) return;
    for (const auto& [name, axis] : test::axes())
        for (const bool periodic : {false, true}) {
            const AxisData data(axis, periodic, "x");
            const AxisView v = data.view();
            SCOPED_TRACE(name + (periodic ? " periodic" : " walls"));
            for (double X : positions(axis)) {
                int turns;
                check(v, v.wrap(X, &turns));
            }
        }
}

template <class K>
class Kernels : public ::testing::Test {};
using All = ::testing::Types<Phi2, Phi3, Phi4, Lagrange>;
TYPED_TEST_SUITE(Kernels, All);
template <class K>
class SmoothKernels : public ::testing::Test {};
using Smooth = ::testing::Types<Phi2, Phi3, Phi4>;
TYPED_TEST_SUITE(SmoothKernels, Smooth);

}  // namespace

// sum w = 1 and sum w x = X to 1e-14 (of one cell width), stencil inside the domain between walls.
TYPED_TEST(Kernels, ZerothAndFirstMomentsAreExact) {
    for_all_axes([](const AxisView& v, double X) {
        double w[4];
        const int first = TypeParam{}(v, X, w);
        double zeroth = 0, moment = 0, scale = 0;
        for (int a = 0; a < 4; ++a) {
            zeroth += w[a];
            moment += w[a] * (v.centre[first + a] - X);
            scale = std::max(scale, v.width[first + a]);
            EXPECT_LE(std::fabs(w[a]), 4);
        }
        EXPECT_NEAR(zeroth, 1, 1e-14) << X;
        EXPECT_NEAR(moment / scale, 0, 1e-14) << X;
        if (v.periodic) {
            EXPECT_GE(first, -2);
            EXPECT_LE(first, v.n - 2);
        } else {
            EXPECT_GE(first, 0);
            EXPECT_LE(first, v.n - 4);
        }
    });
}

// Weights change by O(dX): no jumps where the stencil shifts, at walls and at the seam.
TYPED_TEST(Kernels, WeightsAreContinuous) {
    for_all_axes([](const AxisView& v, double X) {
        const double Y = X + 1e-9;
        if (Y >= v.upper) return;
        double wx[4], wy[4];
        const int fx = TypeParam{}(v, X, wx), fy = TypeParam{}(v, Y, wy);
        for (int k = std::min(fx, fy); k < std::max(fx, fy) + 4; ++k) {
            const double a = k >= fx && k < fx + 4 ? wx[k - fx] : 0,
                         b = k >= fy && k < fy + 4 ? wy[k - fy] : 0;
            EXPECT_NEAR(a, b, 1e-7) << X << " cell " << k;
        }
    });
}

// On a uniform axis the weights are the published functions of the distance.
TYPED_TEST(SmoothKernels, UniformAxisGivesThePublishedFunction) {
    if (exchange::on_gpu) GTEST_SKIP();
    const AxisData data(meshing::uniform_axis(0, 16, 16), true, "x");
    const AxisView v = data.view();
    for (const double X : positions(meshing::uniform_axis(0, 15.999, 16))) {
        double w[4];
        const int first = TypeParam{}(v, X, w);
        for (int a = 0; a < 4; ++a)
            EXPECT_NEAR(w[a], TypeParam::value(std::fabs(v.centre[first + a] - X)), 1e-14) << X;
    }
}

TEST(DeltaKernel, SumsOfSquares) {
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0;
        double three = 0, four = 0;
        for (int k = -3; k <= 4; ++k) {
            const double w3 = Phi3::value(std::fabs(t - k)), w4 = Phi4::value(std::fabs(t - k));
            three += w3 * w3;
            four += w4 * w4;
        }
        EXPECT_NEAR(three, 0.5, 1e-14);
        EXPECT_NEAR(four, 0.375, 1e-14);
    }
}

TEST(DeltaKernel, PublishedValues) {
    EXPECT_DOUBLE_EQ(Phi4::value(0), 0.5);
    EXPECT_DOUBLE_EQ(Phi4::value(1), 0.25);
    EXPECT_DOUBLE_EQ(Phi4::value(2), 0);
    EXPECT_DOUBLE_EQ(Phi3::value(0), 2.0 / 3);
    EXPECT_DOUBLE_EQ(Phi3::value(0.5), 0.5);
    EXPECT_DOUBLE_EQ(Phi3::value(1), 1.0 / 6);
    EXPECT_DOUBLE_EQ(Phi3::value(1.5), 0);
    EXPECT_DOUBLE_EQ(Phi2::value(0.25), 0.75);
}

// Four cells reproduce every cubic (5.16), also at walls and across the seam.
TEST(DeltaKernel, LagrangeReproducesCubics) {
    for_all_axes([](const AxisView& v, double X) {
        double w[4];
        const int first = Lagrange{}(v, X, w);
        double sum = 0;
        const auto cubic = [X](double x) {
            return 1 - 2 * (x - X) + 0.7 * std::pow(x - X, 2) - 0.3 * std::pow(x - X, 3);
        };
        for (int a = 0; a < 4; ++a) sum += w[a] * cubic(v.centre[first + a]);
        EXPECT_NEAR(sum, 1, 3e-14) << X;
    });
}

// Fewer cells than the stencil is wide: a periodic axis folds the weights onto the cells it has.
TEST(DeltaKernel, ThinPeriodicAxis) {
    if (exchange::on_gpu) GTEST_SKIP();
    for (const int n : {1, 2, 3}) {
        const AxisData data(meshing::uniform_axis(0, n, n), true, "z");
        const AxisView v = data.view();
        for (const double X : {0.0, 0.3, 0.5, 0.99 * n}) {
            double w[4], sum = 0;
            const int first = Phi4{}(v, X, w);
            for (int a = 0; a < 4; ++a) {
                sum += w[a];
                EXPECT_GE(v.cell(first + a), 0);
                EXPECT_LT(v.cell(first + a), n);
            }
            EXPECT_NEAR(sum, 1, 1e-14);
        }
    }
}
