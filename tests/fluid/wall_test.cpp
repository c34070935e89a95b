#include "fluid/wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

constexpr double mu = 0.02;

Solver channel(double gamma) {
    Patches patches;
    patches.fill(periodic_patch());
    patches[2] = wall_patch();
    patches[3] = velocity_patch([](const Vec3d&) { return Vec3d{0.05, 0, 0.01}; });
    SolverOptions options;
    options.nu = mu;
    options.gamma = gamma;
    return Solver({{meshing::uniform_axis(0, 3, 4), meshing::chebyshev_axis(0, 2, 9),
                    meshing::uniform_axis(0, 1.5, 2)}},
                  patches, options);
}

TEST(WallFaces, CouetteFlowDragsItsWallsExactly) {
    Solver solver = channel(1);
    solver.initialise([](const Vec3d& x) { return FlowPoint{1.003, {0.025 * x.y, 0, 0.005 * x.y}}; });
    const double area = 3 * 1.5;
    const WallForce lower = total_force(solver.wall_faces("y-")),
                    upper = total_force(solver.wall_faces("y+"));
    EXPECT_NEAR(lower.viscous.x, mu * 0.025 * area, 1e-15);
    EXPECT_NEAR(upper.viscous.x, -mu * 0.025 * area, 1e-15);
    EXPECT_NEAR(upper.viscous.z, -mu * 0.005 * area, 1e-15);
    EXPECT_NEAR(lower.viscous.y, 0, 1e-15);
    EXPECT_NEAR(upper.pressure.y, 0.001 * area, 1e-15);
    EXPECT_NEAR(lower.pressure.y, -0.001 * area, 1e-15);
}

TEST(WallFaces, PoiseuilleFlowDragsItsWallsExactly) {
    // u = A y (2 - y) + the upper wall's 0.025 y: stress mu (2 A + 0.025) below, mu (2 A - 0.025) above
    constexpr double a = 0.04;
    Solver solver = channel(0.25);
    solver.initialise([](const Vec3d& x) {
        return FlowPoint{1 + 0.01 * x.y * x.y, {a * x.y * (2 - x.y) + 0.025 * x.y, 0, 0.005 * x.y}};
    });
    const double area = 3 * 1.5;
    const WallForce lower = total_force(solver.wall_faces("y-")),
                    upper = total_force(solver.wall_faces("y+"));
    EXPECT_NEAR(lower.viscous.x, mu * (2 * a + 0.025) * area, 1e-14);
    EXPECT_NEAR(upper.viscous.x, mu * (2 * a - 0.025) * area, 1e-14);
    EXPECT_NEAR(lower.pressure.y, 0, 1e-15);
    EXPECT_NEAR(upper.pressure.y, 0.25 / 3 * 0.04 * area, 1e-14);  // gamma rho / 3, (4.22)
    double covered = 0;
    for (const WallFace& face : solver.wall_faces("y+")) covered += face.area.y;
    EXPECT_NEAR(covered, area, 1e-14);
    EXPECT_THROW((void)solver.wall_faces("x-"), InputError);
    EXPECT_THROW((void)solver.wall_faces("cylinder"), InputError);
}

/// A cylinder of radius 2 about (1, 0, 0), two cells deep, in a stream along `turn`, with given shear and pressure.
template <class Shear, class Pressure>
std::vector<WallFace> cylinder(int n, double turn, const Shear& shear, const Pressure& pressure) {
    std::vector<WallFace> faces;
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * M_PI * (i + 0.5) / n - M_PI, phi = angle + turn,
                         area = 2 * M_PI * 2 / n * 0.5;
            const Vec3d normal{std::cos(phi), std::sin(phi), 0};
            const double forward = angle > 0 ? -1 : 1;  // towards the rear
            const Vec3d tangent{-forward * std::sin(phi), forward * std::cos(phi), 0};
            faces.push_back({Vec3d{1, 0, 0.5 * k} + 2.0 * normal, -area * normal,
                             -pressure(angle) * area * normal, shear(std::abs(angle)) * area * tangent});
        }
    return faces;
}

TEST(Wall, DragAndSeparationOfAManufacturedCylinder) {
    const double turn = 0.3, separation = 53.1 / 180 * M_PI;
    const auto shear = [&](double a) { return std::sin(a) * (std::cos(separation) - std::cos(a)); };
    const auto pressure = [](double a) { return -0.7 * std::cos(a) + 0.2 * std::sin(a); };
    const BodyFrame frame{
        {1, 0, 0.25}, {std::cos(turn), std::sin(turn), 0}, {-std::sin(turn), std::cos(turn), 0}};
    const auto faces = cylinder(200, turn, shear, pressure);
    const WallForce force = total_force(faces);
    // integrals over the circle; depth 1, radius 2
    EXPECT_NEAR(dot(force.pressure, frame.stream), 0.7 * M_PI * 2, 1e-12);
    EXPECT_NEAR(dot(force.pressure, frame.lift), -0.2 * M_PI * 2, 1e-12);
    EXPECT_NEAR(dot(force.viscous, frame.stream), 2 * M_PI * std::cos(separation), 2e-3);
    EXPECT_NEAR(dot(force.viscous, frame.lift), 0, 1e-12);
    EXPECT_NEAR(force_coefficient(force.pressure, frame.stream, 0.1, 4), 0.7 * M_PI * 2 / (0.5 * 0.01 * 4),
                1e-9);
    const auto points = wall_points(faces, frame);
    ASSERT_EQ(points.size(), 200u);
    EXPECT_NEAR(points.front().centre.z, 0.25, 1e-14);
    for (const WallPoint& p : points) {
        EXPECT_NEAR(p.shear, shear(std::abs(p.angle_deg) * M_PI / 180), 1e-12);
        EXPECT_NEAR(p.pressure, pressure(p.angle_deg * M_PI / 180), 1e-12);
    }
    EXPECT_NEAR(separation_angle_deg(points).value(), 53.1, 0.01);
}

TEST(Wall, AttachedFlowDoesNotSeparate) {
    const BodyFrame frame{{1, 0, 0.25}, {1, 0, 0}, {0, 1, 0}};
    const auto faces = cylinder(
        50, 0, [](double a) { return std::sin(a); }, [](double) { return 0.0; });
    EXPECT_FALSE(separation_angle_deg(wall_points(faces, frame)).has_value());
}

}  // namespace
}  // namespace hemoflux::fluid
