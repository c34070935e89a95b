#include "fluid/hex_residual.hpp"

#include <gtest/gtest.h>

#include <random>

#include "exchange/backend.hpp"
#include "flows.hpp"
#include "hex_flows.hpp"

namespace hemoflux::fluid {
namespace {

struct Case {
    std::array<int, 3> n;
    bool stretched, force;
    double gamma;
};

meshing::RectilinearGrid box_of(const Case& c) {
    meshing::RectilinearGrid box;
    for (std::size_t a = 0; a < 3; ++a)
        box.axes[a] = c.stretched ? meshing::plateau_axis(-1, 1, c.n[a], c.n[a] / 3.0, 0.3)
                                  : meshing::uniform_axis(-1, 1 + 0.2 * static_cast<double>(a), c.n[a]);
    return box;
}

/// Every kind of condition; z is periodic.
Patches mixed() {
    Patches p;
    p.fill(periodic_patch());
    p[0] = velocity_patch([](const Vec3d& x) { return Vec3d{0.01 * x.y, 0.02, 0}; });
    p[1] = {VelocityCondition::zero_gradient, DensityCondition::given, {}, [](const Vec3d& x) {
                return 1.01 + 0.001 * x.y;
            }};
    p[2] = {
        VelocityCondition::given, DensityCondition::given_gradient, {}, [](const Vec3d&) { return 0.003; }};
    p[3] = symmetry_patch();
    return p;
}

std::vector<double> noise(std::size_t n, double mean, double scale, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-scale, scale);
    std::vector<double> v(n);
    for (double& x : v) x = mean + uniform(random);
    return v;
}

std::vector<double> residual(const HexSolver& solver) {
    exchange::Buffer<double> r(4 * solver.cells());
    solver.read_residual(r.data());
    return r.to_host();
}

}  // namespace

class HexResidualOf : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Features, HexResidualOf,
                         ::testing::Values(Case{{9, 7, 5}, false, false, 1}, Case{{8, 9, 1}, false, true, 1},
                                           Case{{11, 6, 7}, true, false, 1},
                                           Case{{9, 6, 7}, false, true, 0.2},
                                           Case{{9, 6, 7}, true, true, 0.2}));

// The unstructured solver on a box against the rectilinear one. Both have the same conditions on all sides; on the edge
// between two patches the rectilinear ghost cells see both conditions, so the fields there are the conditions' own.
TEST_P(HexResidualOf, EqualsTheRectilinearSolver) {
    const Case c = GetParam();
    const meshing::RectilinearGrid box = box_of(c);
    SolverOptions o;
    o.nu = 0.1;
    o.gamma = c.gamma;
    o.with_force = c.force;
    for (int a = 0; a < 3; ++a) o.uniform_force[a] = 0.01 * (a - 1);
    Solver straight(box, mixed(), o);
    meshing::BoxDistortion shuffled;
    shuffled.shuffle = true;
    HexSolver hex(meshing::make_hex_grid(meshing::box_mesh(box, shuffled), test::pairs("z")),
                  test::by_name(mixed()), o);
    const auto same = test::same_cells(hex, straight);
    const auto both = [&](const std::vector<double>& v, auto&& set_straight, auto&& set_hex) {
        std::vector<double> moved(v.size());
        for (std::size_t i = 0; i < v.size(); ++i) moved[i] = v[same[i]];
        set_straight(v);
        set_hex(moved);
    };
    for (int k = 0; k < 4; ++k)
        both(
            noise(straight.cells(), k == 0 ? 1 : 0, 0.05, static_cast<unsigned>(k)),
            [&](const auto& v) { straight.set_values(k, v); }, [&](const auto& v) { hex.set_values(k, v); });
    if (c.force) {
        for (int k = 0; k < 3; ++k)
            both(
                noise(straight.cells(), 0, 0.005, static_cast<unsigned>(10 + k)),
                [&](const auto& v) { straight.state().set_interior(straight.state().view().force[k], v); },
                [&](const auto& v) { hex.set_force(k, v); });
        straight.boundary().fill_force(straight.grid().view(), straight.state().view());
    }
    straight.evaluate();
    hex.evaluate();
    const auto mine = residual(hex);
    const auto& axes = box.axes;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto other = straight.residual().interior(straight.residual().view().q[k]);
        double scale = 0;
        for (const double x : other) scale = std::max(scale, std::abs(x));
        for (std::size_t i = 0; i < hex.cells(); ++i) {
            const std::size_t x = same[i] % axes[0].cells(), y = same[i] / axes[0].cells() % axes[1].cells();
            const bool edge = (x == 0 || x + 1 == axes[0].cells()) && (y == 0 || y + 1 == axes[1].cells());
            if (edge) continue;
            ASSERT_NEAR(mine[k * hex.cells() + i], other[same[i]], 2e-12 * scale)
                << k << " " << x << " " << y;
        }
    }
}

TEST(HexResidual, IsBitwiseTheSameForAnyNumberOfThreads) {
    meshing::BoxDistortion distortion;
    distortion.random = 0.3;
    SolverOptions o;
    o.nu = 0.1;
    HexSolver hex(test::box_grid({1, 1, 1}, {12, 11, 13}, "z", distortion), test::by_name(mixed()), o);
    for (int k = 0; k < 4; ++k)
        hex.set_values(k, noise(hex.cells(), k == 0 ? 1 : 0, 0.05, static_cast<unsigned>(k)));
    exchange::set_threads(1);
    hex.evaluate();
    const auto one = residual(hex);
    exchange::set_threads(3);
    hex.evaluate();
    EXPECT_EQ(residual(hex), one);
    exchange::set_threads(0);
}

TEST(HexResidual, UniformFlowIsPreservedOnAnyMesh) {
    for (const double gamma : {1.0, 0.1})
        for (const GradientMethod method :
             {GradientMethod::least_squares, GradientMethod::green_gauss, GradientMethod::hybrid}) {
            meshing::BoxDistortion distortion;
            distortion.random = 0.4;
            distortion.shuffle = true;
            SolverOptions o;
            o.nu = 0.1;
            o.gamma = gamma;
            o.gradient = method;
            const Vec3d u{0.05, -0.02, 0.03};
            Patches p;
            p.fill(velocity_patch([u](const Vec3d&) { return u; }));
            p[4] = open_patch();
            p[5] = density_patch(1);
            HexSolver hex(
                test::box_grid({9, 10, 11}, {9, 10, 11}, "x", distortion),
                [&] {
                    HexPatches named = test::by_name(p);
                    named.erase("x-");
                    named.erase("x+");
                    return named;
                }(),
                o);
            hex.initialise([u](const Vec3d&) { return FlowPoint{1, u}; });
            hex.evaluate();
            for (const double r : residual(hex)) ASSERT_NEAR(r, 0, 1e-13) << gamma;
        }
}

// A plane of symmetry in general position: a box turned in space, with a flow mirrored at the plane, is the same as the
// straight one.
TEST(HexResidual, DoesNotDependOnTheOrientationOfTheMesh) {
    meshing::BoxDistortion distortion;
    distortion.random = 0.2;
    meshing::HexMesh straight = meshing::box_mesh(Vec3d{0, 0, 0}, Vec3d{1, 1, 1}, {6, 5, 7}, distortion);
    // Rotation by 120 degrees about the diagonal maps axes on axes and frames on frames.
    const auto turn = [](const Vec3d& x) { return Vec3d{x.z, x.x, x.y}; };
    const auto back = [](const Vec3d& x) { return Vec3d{x.y, x.z, x.x}; };
    meshing::HexMesh turned = straight;
    for (Vec3d& x : turned.nodes) x = turn(x);
    HexPatches patches;
    const char* names[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};
    for (const char* name : names) patches[name] = symmetry_patch();
    SolverOptions o;
    o.nu = 0.1;
    HexSolver a(meshing::make_hex_grid(straight), patches, o), b(meshing::make_hex_grid(turned), patches, o);
    const auto flow = [](const Vec3d& x) {
        return FlowPoint{1 + 0.01 * std::cos(3 * x.x + x.y),
                         {0.1 * std::sin(2 * x.y), 0.1 * x.z * x.x, -0.1 * x.y}};
    };
    a.initialise(flow);
    b.initialise([&](const Vec3d& x) {
        const FlowPoint p = flow(back(x));
        return FlowPoint{p.density, turn(p.velocity)};
    });
    a.evaluate();
    b.evaluate();
    const ResidualNorm one = a.residual_norm(), two = b.residual_norm();
    EXPECT_NEAR(one.density, two.density, 1e-12 * one.density);
    EXPECT_NEAR(one.momentum[0], two.momentum[1], 1e-12 * one.momentum[0]);
    EXPECT_NEAR(one.momentum[1], two.momentum[2], 1e-12 * one.momentum[1]);
    EXPECT_NEAR(one.momentum[2], two.momentum[0], 1e-12 * one.momentum[2]);
}

}  // namespace hemoflux::fluid
