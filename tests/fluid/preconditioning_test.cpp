#include "fluid/preconditioning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

meshing::RectilinearGrid cube(double length, int n) {
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::uniform_axis(0, length, n));
    return grid;
}

}  // namespace

// Table 4.2: CN, Gamma_vc and the largest streaming distance with tau - 1/2 >= 0.05, on L = 10 with 45 (90480 cells) and 61
// cells along an edge.
TEST(Preconditioning, Table42) {
    struct Row {
        double u, re, gamma, condition, ratio, delta;
        int n;
    };
    const Row rows[] = {{0.1, 100, 1, 6.77, 0.622, 0.60, 45},     {0.1, 100, 0.2, 2.15, 3.11, 3.00, 45},
                        {0.01, 100, 1, 58.73, 0.06, 0.06, 45},    {0.01, 100, 0.02, 2.15, 3.11, 3.00, 45},
                        {0.1, 1000, 1, 6.77, 0.062, 0.06, 45},    {0.1, 1000, 0.2, 2.15, 0.311, 0.30, 45},
                        {0.01, 1000, 1, 58.73, 0.006, 0.006, 45}, {0.01, 1000, 0.02, 2.15, 0.311, 0.30, 45},
                        {0.1, 100, 1, 6.77, 0.854, 0.6, 61},      {0.1, 1000, 1, 6.77, 0.085, 0.06, 61}};
    for (const Row& r : rows) {
        const PreconditioningInput in{r.u, r.u * 10 / r.re, 0.05, r.gamma};
        const PreconditioningChoice c = choose_preconditioning(cell_shapes(cube(10, r.n)), in);
        EXPECT_NEAR(c.condition, r.condition, r.condition > 10 ? 0.01 : 0.006) << r.re << " " << r.u;
        EXPECT_NEAR(c.common_ratio, r.ratio, 0.012 * r.ratio + 0.003) << r.re << " " << r.u;
        EXPECT_NEAR(c.delta_max, r.delta, 1e-12);
        EXPECT_NEAR(c.common_ratio, 8 * c.mach * r.n / (r.gamma * r.re), 1e-9);  // (4.17)
        EXPECT_NEAR(c.common_size, 10.0 / r.n, 1e-12);
        EXPECT_NEAR(c.largest_ratio, c.common_ratio, 1e-12 + 1e-9 * c.common_ratio);
    }
}

// Table 4.3: condition numbers; gamma there is 0.05 where its Tables 4.4 and 4.5 print 0.02.
TEST(Preconditioning, ConditionNumbers) {
    const double fast = 0.1 * std::sqrt(3.0), slow = 0.01 * std::sqrt(3.0);
    EXPECT_NEAR(condition_number(1, fast), 6.77, 0.005);
    EXPECT_NEAR(condition_number(0.2, fast), 2.15, 0.006);
    EXPECT_NEAR(condition_number(0.5, fast), 3.88, 0.007);
    EXPECT_NEAR(condition_number(0.75, fast), 5.33, 0.005);
    EXPECT_NEAR(condition_number(1, slow), 58.73, 0.01);
    EXPECT_NEAR(condition_number(0.05, slow), 3.88, 0.007);
    // Without preconditioning the corrected eigenvalues u, u +- c_s give the same number.
    EXPECT_NEAR(corrected_condition_number(1, slow), condition_number(1, slow), 1e-9);
    // u = 0.01, gamma = 0.02: sqrt(0.98 u^2 + gamma^2 / 3) = 0.0152097, so (u + 0.0152097) / 0.0052097.
    EXPECT_NEAR(corrected_condition_number(0.02, slow), 0.0252097 / 0.0052097, 1e-3);
}

TEST(Preconditioning, ChoosesByTable41) {
    // Convection rules at 2 Ma: step 1 stands.
    const auto shapes = cell_shapes(cube(10, 45));
    PreconditioningChoice c = choose_preconditioning(shapes, {0.01, 1e-4, 0.05, 0});
    EXPECT_NEAR(c.gamma, 2 * 0.01 * std::sqrt(3.0), 1e-12);
    EXPECT_LT(c.common_ratio, 1);
    EXPECT_NE(c.reasoning.find("gamma = 2 Ma"), std::string::npos);
    EXPECT_NE(c.reasoning.find("100.0 %"), std::string::npos);
    // Viscosity rules: raised until Gamma_vc = 1 there.
    c = choose_preconditioning(shapes, {0.01, 1e-3, 0.05, 0});
    EXPECT_NEAR(c.common_ratio, 1, 1e-12);
    EXPECT_NEAR(c.gamma, 8 * 0.01 * std::sqrt(3.0) * 45 / 100, 1e-12);
    // Never above 1.
    EXPECT_EQ(choose_preconditioning(shapes, {0.01, 1, 0.05, 0}).gamma, 1);
    EXPECT_THROW(choose_preconditioning(shapes, {0, 1, 0.05, 0}), InputError);
    EXPECT_THROW(choose_preconditioning(shapes, {0.1, 1, 0.05, 1.5}), InputError);
}

// Three quarters of the cells are wide, one quarter is fine: the wide ones count.
TEST(Preconditioning, MostCommonSizeOfAGradedGrid) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::explicit_axis({0, 0.1, 1.1, 2.1, 3.1}), meshing::uniform_axis(0, 4, 4),
                 meshing::uniform_axis(0, 4, 4)};
    const PreconditioningChoice c = choose_preconditioning(cell_shapes(grid), {0.01, 1e-3, 0, 0});
    EXPECT_NEAR(c.common_size, 1, 1e-12);
    EXPECT_EQ(c.histogram.back().count, 48u);
    EXPECT_EQ(c.histogram.front().count, 16u);
    EXPECT_EQ(c.delta_max, 0);
}

TEST(Preconditioning, ShapesIgnoreAThinDirection) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 1, 4), meshing::uniform_axis(0, 1, 4),
                 meshing::uniform_axis(0, 7, 1)};
    for (const CellShape& s : cell_shapes(grid)) EXPECT_NEAR(equivalent_edge(s), 0.25, 1e-15);
}

}  // namespace hemoflux::fluid
