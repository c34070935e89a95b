/// Closed triangulated surfaces: storage, area, volume and quality.
///
///   A = 1/2 sum |(b - a) x (c - a)|,  V = 1/6 sum a . (b x c),  v = 6 sqrt(pi) V / A^{3/2}
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::meshing {

/// Vertex numbers of one triangle, counter-clockwise seen from outside.
using Triangle = std::array<int, 3>;

/// Vertex numbers of one edge, the smaller first.
using Edge = std::array<int, 2>;

/// A triangulated surface; vertices in um, numbered from 0.
struct SurfaceMesh {
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;
};

/// Area of triangle t times its unit normal, um^2.
Vec3d area_vector(const SurfaceMesh& mesh, std::size_t t);

/// Surface area, um^2.
double area(const SurfaceMesh& mesh);

/// Enclosed volume, um^3; negative where the triangles are oriented inward.
double volume(const SurfaceMesh& mesh);

/// Centroid of the enclosed volume, um. The surface must be closed with a volume other than zero.
Vec3d centroid(const SurfaceMesh& mesh);

/// Volume over that of the sphere of equal area: 1 for a sphere, about 0.64 for a red blood cell.
double reduced_volume(const SurfaceMesh& mesh);

/// All edges once, in ascending order.
std::vector<Edge> edges(const SurfaceMesh& mesh);

/// Moves every vertex by the given vector, um.
void translate(SurfaceMesh& mesh, const Vec3d& by);

/// What the accuracy of a surface mesh hangs on.
struct SurfaceQuality {
    /// Number of edges and V - E + F: 2 for a closed surface without handles.
    std::size_t edges = 0;
    int euler_characteristic = 0;
    /// Edge lengths, um.
    double shortest_edge = 0, longest_edge = 0, mean_edge = 0;
    /// Smallest angle of any triangle, degrees; 60 for equilateral ones.
    double smallest_angle = 0;
    /// How many vertices have how many edges: {5: 12, 6: N - 12} on an icosphere.
    std::map<int, int> valences;
};

/// The quality numbers of a mesh with at least one triangle.
SurfaceQuality quality(const SurfaceMesh& mesh);

}  // namespace hemoflux::meshing
