/// Surface of a rigid body: nodes with the area and the normal that each stands for, about the body's centre.
///
///   nodes of a triangulated surface are its vertices, A_j = 1/3 sum of the triangles around vertex j
///   a cylinder that spans the box is open: A = (pi D / n_around) (L / n_along)                            (5.23)
///   the no-slip surface of smeared forces lies outside their nodes, by E |S - T| / 2 cells along the normal in a plane
///   shear flow (S, T distributed as the kernel): 0.23 phi2, 0.31 phi3, 0.41 phi4, 0.15 Lagrange, so nodes may be drawn
///   in (Breugem 2012)
///   second moments of the enclosed volume: sum over tetrahedra (0, a, b, c) of
///     det/120 (s s^T + a a^T + b b^T + c c^T), s = a + b + c;  inertia per density I = tr(S) 1 - S
#pragma once

#include <vector>

#include "coupling/fluid_grid.hpp"
#include "exchange/vec3.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::coupling {

/// A symmetric or rotated 3 x 3 matrix, by rows.
struct Matrix3 {
    Vec3d row[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    /// M v.
    [[nodiscard]] Vec3d operator*(const Vec3d& v) const {
        return {dot(row[0], v), dot(row[1], v), dot(row[2], v)};
    }
    /// M^T.
    [[nodiscard]] Matrix3 transposed() const;
};
/// The product A B.
Matrix3 operator*(const Matrix3& a, const Matrix3& b);

/// Nodes of a body in its own frame; lengths in um.
struct BodySurface {
    std::vector<Vec3d> nodes;    ///< about the centre
    meshing::SurfaceMesh mesh;   ///< the true surface, one vertex for each node
    std::vector<double> areas;   ///< um^2
    std::vector<Vec3d> normals;  ///< unit vectors, out of the body
    bool closed = true;          ///< false: a mantle that ends at the sides of the box
    double volume = 0;           ///< enclosed, um^3
    Matrix3 inertia;             ///< of the enclosed volume about the centre, per density, um^5
    /// Sum of the areas, um^2.
    [[nodiscard]] double area() const;
    /// Nodes per square of edge h.
    [[nodiscard]] double nodes_per_square(double h) const;
};

/// The surface whose nodes are the vertices of a closed mesh, moved so that the centroid of its volume is the origin.
/// InputError unless the mesh encloses a volume and every vertex belongs to a triangle.
BodySurface closed_surface(meshing::SurfaceMesh mesh);

/// The mantle of a circular cylinder about the origin along `axis` (unit vector), of n_around x n_along nodes at the
/// centres of equal patches. InputError unless lengths and numbers are positive, n_around >= 8.
BodySurface cylinder_mantle(double diameter, double length, const Vec3d& axis, int n_around, int n_along);

/// Draws the nodes in by `share` cells along the normal: share sqrt(sum (n_a h_a)^2), h_a the widths of the cells where
/// the node is when the body's centre is at `centre`. Areas, volume, inertia and mesh stay those of the true surface.
void retract(BodySurface& surface, const FluidGrid& grid, const Vec3d& centre, double share);

}  // namespace hemoflux::coupling
