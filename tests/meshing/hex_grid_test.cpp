#include "meshing/hex_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "exchange/error.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_quality.hpp"

namespace hemoflux::meshing {
namespace {

const BoxDistortion wild{.skew = 0.02, .random = 0.3, .shuffle = true, .seed = 7};

HexMesh cubes(int nx, int ny, int nz, const BoxDistortion& distortion = {}) {
    return box_mesh({0, 0, 0}, {0.5 * nx, 0.5 * ny, 0.5 * nz}, {nx, ny, nz}, distortion);
}

const std::vector<PeriodicPair> all_periodic{{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}};

/// The message of the InputError that building a grid raises.
std::string refusal(const HexMesh& mesh, const std::vector<PeriodicPair>& periodic = {}) {
    try {
        make_hex_grid(mesh, periodic);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void expect_mentions(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << '"' << message << "\" lacks \"" << part << '"';
}

/// Largest |sum of outward areas| of a cell over its largest face.
double gap(const HexGrid& grid) {
    double worst = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        Vec3d sum{0, 0, 0};
        double largest = 0;
        for (std::size_t k = grid.first_face[c]; k < grid.first_face[c + 1]; ++k) {
            sum += static_cast<double>(grid.outward[k]) * grid.area[grid.face[k]];
            largest = std::max(largest, norm(grid.area[grid.face[k]]));
        }
        worst = std::max(worst, norm(sum) / largest);
    }
    return worst;
}

double total_volume(const HexGrid& grid) {
    double sum = 0;
    for (const double v : grid.volume) sum += v;
    return sum;
}

TEST(HexGrid, CellsAreClosedAndFillTheBox) {
    const HexGrid open = make_hex_grid(cubes(6, 5, 4, wild));
    EXPECT_LT(gap(open), 1e-14);
    EXPECT_NEAR(total_volume(open), 3 * 2.5 * 2, 1e-12);
    const HexGrid closed = make_hex_grid(cubes(6, 5, 4, wild), all_periodic);
    EXPECT_LT(gap(closed), 1e-14);
    EXPECT_EQ(closed.border_faces(), 0U);
    EXPECT_EQ(closed.faces(), 3U * 6 * 5 * 4);
}

TEST(HexGrid, CentresOfWarpedCellsAddUpToThatOfTheBox) {
    const HexGrid grid = make_hex_grid(cubes(4, 4, 4, wild));
    Vec3d moment{0, 0, 0};
    for (std::size_t c = 0; c < grid.cells(); ++c) moment += grid.volume[c] * grid.centre[c];
    EXPECT_NEAR(moment.x / 8, 1, 1e-13);
    EXPECT_NEAR(moment.y / 8, 1, 1e-13);
    EXPECT_NEAR(moment.z / 8, 1, 1e-13);
}

TEST(HexGrid, FrustumHasItsExactVolumeAndCentre) {
    // bottom 2 x 2, top 1 x 1, height 3: V = h/3 (A + a + sqrt(A a)) = 7, centre at h/4 (A + 2 sqrt(A a) + 3 a) /
    // (A + sqrt(A a) + a) = 33/28
    HexMesh mesh = box_mesh({-1, -1, 0}, {1, 1, 3}, {1, 1, 1});
    for (Vec3d& x : mesh.nodes)
        if (x.z > 1) x = {0.5 * x.x, 0.5 * x.y, x.z};
    const HexGrid grid = make_hex_grid(mesh);
    EXPECT_NEAR(grid.volume[0], 7, 1e-13);
    EXPECT_NEAR(grid.centre[0].z, 33.0 / 28, 1e-13);
    const std::size_t side =
        grid.patches[0].first;  // trapezium x-: centre of area at h/3 (2 + 2) / (2 + 1) = 4/3
    EXPECT_NEAR(grid.face_centre[side].z, 4.0 / 3, 1e-13);
    EXPECT_NEAR(norm(grid.area[side]), 1.5 * std::hypot(3, 0.5), 1e-13);
}

TEST(HexGrid, FacesAreOrderedAndPointFromLeftToRight) {
    const HexGrid grid = make_hex_grid(cubes(5, 4, 3, wild), {{"y-", "y+"}});
    ASSERT_EQ(grid.shift.size(), grid.faces());
    for (std::size_t f = 0; f < grid.interior_faces(); ++f) {
        EXPECT_LT(grid.left[f], grid.right[f]);
        if (f > 0) {
            EXPECT_LE(std::pair(grid.left[f - 1], grid.right[f - 1]), std::pair(grid.left[f], grid.right[f]));
        }
        const Vec3d d = grid.centre[grid.right[f]] + grid.shift[f] - grid.centre[grid.left[f]];
        EXPECT_GT(dot(d, grid.area[f]), 0);
        EXPECT_LT(norm(d), 1.0);  // also across the pair, where the centres are 2 apart
    }
    EXPECT_EQ(grid.patches.size(), 4U);
    std::size_t next = grid.interior_faces();
    for (const HexGrid::Patch& patch : grid.patches) {
        EXPECT_EQ(patch.first, next);
        next += patch.count;
        for (std::size_t f = patch.first; f < next; ++f) {
            EXPECT_EQ(grid.right[f], grid.cells() + f - grid.interior_faces());
            if (f > patch.first) {
                EXPECT_LE(grid.left[f - 1], grid.left[f]);
            }
            EXPECT_GT(dot(grid.face_centre[f] - grid.centre[grid.left[f]], grid.area[f]), 0);
        }
    }
    EXPECT_EQ(next, grid.faces());
    std::set<std::size_t> originals(grid.original.begin(), grid.original.end());
    EXPECT_EQ(originals.size(), grid.cells());
}

TEST(HexGrid, DeltaIsHalfTheWidthOfCubes) {
    for (const auto& periodic : {std::vector<PeriodicPair>{}, all_periodic})
        for (const double delta : make_hex_grid(cubes(4, 4, 4, {.shuffle = true}), periodic).delta)
            EXPECT_NEAR(delta, 0.25, 1e-15);
}

TEST(HexGrid, DeltaOfRectilinearCellsIsTheSmallerWidthAcrossOrHalfALateralOne) {
    RectilinearGrid box;
    box.axes = {explicit_axis({0, 0.1, 0.4, 1.4}), uniform_axis(0, 3, 3), uniform_axis(0, 3, 3)};
    const HexGrid grid = make_hex_grid(box_mesh(box));
    std::size_t checked = 0;
    for (std::size_t f = 0; f < grid.interior_faces(); ++f) {
        if (std::abs(grid.area[f].x) > 0.5) {
            EXPECT_NEAR(grid.delta[f], grid.face_centre[f].x < 0.2 ? 0.1 : 0.3, 1e-14);
            ++checked;
        } else if (grid.face_centre[f].x > 0.4) {
            EXPECT_NEAR(grid.delta[f], 0.5, 1e-14);
            ++checked;
        }
    }
    EXPECT_EQ(checked, 2U * 9 + 12);
}

TEST(HexGrid, OneCellAcrossDoesNotLimitDelta) {
    const HexMesh sheet = box_mesh({0, 0, 0}, {4, 4, 0.01}, {4, 4, 1});
    for (const auto& periodic : {std::vector<PeriodicPair>{}, {{"z-", "z+"}}})
        for (const double delta : make_hex_grid(sheet, periodic).delta) EXPECT_NEAR(delta, 0.5, 1e-14);
    EXPECT_NEAR(quality(make_hex_grid(sheet)).aspect, 1, 1e-12);
    for (const double delta : make_hex_grid(cubes(1, 1, 1)).delta) EXPECT_NEAR(delta, 0.25, 1e-15);
}

TEST(HexGrid, LatticeNodesLieInsideTheCellsOfASkewedGrid) {
    // every node r - e delta is behind no face of the cell it streams from
    const HexGrid grid = make_hex_grid(cubes(6, 6, 6, {.skew = 0.04, .shuffle = true}));
    double farthest = 1;
    for (std::size_t f = 0; f < grid.faces(); ++f) {
        const FaceFrame frame = face_frame((1 / norm(grid.area[f])) * grid.area[f]);
        for (const std::size_t c : {grid.left[f], grid.right[f]}) {
            if (c >= grid.cells()) continue;
            const double inward = c == grid.left[f] ? -1 : 1;
            for (int corner = 0; corner < 5; ++corner) {
                Vec3d e = inward * frame.normal;
                if (corner > 0)
                    e += (corner % 2 ? 1.0 : -1.0) * frame.tangent1 +
                         (corner > 2 ? 1.0 : -1.0) * frame.tangent2;
                for (std::size_t k = grid.first_face[c]; k < grid.first_face[c + 1]; ++k) {
                    if (grid.face[k] == f) continue;
                    const Vec3d out = static_cast<double>(grid.outward[k]) * grid.area[grid.face[k]];
                    const Vec3d start = grid.face_centre[grid.face[k]] - grid.face_centre[f];
                    const double left_over = dot(start - grid.delta[f] * e, out) / dot(start, out);
                    EXPECT_GT(left_over, -1e-12);
                    farthest = std::min(farthest, left_over);
                }
            }
        }
    }
    EXPECT_NEAR(farthest, 0, 1e-12);  // and one of them touches
}

TEST(HexGrid, ACellCanBeItsOwnNeighbour) {
    const HexGrid grid = make_hex_grid(cubes(3, 2, 1), {{"z-", "z+"}, {"x-", "x+"}});
    EXPECT_LT(gap(grid), 1e-15);
    std::size_t own = 0;
    for (std::size_t f = 0; f < grid.interior_faces(); ++f) {
        if (grid.left[f] != grid.right[f]) continue;
        ++own;
        EXPECT_NEAR(norm(grid.shift[f]), 0.5, 1e-15);
        EXPECT_GT(dot(grid.shift[f], grid.area[f]), 0);
        const std::uint32_t c = grid.left[f];
        int balance = 0, listed = 0;
        for (std::size_t k = grid.first_face[c]; k < grid.first_face[c + 1]; ++k)
            if (grid.face[k] == f) balance += grid.outward[k], ++listed;
        EXPECT_EQ(balance, 0);
        EXPECT_EQ(listed, 2);
    }
    EXPECT_EQ(own, 6U);
}

TEST(HexGrid, RefusesBadMeshes) {
    HexMesh inverted = cubes(3, 3, 3);
    std::swap(inverted.cells[13][0], inverted.cells[13][4]);
    std::swap(inverted.cells[13][1], inverted.cells[13][5]);
    std::swap(inverted.cells[13][2], inverted.cells[13][6]);
    std::swap(inverted.cells[13][3], inverted.cells[13][7]);
    expect_mentions(refusal(inverted), "cell 13 at (0.75, 0.75, 0.75) has the volume -0.125");

    HexMesh flat = cubes(2, 1, 1);
    for (Vec3d& x : flat.nodes) x.z = 0;
    expect_mentions(refusal(flat), "has the volume 0");

    HexMesh wedge = cubes(2, 1, 1);
    wedge.cells[1][0] = wedge.cells[1][1];
    expect_mentions(refusal(wedge), "cell 1 at");

    HexMesh doubled = cubes(2, 1, 1);
    doubled.cells.push_back(doubled.cells[0]);
    doubled.cells.push_back(doubled.cells[0]);
    expect_mentions(refusal(doubled), "cells share one face");

    HexMesh unnamed = cubes(3, 3, 3);
    unnamed.patches.erase(unnamed.patches.begin() + 2);
    expect_mentions(refusal(unnamed), "9 border faces are in no patch, the first on cell 0");

    HexMesh twice = cubes(2, 2, 2);
    twice.patches[0].faces.push_back(twice.patches[3].faces[1]);
    expect_mentions(refusal(twice), "in patch \"x-\" and in \"y+\"");
    twice = cubes(2, 2, 2);
    twice.patches[1].name = "x-";
    expect_mentions(refusal(twice), "two patches named \"x-\"");

    HexMesh inner = cubes(2, 1, 1);
    inner.patches[0].faces.push_back({1, 4, 10, 7});
    expect_mentions(refusal(inner), "between cells 0 and 1");
    inner.patches[0].faces.back() = {0, 1, 2, 3};
    expect_mentions(refusal(inner), "no face of a cell");

    HexMesh lost = cubes(1, 1, 1);
    lost.cells[0][3] = 8;
    expect_mentions(refusal(lost), "refers to node 8");
    expect_mentions(refusal(HexMesh{}), "without hexahedra");
    lost = cubes(1, 1, 1);
    lost.nodes[5].y = NAN;
    expect_mentions(refusal(lost), "node 5");
}

TEST(HexGrid, RefusesPeriodicPatchesThatDoNotMatch) {
    HexMesh mesh = cubes(4, 3, 2);
    expect_mentions(refusal(mesh, {{"x-", "inlet"}}), "Its patches are x-, x+, y-");
    expect_mentions(refusal(mesh, {{"x-", "x-"}}), "its own opposite");
    expect_mentions(refusal(mesh, {{"x-", "y-"}}), "6 and 8 faces");
    expect_mentions(refusal(mesh, {{"x-", "x+"}, {"x+", "x-"}}), "no patch of this name");
    mesh.nodes[mesh.patches[1].faces[2][2]].y += 0.01;
    expect_mentions(refusal(mesh, {{"x-", "x+"}}), "has no opposite");
}

TEST(HexGrid, FrameIsOrthonormalAndKeepsToTheAxes) {
    const std::vector<Vec3d> normals{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0.36, -0.48, 0.8}};
    for (const Vec3d& n : normals) {
        const FaceFrame f = face_frame(n);
        EXPECT_NEAR(norm(f.tangent1), 1, 1e-15);
        EXPECT_NEAR(norm(f.tangent2), 1, 1e-15);
        EXPECT_NEAR(norm(cross(f.tangent1, f.tangent2) - n), 0, 1e-15);
    }
    EXPECT_EQ(face_frame({1, 0, 0}).tangent1.y, 1);
    EXPECT_EQ(face_frame({0.6, 0.8, 0}).tangent2.z, 1);
}

TEST(HexQuality, CubesArePerfectAndSkewShows) {
    const HexQuality perfect = quality(make_hex_grid(cubes(4, 4, 4), all_periodic));
    EXPECT_NEAR(perfect.nonorthogonality, 0, 1e-6);
    EXPECT_NEAR(perfect.skewness, 0, 1e-14);
    EXPECT_NEAR(perfect.aspect, 1, 1e-14);
    EXPECT_NEAR(perfect.growth, 1, 1e-14);
    EXPECT_NEAR(perfect.volume, 8, 1e-13);

    // a sheared row: centres step by (1, 0.5) across faces whose normal is x
    HexMesh sheared = box_mesh({0, 0, 0}, {3, 3, 1}, {3, 3, 1});
    for (Vec3d& x : sheared.nodes) x.y += 0.5 * x.x;
    const HexQuality q = quality(make_hex_grid(sheared));
    EXPECT_NEAR(q.nonorthogonality, std::atan(0.5) * 180 / M_PI, 1e-10);
    EXPECT_NEAR(q.skewness, 0, 1e-14);
    EXPECT_NEAR(q.aspect, std::sqrt(1.25), 1e-14);
    expect_mentions(report(q), "non-orthogonality    26.57 degrees");
}

}  // namespace
}  // namespace hemoflux::meshing
