#include "meshing/icosphere.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

SurfaceMesh icosahedron() {
    using Point = CGAL::Simple_cartesian<double>::Point_3;
    CGAL::Surface_mesh<Point> solid;
    CGAL::make_icosahedron<CGAL::Surface_mesh<Point>, Point>(solid);
    SurfaceMesh mesh;
    for (const auto v : solid.vertices()) {
        const Point& p = solid.point(v);
        mesh.vertices.push_back({p.x(), p.y(), p.z()});
    }
    for (const auto f : solid.faces()) {
        Triangle triangle{};
        std::size_t corner = 0;
        for (const auto v : solid.vertices_around_face(solid.halfedge(f)))
            triangle[corner++] = static_cast<int>(v.idx());
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

// Splits every triangle in four; midpoints are numbered after the old vertices, in the order of their edges.
SurfaceMesh divided(const SurfaceMesh& coarse) {
    const std::vector<Edge> all = edges(coarse);
    const int first = static_cast<int>(coarse.vertices.size());
    SurfaceMesh fine;
    fine.vertices = coarse.vertices;
    fine.vertices.reserve(coarse.vertices.size() + all.size());
    for (const auto& [p, q] : all)
        fine.vertices.push_back(0.5 * (coarse.vertices[static_cast<std::size_t>(p)] +
                                       coarse.vertices[static_cast<std::size_t>(q)]));
    const auto midpoint = [&](int p, int q) {
        const Edge edge{std::min(p, q), std::max(p, q)};
        return first + static_cast<int>(std::lower_bound(all.begin(), all.end(), edge) - all.begin());
    };
    fine.triangles.reserve(4 * coarse.triangles.size());
    for (const auto& [a, b, c] : coarse.triangles) {
        const int ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
        fine.triangles.insert(fine.triangles.end(),
                              {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

int nodes_of(int level) { return 10 * (1 << (2 * level)) + 2; }

}  // namespace

SurfaceMesh icosphere(int level, double radius) {
    if (level < 0 || level > icosphere_max_level)
        throw InputError(fmt::format("icosphere of level {}", level),
                         fmt::format("levels run from 0 to {}", icosphere_max_level),
                         "Choose 4 for the 2562 vertices of a resolved red blood cell");
    if (!std::isfinite(radius) || !(radius > 0))
        throw InputError(fmt::format("icosphere of radius {} um", radius), "a radius must be positive",
                         "Give a positive radius");
    SurfaceMesh mesh = icosahedron();
    for (int i = 0; i < level; ++i) mesh = divided(mesh);
    const std::vector<Vec3d> unit = directions(mesh);
    for (std::size_t v = 0; v < unit.size(); ++v) mesh.vertices[v] = radius * unit[v];
    return mesh;
}

int icosphere_level(int nodes) {
    for (int level = 1; level <= icosphere_max_level; ++level)
        if (nodes_of(level) == nodes) return level;
    throw InputError(fmt::format("icosphere of {} nodes", nodes), "an icosphere has 10 4^level + 2 nodes",
                     "Choose 42, 162, 642, 2562, 10242 or 40962");
}

std::vector<Vec3d> directions(const SurfaceMesh& sphere) {
    std::vector<Vec3d> unit;
    unit.reserve(sphere.vertices.size());
    for (const Vec3d& p : sphere.vertices) {
        const double r = norm(p);
        if (!(r > 0))
            throw InputError(fmt::format("sphere mesh with vertex {} at its centre", unit.size()),
                             "that vertex has no direction", "Centre the sphere at the origin");
        unit.push_back((1 / r) * p);
    }
    return unit;
}

}  // namespace hemoflux::meshing
