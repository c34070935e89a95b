/// Areas, volumes and centres of hexahedra with bilinear faces:
///
///   S   = 1/2 (p2 - p0) x (p3 - p1)
///   r_f = sum_t c_t (A_t . S) / |S|^2            over the four triangles t about the mean point of the face
///   V   = 1/3 sum_faces sum_t c_t . A_t,  r_c = sum_tetrahedra V_t r_t / V
///
/// with c_t, A_t the centre and area vector of a triangle. V of these triangles equals that of the bilinear faces:
/// it is linear in the apex, and the apex is the mean of the two diagonals' middles.
#pragma once

#include <array>

#include "exchange/vec3.hpp"

namespace hemoflux::meshing {

/// A quadrilateral by its four corners in turn.
using Quad = std::array<Vec3d, 4>;

/// Area vector, by the right-hand rule.
Vec3d quad_area(const Quad& p);

/// Centre of area; the mean of the corners where the area is zero.
Vec3d quad_centre(const Quad& p);

/// Volume (negative when turned inside out) and centre of volume.
struct Solid {
    double volume;
    Vec3d centre;
};

/// Of the cell bounded by these faces, each turned outwards, in the order of hex_faces.
Solid hexahedron(const std::array<Quad, 6>& faces);

}  // namespace hemoflux::meshing
