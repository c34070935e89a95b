// The generators: box, cavity, cylinder, pipe.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exchange/error.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_cavity.hpp"
#include "meshing/hex_cylinder.hpp"
#include "meshing/hex_pipe.hpp"
#include "meshing/hex_quality.hpp"
#include "meshing/plane_mesh.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double pi = std::numbers::pi;

const HexGrid::Patch& patch(const HexGrid& grid, const std::string& name) {
    for (const HexGrid::Patch& p : grid.patches)
        if (p.name == name) return p;
    throw std::out_of_range(name);
}

/// Sum of area vectors and of their magnitudes over a patch.
std::pair<Vec3d, double> area_of(const HexGrid& grid, const std::string& name) {
    const HexGrid::Patch& p = patch(grid, name);
    Vec3d sum{0, 0, 0};
    double size = 0;
    for (std::size_t f = p.first; f < p.first + p.count; ++f) {
        sum += grid.area[f];
        size += norm(grid.area[f]);
    }
    return {sum, size};
}

TEST(HexBox, PatchesFaceTheirWays) {
    const HexGrid grid =
        make_hex_grid(box_mesh({-1, 0, 2}, {1, 3, 6}, {3, 4, 5}, {.skew = 0.03, .shuffle = true}));
    EXPECT_NEAR(area_of(grid, "x-").first.x, -12, 1e-13);
    EXPECT_NEAR(area_of(grid, "x+").first.x, 12, 1e-13);
    EXPECT_NEAR(area_of(grid, "y+").first.y, 8, 1e-13);
    EXPECT_NEAR(area_of(grid, "z-").first.z, -6, 1e-13);
    EXPECT_GT(quality(grid).nonorthogonality, 3);
}

TEST(HexBox, ASheetStaysASheet) {
    const HexMesh mesh = box_mesh({0, 0, 0}, {1, 1, 0.1}, {8, 8, 1}, {.skew = 0.05, .random = 0.3});
    for (const auto& cell : mesh.cells) {
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(mesh.nodes[cell[k]].x, mesh.nodes[cell[k + 4]].x);
            EXPECT_EQ(mesh.nodes[cell[k]].y, mesh.nodes[cell[k + 4]].y);
            EXPECT_EQ(mesh.nodes[cell[k]].z, 0);
        }
    }
    EXPECT_GT(quality(make_hex_grid(mesh, {{"x-", "x+"}, {"z-", "z+"}})).nonorthogonality, 5);
}

TEST(HexBox, RefusesFoldedCells) {
    EXPECT_THROW(box_mesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4}, {.skew = 0.3}), InputError);
    EXPECT_THROW(box_mesh({0, 0, 0}, {1, 1, 1}, {4, 4, 4}, {.random = 0.6}), InputError);
    EXPECT_THROW(box_mesh({0, 0, 0}, {1, 1, 1}, {4, 0, 4}), InputError);
}

TEST(HexCavity, HasTheCellsAskedForInGoodShape) {
    for (const int cells : {3000, 20000, 90480}) {
        const HexGrid grid = make_hex_grid(cavity_mesh({.cells = cells}));
        const HexQuality q = quality(grid);
        EXPECT_NEAR(static_cast<double>(q.cells) / cells, 1, 0.03);
        EXPECT_NEAR(q.volume, 1000, 1e-9);
        EXPECT_NEAR(area_of(grid, "y+").first.y, 100, 1e-10);
        EXPECT_NEAR(area_of(grid, "x-").first.x, -100, 1e-10);
        EXPECT_NEAR(area_of(grid, "z+").first.z, 100, 1e-10);
        EXPECT_LT(q.nonorthogonality, 35) << cells;
        EXPECT_LT(q.mean_nonorthogonality, 5);
        EXPECT_LT(q.skewness, 0.35);
        EXPECT_LT(q.aspect, 6);
    }
}

TEST(HexCavity, IsUnstructuredAndFineAtItsWalls) {
    // nodes where other than four quadrilaterals meet inside the square: z-lines shared by other than 4 cells
    const HexMesh mesh = cavity_mesh({.edge = 1, .cells = 8000, .wall = 0.3});
    std::vector<int> meet(mesh.nodes.size(), 0);
    for (const auto& cell : mesh.cells)
        for (const std::uint32_t n : cell) ++meet[n];
    int irregular = 0;
    for (std::size_t i = 0; i < meet.size(); ++i) {
        const Vec3d& x = mesh.nodes[i];
        const bool inside = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) < 0.499;
        if (inside && meet[i] != 8) ++irregular;
    }
    EXPECT_GT(irregular, 100);
    const HexGrid grid = make_hex_grid(mesh);
    double wall = 0, middle = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Vec3d& x = grid.centre[c];
        const double r = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
        if (r < 0.1) middle = std::max(middle, std::cbrt(grid.volume[c]));
        if (std::min({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) > 0.46)
            wall = std::max(wall, std::cbrt(grid.volume[c]));
    }
    EXPECT_LT(wall, 0.5 * middle);
    EXPECT_THROW(cavity_mesh({.wall = 2}), InputError);
    EXPECT_THROW(cavity_mesh({.cells = 3}), InputError);
}

TEST(HexCylinder, ThesisMeshIsSmoothAndReachesFar) {
    const HexGrid grid = make_hex_grid(cylinder_mesh({}), {{"z-", "z+"}});
    const HexQuality q = quality(grid);
    EXPECT_NEAR(static_cast<double>(q.cells), 23073, 300);
    EXPECT_NEAR(q.volume, pi * (2500 - 0.25), 0.002 * q.volume);
    EXPECT_LT(q.nonorthogonality, 30);
    EXPECT_LT(q.skewness, 0.05);
    EXPECT_LT(q.growth, 1.15);
    EXPECT_LT(q.aspect, 5);
    const auto [force, size] = area_of(grid, "cylinder");
    EXPECT_NEAR(norm(force), 0, 1e-12);
    EXPECT_NEAR(size, pi, 0.002);
    // quarter arcs with the free stream along x
    EXPECT_NEAR(area_of(grid, "inlet").first.x, -50 * std::numbers::sqrt2, 4);
    EXPECT_NEAR(area_of(grid, "outlet").first.x, 50 * std::numbers::sqrt2, 4);
    EXPECT_NEAR(area_of(grid, "far").first.x, 0, 4);
    const HexGrid::Patch& wall = patch(grid, "cylinder");
    for (std::size_t f = wall.first; f < wall.first + wall.count; ++f) {
        const double distance = norm(grid.centre[grid.left[f]] - grid.face_centre[f]);
        EXPECT_NEAR(distance, 0.025, 0.001);
        EXPECT_LT(dot(grid.area[f], grid.face_centre[f]), 0);  // out of the fluid, into the cylinder
    }
    // cells 3 diameters behind the axis are no wider than 0.1 D across the wake
    std::size_t found = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        const Vec3d& x = grid.centre[c];
        if (std::abs(x.x - 3) > 0.1 || std::abs(x.y) > 0.1) continue;
        ++found;
        EXPECT_LT(grid.volume[c], 0.1 * 0.1);
    }
    EXPECT_GT(found, 4U);
}

TEST(HexCylinder, ScaleKeepsTheFamily) {
    // with half the scale, every other node of both directions is one of the coarser mesh
    CylinderShape shape{.cells = 5760, .first_height = 0.1};
    const HexMesh coarse = cylinder_mesh(shape);
    shape.scale = 0.5;
    const HexMesh fine = cylinder_mesh(shape);
    EXPECT_EQ(fine.cells.size(), 4 * coarse.cells.size());
    ASSERT_EQ(coarse.patches[0].name, "cylinder");
    const std::size_t around = coarse.patches[0].faces.size(), outward = coarse.cells.size() / around;
    double worst = 0;
    for (std::size_t j = 0; j <= outward; ++j) {
        for (std::size_t i = 0; i < around; ++i) {
            const Vec3d& a = coarse.nodes[j * around + i];
            const Vec3d& b = fine.nodes[2 * j * 2 * around + 2 * i];
            worst = std::max(worst, norm(a - b) / norm(a));
        }
    }
    EXPECT_LT(worst, 0.003);  // not 0: the first cells are exactly half as high, while sinh k is not linear
}

TEST(HexCylinder, MeshSeriesHasTheCellsAskedFor) {
    for (const int cells : {7021, 13051, 18517, 25877}) {
        const HexMesh mesh = cylinder_mesh({.cells = cells});
        EXPECT_NEAR(static_cast<double>(mesh.cells.size()) / cells, 1, 0.02);
    }
    EXPECT_THROW(cylinder_mesh({.first_height = 0}), InputError);
    EXPECT_THROW(cylinder_mesh({.cells = 300, .first_height = 0.001}), InputError);
    EXPECT_THROW(cylinder_mesh({.radius = 3, .first_height = 0.4}), InputError);
}

TEST(HexPipe, StraightPipeIsRound) {
    const HexGrid grid = make_hex_grid(pipe_mesh({.diameter = 2, .length = 3}));
    const HexQuality q = quality(grid);
    EXPECT_NEAR(static_cast<double>(q.cells) / 20000, 1, 0.05);
    EXPECT_NEAR(q.volume, 6 * pi, 0.005 * q.volume);
    EXPECT_NEAR(area_of(grid, "wall").second, 2 * pi * 6, 0.1);
    EXPECT_NEAR(area_of(grid, "inlet").first.x, -pi, 0.02);
    EXPECT_NEAR(area_of(grid, "outlet").first.x, pi, 0.02);
    EXPECT_LT(q.nonorthogonality, 35);
    const HexGrid periodic = make_hex_grid(pipe_mesh({.cells = 3000}), {{"inlet", "outlet"}});
    EXPECT_EQ(periodic.patches.size(), 1U);
}

TEST(HexPipe, ConstrictionHasItsProfile) {
    // volume of the narrowed part: with c = cos, the mean of (1 - s/2 (1 + c))^2 is 1 - s + 3/8 s^2
    const PipeShape shape{
        .length = 4, .cells = 40000, .constriction = 0.4, .throat_length = 2, .throat = 1.5};
    const HexGrid grid = make_hex_grid(pipe_mesh(shape));
    const double exact = pi / 4 * (2 + 2 * (1 - 0.4 + 0.375 * 0.16));
    EXPECT_NEAR(quality(grid).volume / exact, 1, 0.005);
    double narrowest = 1;
    const HexGrid::Patch& wall = patch(grid, "wall");
    for (std::size_t f = wall.first; f < wall.first + wall.count; ++f) {
        const Vec3d& x = grid.face_centre[f];
        if (std::abs(x.x - 1.5) < 0.1) narrowest = std::min(narrowest, std::hypot(x.y, x.z));
    }
    EXPECT_NEAR(narrowest, 0.3, 0.005);
    PipeShape outside = shape;
    outside.throat = 0.5;
    EXPECT_THROW(pipe_mesh(outside), InputError);
    outside.throat = 2;
    outside.constriction = 1;
    EXPECT_THROW(pipe_mesh(outside), InputError);
}

TEST(PlaneMesh, DrawnOutQuadIsAStackOfCells) {
    PlaneMesh plane{
        {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {{0, 1, 2, 3}}, {{"around", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}}};
    const HexGrid grid = make_hex_grid(extrude(plane, {0, 1, 3}, "low", "high"));
    EXPECT_EQ(grid.cells(), 2U);
    EXPECT_NEAR(quality(grid).volume, 6, 1e-14);
    EXPECT_EQ(patch(grid, "around").count, 8U);
    EXPECT_NEAR(area_of(grid, "high").first.z, 2, 1e-15);
    EXPECT_NEAR(area_of(make_hex_grid(z_to_x(extrude(plane, {0, 1}, "low", "high"))), "low").first.x, -2,
                1e-15);
    EXPECT_THROW(extrude(plane, {0}, "low", "high"), InputError);
}

}  // namespace
}  // namespace hemoflux::meshing
