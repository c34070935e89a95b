#include "coupling/body_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::coupling {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST(BodyMotion, TurnsExactlyAndKeepsItsDistances) {
    BodyState s;
    s.velocity = {1, 2, 3};
    s.angular_velocity = {0.3, -0.4, 1.2};
    const double turn = 2 * pi / 1.3;
    for (int i = 0; i < 40; ++i) advance(s, turn / 40);
    const Matrix3 r = rotation(s.orientation);
    EXPECT_NEAR(norm(r * Vec3d{1, 2, 3} - Vec3d{1, 2, 3}), 0, 1e-12);
    EXPECT_NEAR(norm(s.centre - turn * Vec3d{1, 2, 3}), 0, 1e-12);
    advance(s, turn / 4);  // a quarter: axis stays, a vector across it turns by 90 degrees
    const Matrix3 q = rotation(s.orientation);
    const Vec3d axis = (1 / 1.3) * Vec3d{0.3, -0.4, 1.2};
    EXPECT_NEAR(norm(q * axis - axis), 0, 1e-12);
    const Vec3d across = cross(axis, {1, 0, 0});
    EXPECT_NEAR(norm(q * across - cross(axis, across)), 0, 1e-12);
}

// Whatever the gains, the forces after a correction add up to minus the excess inertia times the acceleration.
TEST(BodyMotion, BalancesForceAndTorque) {
    BodyState before;
    before.velocity = {0.1, -0.2, 0.05};
    before.angular_velocity = {0.02, 0.01, -0.03};
    const BodySurface s = closed_surface(meshing::spheroid(meshing::icosphere(2, 1), 2, 3, 1.5));
    for (const double excess : {0.0, 1.5}) {
        BodyLoad load{excess * s.volume, {}, {0.3, 0, 0}, {0, 0.2, 0}};
        for (int i = 0; i < 3; ++i) load.excess_inertia.row[i] = excess * s.inertia.row[i];
        const auto u = [](const Vec3d& x) { return Vec3d{0.1 * x.y + 0.05, 0.2 * x.x * x.z, -0.1 * x.x}; };
        const auto gain = [](const Vec3d& x) { return 1 + 0.3 * x.x + 0.1 * x.z; };
        NodeSums sums;
        for (const Vec3d& r : s.nodes) {
            const double k = gain(r);
            const Vec3d f{0.01 * r.z, 0.02, 0.03 * r.x};
            sums += NodeSums{
                k,
                k * r,
                {k * r.x * r.x, k * r.y * r.y, k * r.z * r.z, k * r.x * r.y, k * r.y * r.z, k * r.z * r.x},
                k * u(r),
                k * cross(r, u(r)),
                f,
                cross(r, f)};
        }
        const double dt = 0.25;
        const BodyVelocity v = balance(BodyFreedom::free, before, sums, load, dt);
        Vec3d force{0, 0, 0}, torque{0, 0, 0};
        for (const Vec3d& r : s.nodes) {
            const Vec3d f = Vec3d{0.01 * r.z, 0.02, 0.03 * r.x} +
                            gain(r) * (v.velocity + cross(v.angular_velocity, r) - u(r));
            force += f;
            torque += cross(r, f);
        }
        const Vec3d& spin = before.angular_velocity;
        const Vec3d momentum = (load.excess_mass / dt) * (v.velocity - before.velocity),
                    turn = (1 / dt) * (load.excess_inertia * (v.angular_velocity - spin)) +
                           cross(spin, load.excess_inertia * spin);
        EXPECT_NEAR(norm(momentum + force - load.force), 0, 1e-10);
        EXPECT_NEAR(norm(turn + torque - load.torque), 0, 1e-10);
    }
}

}  // namespace hemoflux::coupling
