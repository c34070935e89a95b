#include "coupling/signed_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/surface_gap.hpp"
#include "exchange/backend.hpp"
#include "grids.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

namespace {

const double pi = std::acos(-1.0);

/// Closest point by regions: another algorithm than that of the band.
double triangle_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return norm(p - nearest_point(p, a, b, c));
}

/// Sum of the solid angles of all triangles over 4 pi: 1 inside, 0 outside (Van Oosterom and Strackee 1983).
double winding(const meshing::SurfaceMesh& mesh, const Vec3d& p) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        Vec3d r[3];
        for (std::size_t v = 0; v < 3; ++v) r[v] = mesh.vertices[static_cast<std::size_t>(t[v])] - p;
        const double l0 = norm(r[0]), l1 = norm(r[1]), l2 = norm(r[2]);
        sum += 2 * std::atan2(dot(r[0], cross(r[1], r[2])), l0 * l1 * l2 + dot(r[0], r[1]) * l2 +
                                                                dot(r[1], r[2]) * l0 + dot(r[2], r[0]) * l1);
    }
    return sum / (4 * pi);
}

double brute_force(const meshing::SurfaceMesh& mesh, const Vec3d& p) {
    double d = 1e300;
    for (const auto& t : mesh.triangles)
        d = std::min(d, triangle_distance(p, mesh.vertices[static_cast<std::size_t>(t[0])],
                                          mesh.vertices[static_cast<std::size_t>(t[1])],
                                          mesh.vertices[static_cast<std::size_t>(t[2])]));
    return winding(mesh, p) > 0.5 ? d : -d;
}

meshing::SurfaceMesh moved(meshing::SurfaceMesh mesh, double angle, const Vec3d& by) {
    for (Vec3d& p : mesh.vertices) {
        const double c = std::cos(angle), s = std::sin(angle);
        p = Vec3d{c * p.x - s * p.z, p.y, s * p.x + c * p.z} + by;
    }
    return mesh;
}

/// d/h of one surface at all interior cells, x fastest.
std::vector<double> measure(const meshing::RectilinearGrid& grid, std::array<bool, 3> periodic,
                            const meshing::SurfaceMesh& mesh, HalfWidth h) {
    const CellGrid cells(grid, periodic);
    const auto layout = cells.view().layout;
    SignedDistance distance(cells, mesh.triangles, mesh.vertices.size(), 1, h);
    const test::Points p(mesh.vertices);
    distance.prepare(p[0], p[1], p[2]);
    exchange::Buffer<double> field(layout.size);
    distance.evaluate(0, field.data());
    const auto host = field.to_host();
    std::vector<double> out;
    for (std::size_t k = 0; k < layout.n[2]; ++k)
        for (std::size_t j = 0; j < layout.n[1]; ++j)
            for (std::size_t i = 0; i < layout.n[0]; ++i)
                out.push_back(host[layout.at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k))]);
    return out;
}
std::vector<Vec3d> centres(const meshing::RectilinearGrid& grid) {
    std::vector<Vec3d> out;
    const auto x = grid.axes[0].centres(), y = grid.axes[1].centres(), z = grid.axes[2].centres();
    for (const double c : z)
        for (const double b : y)
            for (const double a : x) out.push_back({a, b, c});
    return out;
}

/// Compares with the double loop over all cells and triangles; counts the cells in the band.
std::size_t compare(const meshing::RectilinearGrid& grid, const meshing::SurfaceMesh& mesh, double h) {
    const auto got = measure(grid, {false, false, false}, mesh, {1, h});
    const auto points = centres(grid);
    std::size_t band = 0;
    for (std::size_t c = 0; c < points.size(); ++c) {
        const double expected = std::clamp(brute_force(mesh, points[c]) / h, -1.0, 1.0);
        // the square of the distance is exact to 1e-14 of the triangle, so its root is to 1e-7 near zero
        EXPECT_NEAR(got[c], expected, std::fabs(expected) < 1e-3 ? 1e-6 : 1e-11) << "cell " << c;
        if (std::fabs(expected) < 1) ++band;
    }
    return band;
}

}  // namespace

TEST(SignedDistance, SphereAgreesWithTheDoubleLoopAndWithTheSphere) {
    const auto axis = meshing::uniform_axis(-2, 2, 25);
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    // centred on a cell: rows run exactly through vertices and edges
    const auto mesh = meshing::icosphere(3, 1.5);
    EXPECT_GT(compare(grid, mesh, 0.4), 3000u);
    const auto got = measure(grid, {false, false, false}, mesh, {1, 0.4});
    const auto points = centres(grid);
    for (std::size_t c = 0; c < points.size(); ++c)
        EXPECT_NEAR(0.4 * got[c], std::clamp(1.5 - norm(points[c]), -0.4, 0.4),
                    0.012);  // sagitta of the facets
}

TEST(SignedDistance, TiltedDiscocyteAgreesWithTheDoubleLoop) {
    const auto x = meshing::plateau_axis(-5, 5, 22, 8, 0.3), y = test::random_axis(-5, 5, 19, 8),
               z = meshing::uniform_axis(-4.5, 4.5, 16);
    for (const double angle : {0.0, 0.7, 1.5707963267948966}) {
        const auto mesh = moved(meshing::evans_fung(meshing::icosphere(3, 1.0)), angle, {0.1, -0.2, 0.05});
        EXPECT_GT(compare({{x, y, z}}, mesh, 0.5), 600u);
    }
}

TEST(SignedDistance, CoarseSpheroidWithLargeTriangles) {
    const auto axis = test::random_axis(-3, 3, 24, 5);
    const auto mesh = moved(meshing::spheroid(meshing::icosphere(1, 1.0), 2.5, 1.0, 0.6), 0.3, {0.05, 0, 0});
    EXPECT_GT(compare({{axis, axis, axis}}, mesh, 0.35), 500u);
}

// With a half-width of the local cell: the value is min d_t/h_t, h_t from the widths at the corners.
TEST(SignedDistance, LocalHalfWidth) {
    const auto axis = meshing::plateau_axis(-6, 6, 30, 10, 0.2);
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    const auto mesh = moved(meshing::evans_fung(meshing::icosphere(3, 1.0)), 0.4, {0.5, 0, 0});
    const auto got = measure(grid, {false, false, false}, mesh, {1.5, 0});
    const auto c = axis.centres(), w = axis.widths();
    const auto width = [&](double X) {
        std::size_t k = 0;
        while (k + 2 < c.size() && c[k + 1] <= X) ++k;
        return w[k] + (X - c[k]) / (c[k + 1] - c[k]) * (w[k + 1] - w[k]);
    };
    std::vector<double> h;
    for (const Vec3d& p : mesh.vertices) h.push_back(1.5 * std::max({width(p.x), width(p.y), width(p.z)}));
    const auto points = centres(grid);
    std::size_t band = 0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        double ratio = 1;
        for (const auto& t : mesh.triangles) {
            const auto a = static_cast<std::size_t>(t[0]), b = static_cast<std::size_t>(t[1]),
                       d = static_cast<std::size_t>(t[2]);
            ratio = std::min(
                ratio, triangle_distance(points[i], mesh.vertices[a], mesh.vertices[b], mesh.vertices[d]) /
                           std::max({h[a], h[b], h[d]}));
        }
        EXPECT_NEAR(std::fabs(got[i]), ratio, ratio < 1e-3 ? 1e-6 : 1e-11);
        if (ratio < 1) ++band;
    }
    EXPECT_GT(band, 1000u);
}

// Every row of every orientation of a mesh aligned with the grid is closed: no cell far outside counts as
// inside.
TEST(SignedDistance, AlignedMeshesHaveNoLeakingRows) {
    const auto axis = meshing::uniform_axis(-2, 2, 32);
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    const double h = 4.0 / 32;
    for (const int level : {0, 1, 2, 3})
        for (const double shift : {0.0, 0.5 * h, h / 3}) {
            const auto mesh = moved(meshing::icosphere(level, 12 * h), 0.0, {shift, shift, shift});
            const auto got = measure(grid, {false, false, false}, mesh, {1, h});
            const auto points = centres(grid);
            for (std::size_t c = 0; c < points.size(); ++c) {
                const double r = norm(points[c] - Vec3d{shift, shift, shift});
                if (r > 13.01 * h) {
                    EXPECT_EQ(got[c], -1);
                } else if (r < 8.5 * h) {
                    EXPECT_EQ(got[c], 1);
                }
            }
        }
}

// Anywhere in a periodic box, even many boxes away, a surface is measured as in its middle.
TEST(SignedDistance, PeriodicSurfaceAcrossTheSeam) {
    const int n = 24;
    const auto axis = meshing::uniform_axis(0, 12, n);
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    const auto disc = moved(meshing::evans_fung(meshing::icosphere(3, 1.0)), 0.5, {6.01, 6.02, 6.03});
    const auto middle = measure(grid, {true, true, true}, disc, {1, 0.6});
    for (const std::array<int, 3> s :
         {std::array<int, 3>{12, 0, 0}, {0, 11, 0}, {0, 0, 13}, {10, 12, -11}, {-61, 50, 37}}) {
        const auto far = measure(grid, {true, true, true},
                                 moved(disc, 0.0, {0.5 * s[0], 0.5 * s[1], 0.5 * s[2]}), {1, 0.6});
        for (int k = 0; k < n; ++k)
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i) {
                    const auto wrap = [](int a) { return static_cast<std::size_t>(((a % n) + n) % n); };
                    const std::size_t to = (wrap(k + s[2]) * n + wrap(j + s[1])) * n + wrap(i + s[0]);
                    const std::size_t from = static_cast<std::size_t>((k * n + j) * n + i);
                    EXPECT_NEAR(far[to], middle[from], std::fabs(middle[from]) < 1e-3 ? 1e-6 : 1e-10);
                }
    }
}

TEST(SignedDistance, IsBitwiseTheSameForAnyNumberOfThreads) {
    const auto mesh = moved(meshing::evans_fung(meshing::icosphere(3, 1.0)), 0.6, {0, 0, 5});
    std::vector<std::vector<double>> results;
    for (const int count : {1, 2, 3, 1}) {
        exchange::set_threads(count);
        results.push_back(measure(test::tank_treading_grid(), {true, false, true}, mesh, {}));
    }
    exchange::set_threads(0);
    for (const auto& r : results) EXPECT_EQ(r, results[0]);
}
