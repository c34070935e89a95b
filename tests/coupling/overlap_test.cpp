#include "coupling/overlap.hpp"

#include <gtest/gtest.h>

#include <random>

#include "coupling/surface_gap.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

NodeBox box() { return {{-5, -5, -5}, {10, 10, 10}, {true, false, true}}; }

Gap smallest(const std::vector<Vec3d>& shape, const std::vector<Vec3d>& places,
             const std::vector<std::array<int, 3>>& triangles, double reach) {
    std::vector<double> x, y, z;
    for (const Vec3d& place : places)
        for (const Vec3d& r : shape)
            x.push_back(r.x + place.x), y.push_back(r.y + place.y), z.push_back(r.z + place.z);
    const exchange::Buffer<double> a(x), b(y), c(z);
    OverlapCheck check(box(), reach, triangles, places.size(), shape.size(), shape.size());
    return check.smallest(a.data(), b.data(), c.data());
}

}  // namespace

TEST(RingDistance, KnowsDistanceAndSideNearASphere) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(3, 1.0);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 200; ++n) {
        const Vec3d out{normal(random), normal(random), normal(random)};
        for (const double r : {0.93, 1.06}) {
            const Vec3d p = (r / norm(out)) * out;
            std::size_t nearest = 0;
            for (std::size_t v = 0; v < sphere.vertices.size(); ++v)
                if (norm(sphere.vertices[v] - p) < norm(sphere.vertices[nearest] - p)) nearest = v;
            RingDistance ring(p);
            for (const auto& t : sphere.triangles)
                for (std::size_t c = 0; c < 3; ++c)
                    if (static_cast<std::size_t>(t[c]) == nearest)
                        ring.add(sphere.vertices[nearest],
                                 sphere.vertices[static_cast<std::size_t>(t[(c + 1) % 3])],
                                 sphere.vertices[static_cast<std::size_t>(t[(c + 2) % 3])]);
            EXPECT_NEAR(ring.value(), r - 1, 0.006) << r;  // the sagitta of an edge of 0.15 is 0.003
        }
    }
}

TEST(RingDistance, TakesTheSideOfACornerFromAllItsTriangles) {
    // a spike: seen from the side, one of its triangles alone would call the point outside or inside at random
    const Vec3d tip{0, 0, 0}, a{1, 0, -3}, b{-0.5, 0.8, -3}, c{-0.5, -0.8, -3};
    for (const Vec3d& p : {Vec3d{0.02, 0.01, 0.1}, Vec3d{-0.03, 0, 0.05}, Vec3d{0, 0, 0.2}}) {
        RingDistance ring(p);
        ring.add(tip, a, b);
        ring.add(tip, b, c);
        ring.add(tip, c, a);
        EXPECT_NEAR(ring.value(), norm(p), 1e-12);
    }
    RingDistance inside({0, 0, -0.5});
    inside.add(tip, a, b);
    inside.add(tip, b, c);
    inside.add(tip, c, a);
    EXPECT_LT(inside.value(), 0);
}

TEST(OverlapCheck, FindsTheGapOfTwoSpheresAcrossThePeriodicSide) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(3, 2.0);
    // 10 um apart but for an image: centres are 4.1 um apart
    const Gap gap = smallest(sphere.vertices, {{4.5, 0, 0}, {-1.4, 0, 30}}, sphere.triangles, 0.5);
    EXPECT_NEAR(gap.distance, 0.1, 0.02);
    EXPECT_NE(gap.cell, gap.other);
    const Gap inside = smallest(sphere.vertices, {{4.5, 0, 0}, {-1.7, 0, 30}}, sphere.triangles, 0.5);
    EXPECT_NEAR(inside.distance, -0.2, 0.02);
    const Gap none = smallest(sphere.vertices, {{4.5, 0, 0}, {0, 0, 4}}, sphere.triangles, 0.5);
    EXPECT_EQ(none.distance, 1e300);
}

TEST(OverlapCheck, DiscsInEachOthersDimplesDoNotOverlap) {
    const meshing::SurfaceMesh disc = meshing::evans_fung(meshing::icosphere(3, 1.0));
    double top = 0;
    for (const Vec3d& r : disc.vertices) top = std::max(top, r.z);
    const double apart = 2 * top + 0.1;
    EXPECT_NEAR(smallest(disc.vertices, {{0, 0, 0}, {0, 0, apart}}, disc.triangles, 0.7).distance, 0.1, 0.03);
    EXPECT_LT(smallest(disc.vertices, {{0, 0, 0}, {0, 0, apart - 0.2}}, disc.triangles, 0.7).distance, 0);
}

TEST(OverlapCheck, MeetsItsOwnImageInANarrowBox) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(2, 4.8);
    const Gap gap = smallest(sphere.vertices, {{17, 0, 3}}, sphere.triangles, 2.5);
    EXPECT_NEAR(gap.distance, 0.4, 0.1);
}

}  // namespace hemoflux::coupling
