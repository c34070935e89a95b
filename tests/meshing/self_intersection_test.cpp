#include "meshing/self_intersection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::meshing {
namespace {

TEST(SelfIntersection, NoneOnSphereAndDisc) {
    EXPECT_TRUE(self_intersections(icosphere(3, 1)).empty());
    EXPECT_TRUE(self_intersections(evans_fung(icosphere(4, 1))).empty());
}

TEST(SelfIntersection, APushedVertexPiercesTheOtherSide) {
    SurfaceMesh mesh = icosphere(2, 1);
    // vertex 0 goes through the face that the opposite ray leaves by, a little off its vertex
    const Vec3d p = mesh.vertices[0];
    mesh.vertices[0] = -1.2 * p + Vec3d{0.05, 0.02, -0.03};
    const auto pairs = self_intersections(mesh);
    ASSERT_FALSE(pairs.empty());
    std::set<int> fan;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const int v : mesh.triangles[t])
            if (v == 0) fan.insert(static_cast<int>(t));
    for (const auto& [f, g] : pairs) {
        EXPECT_LT(f, g);
        EXPECT_TRUE(fan.count(f) || fan.count(g));
    }
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

}  // namespace
}  // namespace hemoflux::meshing
