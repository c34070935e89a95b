#include "membrane/shape_kind.hpp"

#include <gtest/gtest.h>

#include "membrane/fields.hpp"
#include "meshing/evans_fung.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

ShapeSigns signs_of(const std::vector<Vec3d>& positions) {
    const auto topology = test::icosphere_topology(3);
    Batch batch(topology, {}, reference_from_shape(*topology, positions));
    batch.set_positions(0, positions);
    return shape_signs(*topology, positions, vertex_fields(batch, 0).curvature);
}

TEST(ShapeSigns, TellDiscCupAndSpicules) {
    const auto sphere = meshing::icosphere(3, 1.0);
    EXPECT_EQ(signs_of(sphere.vertices).kind, ShapeKind::other);
    auto disc = meshing::evans_fung(sphere).vertices;
    EXPECT_EQ(signs_of(disc).kind, ShapeKind::discocyte);
    EXPECT_NEAR(signs_of(disc).asymmetry, 0, 1e-9);
    for (Vec3d& r : disc) r.z += 1.2 * (1 - (r.x * r.x + r.y * r.y) / 15);
    EXPECT_EQ(signs_of(disc).kind, ShapeKind::stomatocyte);
    auto spiky = sphere.vertices;
    for (int v = 0; v < 12; ++v)
        spiky[static_cast<std::size_t>(v)] = 1.2 * spiky[static_cast<std::size_t>(v)];
    EXPECT_EQ(signs_of(spiky).spicules, 12);
    EXPECT_EQ(signs_of(spiky).kind, ShapeKind::echinocyte);
}

}  // namespace
}  // namespace hemoflux::membrane
