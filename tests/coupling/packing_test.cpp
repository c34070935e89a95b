#include "coupling/packing.hpp"

#include <gtest/gtest.h>

#include "coupling/overlap.hpp"
#include "exchange/error.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

PackingInput input(const NodeBox& box, std::size_t cells, int level = 2) {
    const meshing::SurfaceMesh disc = meshing::evans_fung(meshing::icosphere(level, 1.0));
    PackingInput in;
    in.box = box;
    in.shape = disc.vertices;
    in.triangles = disc.triangles;
    in.cells = cells;
    return in;
}

std::vector<double> place(const PackingInput& in, const std::vector<Placement>& cells, int axis) {
    std::vector<double> x;
    for (const Placement& p : cells)
        for (const Vec3d& r : in.shape) {
            const Vec3d at = p.position + AxisTurn{p.axis}(r);
            x.push_back(axis == 0 ? at.x : axis == 1 ? at.y : at.z);
        }
    return x;
}

double smallest_gap(const PackingInput& in, const std::vector<Placement>& cells) {
    const exchange::Buffer<double> x(place(in, cells, 0)), y(place(in, cells, 1)), z(place(in, cells, 2));
    OverlapCheck check(in.box, 1.5, in.triangles, cells.size(), in.shape.size(), in.shape.size());
    return check.smallest(x.data(), y.data(), z.data()).distance;
}

}  // namespace

TEST(AxisTurn, TurnsZOntoTheAxisAndBack) {
    for (Vec3d a : {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{1, 0, 0}, Vec3d{0.3, -0.5, -0.8}}) {
        a = (1 / norm(a)) * a;
        const AxisTurn turn{a};
        EXPECT_LT(norm(turn({0, 0, 1}) - a), 1e-14);
        const Vec3d v{0.2, 1.5, -0.7};
        EXPECT_NEAR(norm(turn(v)), norm(v), 1e-14);
        EXPECT_LT(norm(turn.back(turn(v)) - v), 1e-14);
    }
}

TEST(Packing, CellsKeepTheirDistanceThroughPeriodicSides) {
    const PackingInput in = input({{-8, -8, -8}, {16, 16, 16}, {true, true, true}}, 6, 3);
    const auto cells = pack(in);
    ASSERT_EQ(cells.size(), 6u);
    EXPECT_GT(smallest_gap(in, cells), 0.15);
    // not all alike
    EXPECT_LT(std::abs(dot(cells[0].axis, cells[1].axis)), 0.999);
}

TEST(Packing, GrowsWhereTheBoxFillsUp) {
    // 28 % of the box is more than random addition reaches with discs
    PackingInput in = input({{0, 0, 0}, {15, 15, 15}, {true, true, true}}, 10);
    in.gap = 0.1;
    const auto cells = pack(in);
    EXPECT_GT(smallest_gap(in, cells), 0.02);
}

TEST(Packing, StaysBetweenWalls) {
    const PackingInput in = input({{0, -4, -5}, {20, 8, 10}, {true, false, false}}, 3);
    const auto cells = pack(in);
    for (const double y : place(in, cells, 1)) EXPECT_LT(std::abs(y), 3.9);
    for (const double z : place(in, cells, 2)) EXPECT_LT(std::abs(z), 4.9);
    EXPECT_GT(smallest_gap(in, cells), 0.1);
}

TEST(Packing, IsTheSameForTheSameSeedOnly) {
    PackingInput in = input({{-8, -8, -8}, {16, 16, 16}, {true, true, true}}, 3);
    const auto one = pack(in), two = pack(in);
    EXPECT_EQ(one[2].position.x, two[2].position.x);
    in.seed = 2;
    EXPECT_NE(pack(in)[2].position.x, one[2].position.x);
}

TEST(Packing, SaysHowFarItCame) {
    PackingInput in = input({{0, 0, 0}, {9, 9, 9}, {true, true, true}}, 8);
    in.patience = 20;
    try {
        static_cast<void>(pack(in));
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("% of their size"), std::string::npos) << e.what();
    }
}

}  // namespace hemoflux::coupling
