#include "meshing/self_intersection.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace hemoflux::meshing {

std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh) {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    using Surface = CGAL::Surface_mesh<Point>;
    Surface surface;
    std::vector<Surface::Vertex_index> vertex;
    vertex.reserve(mesh.vertices.size());
    for (const Vec3d& p : mesh.vertices) vertex.push_back(surface.add_vertex(Point(p.x, p.y, p.z)));
    for (const Triangle& t : mesh.triangles)
        surface.add_face(vertex[static_cast<std::size_t>(t[0])], vertex[static_cast<std::size_t>(t[1])],
                         vertex[static_cast<std::size_t>(t[2])]);
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    std::vector<std::array<int, 2>> pairs;
    pairs.reserve(found.size());
    for (const auto& [f, g] : found) {
        const int p = static_cast<int>(f.idx()), q = static_cast<int>(g.idx());
        pairs.push_back({std::min(p, q), std::max(p, q)});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace hemoflux::meshing
