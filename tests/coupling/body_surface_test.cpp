#include "coupling/body_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/cell_grid.hpp"
#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::coupling {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST(BodySurface, HasTheAreaVolumeAndInertiaOfItsShape) {
    const double a = 2, c = 3;
    BodySurface s = closed_surface(meshing::spheroid(meshing::icosphere(5, 1), a, a, c));
    const double volume = 4.0 / 3 * pi * a * a * c;
    EXPECT_NEAR(s.volume, volume, 2e-3 * volume);
    EXPECT_NEAR(s.area(), meshing::area(meshing::SpheroidAxes{a, c}), 2e-3 * s.area());
    EXPECT_NEAR(s.inertia.row[2].z, 0.4 * volume * a * a, 4e-3 * volume * a * a);
    EXPECT_NEAR(s.inertia.row[0].x, 0.2 * volume * (a * a + c * c), 4e-3 * volume * c * c);
    EXPECT_NEAR(s.inertia.row[0].y, 0, 1e-6 * volume);
    for (std::size_t j = 0; j < s.nodes.size(); ++j) {
        const Vec3d n{s.nodes[j].x / (a * a), s.nodes[j].y / (a * a), s.nodes[j].z / (c * c)};
        EXPECT_GT(dot(n, s.normals[j]) / norm(n), 0.999);
    }
}

TEST(BodySurface, CylinderMantleStandsForItsArea) {
    const BodySurface s = cylinder_mantle(2, 5, {0, 0, 1}, 24, 10);
    EXPECT_FALSE(s.closed);
    EXPECT_NEAR(s.area(), pi * 2 * 5, 1e-12);
    EXPECT_NEAR(s.inertia.row[2].z, s.volume / 2, 1e-12);
    EXPECT_NEAR(s.inertia.row[0].x, s.volume * (1.0 / 4 + 25.0 / 12), 1e-11);
    double reach = 0;
    for (const Vec3d& x : s.nodes) {
        EXPECT_NEAR(std::hypot(x.x, x.y), 1, 1e-12);
        reach = std::max(reach, std::abs(x.z));
    }
    EXPECT_NEAR(reach, 2.25, 1e-12);
    EXPECT_EQ(s.mesh.triangles.size(), 24u * 9 * 2);
    EXPECT_NEAR(meshing::area(s.mesh), pi * 2 * 4.5, 0.01 * pi * 9);
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t) {
        const Vec3d n = meshing::area_vector(s.mesh, t);
        EXPECT_GT(dot(n, s.mesh.vertices[static_cast<std::size_t>(s.mesh.triangles[t][0])]), 0);
    }
    EXPECT_THROW(cylinder_mantle(2, 5, {0, 0, 1}, 4, 10), InputError);
}

TEST(BodySurface, RetractsByAShareOfTheCellsAlongTheNormal) {
    const meshing::RectilinearGrid grid{{meshing::uniform_axis(-8, 8, 16), meshing::uniform_axis(-8, 8, 32),
                                         meshing::uniform_axis(-8, 8, 8)}};
    const CellGrid cells(grid, {false, false, false});
    BodySurface s = closed_surface(meshing::icosphere(3, 4));
    const BodySurface before = s;
    retract(s, cells, {0.1, 0, 0}, 0.3);
    for (std::size_t j = 0; j < s.nodes.size(); ++j) {
        const Vec3d n = s.normals[j];
        const double expected = 0.3 * std::sqrt(n.x * n.x + 0.25 * n.y * n.y + 4 * n.z * n.z);
        EXPECT_NEAR(norm(s.nodes[j] - before.nodes[j]), expected, 1e-12);
        EXPECT_LT(norm(s.nodes[j]), 4);
    }
}

}  // namespace hemoflux::coupling
