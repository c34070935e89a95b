#include "fluid/hex_solver.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "flows.hpp"
#include "fluid/local_step.hpp"
#include "hex_flows.hpp"

namespace hemoflux::fluid {
namespace {

meshing::BoxDistortion random_distortion(double random) {
    meshing::BoxDistortion d;
    d.random = random;
    d.shuffle = true;
    return d;
}

SolverOptions viscosity(double nu) {
    SolverOptions o;
    o.nu = nu;
    return o;
}

}  // namespace

// A channel driven by a force and an oscillating wall, with both schemes and with local steps: the same numbers as on a
// rectilinear grid.
TEST(HexSolver, StepsLikeTheRectilinearSolver) {
    meshing::RectilinearGrid box;
    for (auto& axis : box.axes) axis = meshing::uniform_axis(0, 6, 6);
    Patches p;
    p.fill(periodic_patch());
    p[2] = p[3] = wall_patch();
    p[3].unsteady_velocity = [](const Vec3d&, double t) {
        return Vec3d{0.05 * std::sin(t), 0, 0.02 * std::cos(t)};
    };
    for (const Scheme scheme : {Scheme::euler, Scheme::rk4}) {
        SolverOptions o = viscosity(0.3);
        o.scheme = scheme;
        o.with_force = true;
        o.uniform_force[0] = 0.001;
        o.oscillating_force = {{0, 0, 0.002}, 0.3, 0.1};
        Solver straight(box, p, o);
        HexSolver hex(meshing::make_hex_grid(meshing::box_mesh(box, random_distortion(0)), test::pairs("xz")),
                      test::by_name(p), o);
        const auto flow = [](const Vec3d& x) {
            return FlowPoint{1 + 0.01 * std::cos(x.x), {0.02 * std::sin(x.y), 0.01 * std::cos(x.z), 0}};
        };
        straight.initialise(flow);
        hex.initialise(flow);
        const double dt = 0.9 * hex.largest_step(0.1);
        EXPECT_NEAR(dt, 0.9 * stable_step(straight.grid(), scheme, o.nu, 0.1), 1e-13);
        for (int s = 0; s < 20; ++s) straight.step(dt), hex.step(dt);
        EXPECT_EQ(hex.time(), straight.time());
        EXPECT_EQ(hex.evaluations(), straight.evaluations());
        const auto same = test::same_cells(hex, straight);
        for (int c = 0; c < 4; ++c) {
            const auto a = hex.values(c), b = straight.values(c);
            for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[same[i]], 1e-13) << c;
        }
        EXPECT_NEAR(hex.mean_density(), straight.mean_density(), 1e-14);
        EXPECT_NEAR(hex.largest_speed(), straight.largest_speed(), 1e-13);
    }
}

TEST(HexSolver, ClosedDomainKeepsItsMass) {
    const meshing::HexGrid grid = test::box_grid({8, 8, 8}, {8, 8, 8}, "", random_distortion(0.3));
    HexPatches patches = test::walls(grid);
    patches["y+"] = velocity_patch([](const Vec3d& x) { return Vec3d{0.05 * std::sin(x.x), 0, 0.02}; });
    HexSolver solver(grid, patches, viscosity(0.2));
    solver.initialise([](const Vec3d& x) {
        return FlowPoint{1 + 0.001 * x.x, {0.01 * std::sin(x.y), 0, 0.01}};
    });
    const double before = solver.mean_density(), dt = 0.9 * solver.largest_step(0.1);
    for (int s = 0; s < 200; ++s) solver.step(dt);
    EXPECT_EQ(solver.first_bad_cell(), solver.cells());
    EXPECT_NEAR(solver.mean_density(), before, 1e-13);
}

TEST(HexSolver, LocalStepsAreThoseOfTheFormula) {
    const double h = 0.5, nu = 0.02, gamma = 0.3, sigma = 1.5, c = 4;
    const Vec3d u{0.1, -0.05, 0.02};
    SolverOptions o = viscosity(nu);
    o.gamma = gamma;
    // z is one cell thick: nothing moves that way, whether it is periodic or lies between planes of symmetry.
    HexSolver periodic(test::box_grid({5 * h, 4 * h, 9}, {5, 4, 1}, "xyz"), {}, o);
    HexSolver sheet(test::box_grid({5 * h, 4 * h, 0.01}, {5, 4, 1}, "xy"),
                    {{"z-", symmetry_patch()}, {"z+", symmetry_patch()}}, o);
    const auto radius = [&](double v) {
        return (std::abs(v) + std::sqrt(v * v * (1 - gamma) + gamma * gamma / 3)) / gamma;
    };
    const double expected = sigma / ((radius(u.x) + radius(u.y)) / h + c * 2 * 2 * nu / (gamma * h * h));
    for (HexSolver* solver : {&periodic, &sheet}) {
        EXPECT_THROW(solver->local_step(), std::logic_error);
        solver->initialise([&](const Vec3d&) { return FlowPoint{1, u}; });
        solver->set_local_steps(sigma, c);
        exchange::Buffer<double> dt(solver->cells());
        solver->read_local_steps(dt.data());
        for (const double value : dt.to_host()) EXPECT_NEAR(value, expected, 1e-13);
        EXPECT_NEAR(solver->largest_step(0.1), periodic.largest_step(0.1), 1e-13);
    }
}

// Couette flow on skewed hexahedra with plane faces is a steady state, up to the momentum flux rho u u, and the force on
// the wall is rho nu U / H per area. Local steps, preconditioned, lead to it.
TEST(HexSolver, CouetteFlowAndItsWallForces) {
    const double nu = 0.5, speed = 1e-5;
    meshing::HexMesh mesh = meshing::box_mesh(Vec3d{0, 0, 0}, Vec3d{5, 5, 5}, {5, 5, 5});
    for (Vec3d& x : mesh.nodes)
        if (x.x > 0.1 && x.x < 4.9 && x.y > 0.1 && x.y < 4.9)
            x += Vec3d{0.25 * std::sin(12.9 * x.x + 78.2 * x.y), 0.25 * std::cos(37.1 * x.x + 11.3 * x.y), 0};
    const meshing::HexGrid grid = meshing::make_hex_grid(mesh);
    const auto couette = [&](const Vec3d& x) { return Vec3d{speed * x.y / 5, 0, 0}; };
    HexPatches patches;
    for (const auto& p : grid.patches) patches[p.name] = velocity_patch(couette);
    SolverOptions o = viscosity(nu);
    o.gamma = 0.5;
    HexSolver solver(grid, patches, o);
    const double stress = nu * speed / 5;
    solver.initialise([&](const Vec3d& x) { return FlowPoint{1, couette(x)}; });
    solver.evaluate();
    for (const double r : solver.residual_norm().momentum) EXPECT_LT(r, 1e-4 * stress);
    Vec3d viscous{0, 0, 0}, area{0, 0, 0};
    for (const WallFace& face : solver.wall_faces("y+")) viscous += face.viscous, area += face.area;
    EXPECT_NEAR(area.y, 25, 1e-12);
    EXPECT_NEAR(viscous.x, -25 * stress, 25 * stress * 1e-4);
    EXPECT_THROW(solver.wall_faces("lid"), InputError);

    solver.initialise([&](const Vec3d& x) {
        return FlowPoint{1, couette(x) + speed * Vec3d{0, std::sin(x.x), std::sin(2 * x.y)}};
    });
    solver.evaluate();
    const double start = solver.residual_norm().momentum[1];
    for (int s = 0; s < 300; ++s) {
        solver.set_local_steps(1, 4);
        solver.local_step();
    }
    EXPECT_LT(solver.residual_norm().momentum[1], 1e-3 * start);
}

// A fluid at rest under a force loads the walls with its weight; with the hydrostatic gradient as condition for the
// density the pressure is linear and carries all of it.
TEST(HexSolver, WallsCarryTheWeight) {
    const double force = -1e-4;
    const meshing::HexGrid grid = test::box_grid({4, 4, 4}, {4, 4, 4}, "xz");
    for (const bool hydrostatic : {false, true}) {
        HexPatches patches = test::walls(grid);
        if (hydrostatic)
            for (const char* wall : {"y-", "y+"}) {
                patches[wall].density = DensityCondition::given_gradient;
                patches[wall].density_profile = [&](const Vec3d& x) { return (x.y < 2 ? 3 : -3) * force; };
            }
        SolverOptions o = viscosity(0.5);
        o.with_force = true;
        o.uniform_force[1] = force;
        HexSolver solver(grid, patches, o);
        solver.set_local_steps(1, 4);
        for (int s = 0; s < 2000; ++s) solver.local_step();
        Vec3d pressure{0, 0, 0}, viscous{0, 0, 0};
        for (const char* wall : {"y-", "y+"})
            for (const WallFace& face : solver.wall_faces(wall))
                pressure += face.pressure, viscous += face.viscous;
        EXPECT_NEAR(pressure.y + viscous.y, 64 * force, 1e-12);
        EXPECT_TRUE(!hydrostatic || std::abs(pressure.y - 64 * force) < 1e-9) << pressure.y;
    }
}

TEST(HexSolver, TaylorGreenIsOfSecondOrderOnSkewedHexahedra) {
    for (const GradientMethod method : {GradientMethod::least_squares, GradientMethod::hybrid}) {
        test::ConvergenceTable table(
            "Taylor-Green vortex on smoothly skewed hexahedra: relative L2 error of u");
        double order = 0;
        for (const int n : {16, 32, 64}) {
            // Diffusive scaling: the Mach number falls with the cell size, Re = u0 L / nu = 20.
            const double length = n, u0 = 0.64 / n;
            const test::TaylorGreen exact{length, u0, u0 * length / 20};
            meshing::BoxDistortion skew;
            skew.skew = 0.04;
            skew.shuffle = true;
            SolverOptions o = viscosity(exact.nu);
            o.gradient = method;
            HexSolver solver(test::box_grid({length, length, 1}, {n, n, 1}, "xyz", skew), {}, o);
            solver.initialise([&](const Vec3d& x) { return exact.at(x, 0); });
            const double end = exact.decay_time() / 2, limit = 0.8 * solver.largest_step(u0);
            const int steps = static_cast<int>(std::ceil(end / limit));
            for (int s = 0; s < steps; ++s) solver.step(end / steps);
            const auto u = solver.values(1);
            double error = 0, reference = 0;
            for (std::size_t i = 0; i < u.size(); ++i) {
                const double e = exact.at(solver.centre(i), end).velocity.x;
                error += (u[i] - e) * (u[i] - e) * solver.volume(i);
                reference += e * e * solver.volume(i);
            }
            order = table.add(length / n / length, std::sqrt(error / reference));
        }
        EXPECT_GT(order, 1.9);
    }
}

TEST(HexSolver, ConservedVectorsGoBothWays) {
    HexSolver solver(test::box_grid({3, 3, 3}, {3, 3, 3}, "xyz"), {}, viscosity(0.1));
    solver.initialise([](const Vec3d& x) { return FlowPoint{1 + 0.01 * x.x, {0.1 * x.y, 0.2, -0.1 * x.z}}; });
    exchange::Buffer<double> q(4 * solver.cells());
    solver.read_conserved(q.data());
    const auto host = q.to_host(), rho = solver.values(0), u = solver.values(1);
    for (std::size_t i = 0; i < solver.cells(); ++i) {
        EXPECT_EQ(host[i], rho[i]);
        EXPECT_EQ(host[solver.cells() + i], rho[i] * u[i]);
    }
    HexSolver other(test::box_grid({3, 3, 3}, {3, 3, 3}, "xyz"), {}, viscosity(0.1));
    other.write_conserved(q.data());
    for (int c = 0; c < 4; ++c) {
        const auto a = solver.values(c), b = other.values(c);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-15);
    }
}

TEST(HexSolver, BadCellIsFoundByIndex) {
    HexSolver solver(test::box_grid({5, 5, 5}, {5, 5, 5}, "xyz"), {}, viscosity(0.1));
    EXPECT_EQ(solver.first_bad_cell(), 125u);
    EXPECT_TRUE(std::isnan(solver.residual_norm().density));
    auto w = solver.values(3);
    w[67] = std::nan("");
    solver.set_values(3, w);
    EXPECT_EQ(solver.first_bad_cell(), 67u);
    EXPECT_TRUE(std::isnan(solver.largest_speed()));
    EXPECT_THROW(solver.set_values(3, {1, 2}), std::length_error);
    EXPECT_THROW(solver.set_force(0, w), std::logic_error);
}

TEST(HexSolver, RefusesImpossibleOptions) {
    const meshing::HexGrid grid = test::box_grid({3, 3, 3}, {3, 3, 3}, "xyz");
    EXPECT_THROW(HexSolver(grid, {}, viscosity(0)), InputError);
    SolverOptions o = viscosity(0.1);
    o.gamma = 2;
    EXPECT_THROW(HexSolver(grid, {}, o), InputError);
    o = viscosity(0.1);
    o.scheme = Scheme::factored;
    EXPECT_THROW(HexSolver(grid, {}, o), InputError);
}

TEST(HexSolver, TakesForceAndViscosityCellByCellAsTheRectilinearSolverDoes) {
    meshing::RectilinearGrid box;
    for (auto& axis : box.axes) axis = meshing::uniform_axis(0, 6, 6);
    Patches p;
    p.fill(periodic_patch());
    p[2] = p[3] = wall_patch();
    SolverOptions o = viscosity(0.3);
    o.scheme = Scheme::euler;
    o.with_force = o.with_viscosity = true;
    o.largest_nu = 0.6;
    Solver straight(box, p, o);
    HexSolver hex(meshing::make_hex_grid(meshing::box_mesh(box, random_distortion(0)), test::pairs("xz")),
                  test::by_name(p), o);
    EXPECT_NEAR(hex.largest_step(0.1), stable_step(straight.grid(), o.scheme, o.largest_nu, 0.1), 1e-13);
    const auto same = test::same_cells(hex, straight);
    const std::size_t n = hex.cells();
    std::vector<double> nu(n), nu_hex(n), force(n), force_hex(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d x = straight.centre(i);
        nu[i] = 0.3 * (1.5 + 0.5 * std::sin(x.x) * std::cos(x.y + x.z));
        force[i] = 1e-3 * std::cos(x.x + 2 * x.z);
    }
    for (std::size_t i = 0; i < n; ++i) nu_hex[i] = nu[same[i]], force_hex[i] = force[same[i]];
    straight.state().set_interior(straight.state().view().nu, nu);
    straight.state().set_interior(straight.state().view().force[1], force);
    hex.set_viscosity(nu_hex);
    hex.set_force(1, force_hex);
    EXPECT_EQ(hex.coefficient(3), nu_hex);
    const auto flow = [](const Vec3d& x) {
        return FlowPoint{1 + 0.01 * std::cos(x.x), {0.02 * std::sin(x.y), 0.01 * std::cos(x.z), 0}};
    };
    straight.initialise(flow);
    hex.initialise(flow);
    for (int s = 0; s < 20; ++s) straight.step(0.2), hex.step(0.2);
    for (int c = 0; c < 4; ++c) {
        const auto a = hex.values(c), b = straight.values(c);
        for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[same[i]], 1e-13) << c;
    }
    HexSolver plain(test::box_grid({3, 3, 3}, {3, 3, 3}, "xyz"), {}, viscosity(0.3));
    EXPECT_THROW(plain.set_viscosity(nu), std::logic_error);
    EXPECT_TRUE(plain.coefficient(3).empty());
}

}  // namespace hemoflux::fluid
