#include "coupling/hex_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exchange/backend.hpp"
#include "hex_grids.hpp"

namespace hemoflux::coupling {
namespace {

using test::Points;

/// Whether x lies in the tetrahedron, by the signs of the four volumes it forms with the faces.
bool in_tetrahedron(const Vec3d& x, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const auto volume = [](const Vec3d& p, const Vec3d& q, const Vec3d& r, const Vec3d& s) {
        return dot(q - p, cross(r - p, s - p));
    };
    const double all = volume(a, b, c, d);
    return volume(x, b, c, d) / all >= 0 && volume(a, x, c, d) / all >= 0 && volume(a, b, x, d) / all >= 0 &&
           volume(a, b, c, x) / all >= 0;
}

/// The cells that hold x, by all 24 tetrahedra of every cell.
std::vector<std::uint32_t> brute_force(const meshing::HexGrid& grid, const Vec3d& x) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t c = 0; c < grid.cells(); ++c) {
        bool inside = false;
        for (const auto& face : meshing::hex_faces) {
            Vec3d p[4], middle{0, 0, 0};
            for (std::size_t i = 0; i < 4; ++i) {
                p[i] = grid.nodes[grid.corners[c][static_cast<std::size_t>(face[i])]];
                middle += 0.25 * p[i];
            }
            for (std::size_t i = 0; i < 4; ++i)
                inside = inside || in_tetrahedron(x, grid.centre[c], middle, p[i], p[(i + 1) % 4]);
        }
        if (inside) found.push_back(c);
    }
    return found;
}

class HexWalk : public testing::Test {
  protected:
    void SetUp() override { exchange::set_threads(1); }
    void TearDown() override { exchange::set_threads(0); }
};

}  // namespace

TEST_F(HexWalk, WalksToTheCellThatBruteForceFinds) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.25);
    const HexCells cells(grid);
    std::vector<Vec3d> points = test::anywhere(300, 0, 6);
    HexLink link(cells, Kernel::phi3, points.size());
    for (int round = 0; round < 2;
         ++round) {  // from the nearest centre, then from the cell of the first round
        const Points p(points);
        link.locate(test::view(p, points.size()));
        EXPECT_EQ(link.first_lost(), points.size());
        const auto found = link.stencils();
        for (std::size_t m = 0; m < points.size(); ++m)
            EXPECT_EQ(brute_force(grid, points[m]), std::vector<std::uint32_t>{found[m].place.cell}) << m;
        const auto moves = test::anywhere(points.size(), -2, 2, 9);
        for (std::size_t m = 0; m < points.size(); ++m) {
            const Vec3d to = points[m] + moves[m];
            points[m] = {std::clamp(to.x, 0.01, 5.99), std::clamp(to.y, 0.01, 5.99),
                         std::clamp(to.z, 0.01, 5.99)};
        }
    }
}

TEST_F(HexWalk, CountsThePeriodsOfNodesThatHaveLeftTheGrid) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.2, true);
    const HexCells cells(grid);
    const std::vector<Vec3d> inside = test::anywhere(50, 0.1, 5.9);
    std::vector<Vec3d> away = inside;
    for (std::size_t m = 0; m < away.size(); ++m) away[m].x += 6.0 * (static_cast<double>(m % 7) - 3);
    HexLink near(cells, Kernel::phi3, inside.size()), far(cells, Kernel::phi3, away.size());
    const Points a(inside), b(away);
    near.locate(test::view(a, inside.size()));
    far.locate(test::view(b, away.size()));
    for (std::size_t m = 0; m < away.size(); ++m) {
        const HexPlace here = near.stencils()[m].place, there = far.stencils()[m].place;
        EXPECT_EQ(here.cell, there.cell);
        EXPECT_NEAR(cells.walk().offset(there).x - cells.walk().offset(here).x, away[m].x - inside[m].x,
                    1e-12);
    }
    EXPECT_TRUE(cells.contains({-29, 3, 3}));
    EXPECT_FALSE(cells.contains({3, 6.1, 3}));
}

TEST_F(HexWalk, NamesALostNodeAndFindsItAgain) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.2);
    const HexCells cells(grid);
    HexLink link(cells, Kernel::lagrange, 3);
    const auto lost_at = [&](const std::vector<Vec3d>& points) {
        const Points p(points);
        link.locate(test::view(p, 3));
        return link.first_lost();
    };
    EXPECT_EQ(lost_at({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), 3u);
    EXPECT_EQ(lost_at({{1, 1, 1}, {2, 6.01, 2}, {3, 3, 3}}), 1u);
    EXPECT_EQ(lost_at({{1, 1, 1}, {5, 5.99, 0.1}, {3, 3, 3}}), 3u);
    EXPECT_EQ(lost_at({{1, 1, 1}, {5, 5, 1}, {3, std::nan(""), 3}}), 2u);
    EXPECT_EQ(lost_at({{5, 5, 5}, {1, 1, 1}, {0.5, 0.5, 5.5}}), 3u);
}

TEST_F(HexWalk, KnowsTheSizesOfItsCellsAndTheBoxAroundThem) {
    const meshing::HexGrid grid = test::skewed_box(6, 0, true);
    const HexCells cells(grid);
    EXPECT_NEAR(cells.smallest(), 1, 1e-12);
    EXPECT_NEAR(cells.cell_volume({2.5, 2.5, 2.5}), 1, 1e-12);
    EXPECT_NEAR(cells.width({2.5, 2.5, 2.5}, {0.6, 0.8, 0}), 1, 1e-12);
    const NodeBox box = cells.box();
    EXPECT_TRUE(box.periodic[0]);
    EXPECT_FALSE(box.periodic[1] || box.periodic[2]);
    EXPECT_NEAR(box.length[0], 6, 1e-12);
}

}  // namespace hemoflux::coupling
