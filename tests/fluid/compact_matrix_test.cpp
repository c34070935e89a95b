#include "fluid/compact_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fluid/flux.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

constexpr int n = 20;
constexpr double h = 1.0 / n, delta = h / 2;

/// A row of cells along one axis with streaming distance h/2; its factors without fill are complete.
Solver row(std::size_t axis, const Patch& low, const Patch& high, double gamma) {
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::uniform_axis(0, 0.3, 1));
    grid.axes[axis] = meshing::uniform_axis(0, 1, n);
    Patches p;
    p.fill(periodic_patch());
    p[2 * axis] = low;
    p[2 * axis + 1] = high;
    SolverOptions o;
    o.nu = 0.02;
    o.gamma = gamma;
    o.tau_floor = 3 * o.nu / (gamma * delta);
    Solver solver(grid, p, o);
    solver.initialise([axis](const Vec3d& x) {
        const double s = axis == 0 ? x.x : axis == 1 ? x.y : x.z;
        return FlowPoint{1 + 0.01 * std::sin(5 * s),
                         {0.05 * std::cos(3 * s), 0.08 * s, 0.03 * std::sin(4 * s)}};
    });
    return solver;
}

using State4 = std::array<double, 4>;

/// Density and velocity of the ghost beside a border cell, by the formulas of fluid/boundary.hpp.
State4 ghost(const Patch& patch, std::size_t axis, State4 q) {
    const Vec3d u = patch.velocity_profile ? patch.velocity_profile({}) : Vec3d{0, 0, 0};
    const double given[3] = {u.x, u.y, u.z}, density = patch.density_profile ? patch.density_profile({}) : 1;
    if (patch.density == DensityCondition::given) q[0] = 2 * density - q[0];
    if (patch.density == DensityCondition::given_gradient) q[0] -= h * density;
    for (std::size_t c = 0; c < 3; ++c) {
        if (patch.velocity == VelocityCondition::given) q[1 + c] = 2 * given[c] - q[1 + c];
        if (patch.velocity == VelocityCondition::symmetry && c == axis) q[1 + c] = -q[1 + c];
    }
    return q;
}

/// dQ/dt of a row from fluxes between cell values without gradients.
std::vector<double> compact_residual(const std::vector<double>& q, std::size_t axis, const Patch (&end)[2],
                                     double gamma) {
    const auto cell = [&](std::size_t i) {
        return State4{q[i], q[n + i] / q[i], q[2 * n + i] / q[i], q[3 * n + i] / q[i]};
    };
    std::vector<double> rate(q.size(), 0.0);
    for (std::size_t f = 0; f <= n; ++f) {
        const State4 left = f > 0 ? cell(f - 1) : ghost(end[0], axis, cell(0)),
                     right = f < n ? cell(f) : ghost(end[1], axis, cell(n - 1));
        const std::size_t component[4] = {0, 1 + axis, 1 + (axis + 1) % 3, 1 + (axis + 2) % 3};
        FaceSide<double> sides[2]{};
        for (std::size_t c = 0; c < 4; ++c) {
            sides[0].phi[c] = left[component[c]];
            sides[1].phi[c] = right[component[c]];
        }
        const double none[3] = {0, 0, 0};
        Quad<double> flux = face_flux<false, true>(sides[0], sides[1],
                                                   FaceGeometry<double>{h / 2, h / 2, 0.5, delta, 1 / delta},
                                                   0.02, none, 1 / gamma);
        const auto closed = [](const Patch& p) { return p.velocity != VelocityCondition::zero_gradient; };
        if ((f == 0 && closed(end[0])) || (f == n && closed(end[1]))) flux.c[0] = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            if (f > 0) rate[component[c] * n + f - 1] -= flux.c[c] / h;
            if (f < n) rate[component[c] * n + f] += flux.c[c] / h;
        }
    }
    return rate;
}

}  // namespace

// (I/dt - J) z by differences of the fluxes written out above, then the factors: z comes back, for every axis and every
// condition of the border, to single precision (3e-7). Terms of 1/gamma^2 beside ones of order 1 cost digits at gamma = 0.1,
// most where the density has a given gradient, as the elimination does not pivot: 2.4e-4 with g++ and 512-bit packs, 7.0e-4
// with clang and 256-bit ones.
TEST(CompactMatrix, SolvesARowExactly) {
    Patch inflow = velocity_patch([](const Vec3d&) { return Vec3d{0.05, 0.02, 0.01}; });
    inflow.density = DensityCondition::given;
    Patch gradient = wall_patch();
    gradient.density = DensityCondition::given_gradient;
    gradient.density_profile = [](const Vec3d&) { return 0.03; };
    const Patch ends[][2] = {
        {inflow, density_patch(1.001)}, {gradient, open_patch()}, {symmetry_patch(), density_patch(1)}};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const auto& end : ends)
            for (const double gamma : {1.0, 0.1}) {
                Solver solver = row(axis, end[0], end[1], gamma);
                exchange::Buffer<double> q(4 * n), dt(n), x(4 * n);
                solver.read_conserved(q.data());
                const double step = 1e-8, time_step = 0.02, scale[4] = {2, 3, 3, 3};
                dt.fill(time_step);
                const std::vector<double> state = q.to_host();
                std::vector<double> z(4 * n), moved = state, volume(n);
                for (std::size_t i = 0; i < n; ++i) volume[i] = solver.volume(i);
                for (std::size_t i = 0; i < z.size(); ++i) {
                    z[i] = std::sin(1.7 * static_cast<double>(i) + 0.3);
                    moved[i] += step * z[i];
                }
                const auto before = compact_residual(state, axis, end, gamma),
                           after = compact_residual(moved, axis, end, gamma);
                std::vector<float> right;
                for (std::size_t i = 0; i < z.size(); ++i)
                    right.push_back(static_cast<float>(scale[i / n] *
                                                       (z[i] / time_step - (after[i] - before[i]) / step)));
                CompactMatrix matrix(solver.compact_model(), volume);
                matrix.factor(q.data(), dt.data());
                matrix.solve(exchange::Buffer<float>(right).data(), scale, x.data());
                const auto solution = x.to_host();
                for (std::size_t i = 0; i < z.size(); ++i)
                    ASSERT_NEAR(solution[i], z[i], gamma == 1 ? 1e-6 : 1e-3)
                        << axis << " " << &end - ends << " " << gamma << " " << i;
            }
}

// Levels: every row comes after its neighbours of lower number, and each level's rows are no neighbours.
TEST(CompactPattern, LevelsRespectTheOrder) {
    Patches p;
    p.fill(wall_patch());
    p[0] = p[1] = periodic_patch();
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 1, 2), meshing::uniform_axis(0, 1, 4),
                 meshing::uniform_axis(0, 1, 5)};
    SolverOptions o;
    o.nu = 0.1;
    const CompactModel model = Solver(grid, p, o).compact_model();
    const CompactPattern pattern = make_compact_pattern(40, model.faces);
    ASSERT_EQ(pattern.level.back(), 40u);
    ASSERT_EQ(pattern.cell.size(), 40u);
    std::vector<std::size_t> level_of(40);
    for (std::size_t l = 0; l + 1 < pattern.level.size(); ++l)
        for (std::size_t r = pattern.level[l]; r < pattern.level[l + 1]; ++r) level_of[r] = l;
    for (std::uint32_t r = 0; r < 40; ++r)
        for (std::uint32_t b = pattern.first[r]; b < pattern.first[r + 1]; ++b) {
            const std::uint32_t k = pattern.column[b];
            EXPECT_NE(level_of[r], level_of[k]);
            EXPECT_EQ(b < pattern.upper[r], level_of[k] < level_of[r]);
            EXPECT_EQ(level_of[k] < level_of[r], pattern.cell[k] < pattern.cell[r]);
            EXPECT_EQ(pattern.column[pattern.reverse[b]], r);
        }
    // Two cells along a periodic axis share two faces; the second is left out.
    std::size_t repeated = 0;
    for (const std::uint32_t b : pattern.left_right) repeated += b == CompactPattern::none;
    EXPECT_EQ(repeated, 20u);
    EXPECT_EQ(pattern.first_border.back(), pattern.border.size());
    EXPECT_EQ(pattern.border.size(), 2u * 2 * (4 + 5));
    EXPECT_EQ(default_fill(40, model.faces), 0u);
}

// Four cells around a periodic axis, twelve along the other: nothing fills in beyond the third level, so the factors are
// complete; all patterns are symmetric.
TEST(CompactPattern, FillIsCompleteInANarrowChannel) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 1, 4), meshing::uniform_axis(0, 3, 12),
                 meshing::uniform_axis(0, 1, 1)};
    Patches p;
    p.fill(periodic_patch());
    p[2] = p[3] = wall_patch();
    SolverOptions o;
    o.nu = 0.1;
    const CompactModel model = Solver(grid, p, o).compact_model();
    std::size_t blocks[6];
    for (std::uint32_t fill = 0; fill < 6; ++fill) {
        const CompactPattern pattern = make_compact_pattern(48, model.faces, fill);
        blocks[fill] = pattern.column.size();
        for (std::uint32_t r = 0; r < 48; ++r)
            for (std::uint32_t b = pattern.first[r]; b < pattern.first[r + 1]; ++b)
                ASSERT_EQ(pattern.column[pattern.reverse[b]], r);
    }
    EXPECT_EQ(blocks[0], 2u * (4 * 12 + 4 * 11));
    EXPECT_GT(blocks[1], blocks[0]);
    EXPECT_EQ(blocks[4], blocks[3]);
    EXPECT_EQ(blocks[5], blocks[3]);
    EXPECT_EQ(default_fill(48, model.faces), 4u);
}

}  // namespace hemoflux::fluid
