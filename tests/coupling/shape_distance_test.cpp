#include "coupling/shape_distance.hpp"

#include <gtest/gtest.h>

#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {

TEST(ShapeDistance, IsThatOfASphereInsideAndOutside) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(3, 2.0);
    const ShapeDistance distance(sphere.vertices, sphere.triangles, 0.5);
    const Vec3d out = (1 / norm(Vec3d{1, 2, -0.5})) * Vec3d{1, 2, -0.5};
    for (const double r : {1.2, 1.9, 2.1, 2.4}) EXPECT_NEAR(distance(r * out), r - 2, 0.02) << r;
    EXPECT_EQ(distance({3, 3, 3}), 0.5);
    EXPECT_EQ(distance({-20, 0, 0}), 0.5);
}

}  // namespace hemoflux::coupling
