/// What a membrane's shape is: volume, moments, orientation, diameters, thickness.
///
/// Surface gyration tensor (area weighted, about the surface's centroid m), exact for flat triangles:
///   G = 1/A int (r - m)(r - m)^T dA,   per triangle  A_k/12 [sum_i p_i p_i^T + (sum_i p_i)(sum_i p_i)^T]
/// with p_i = R_i - m. Its eigenvectors are the principal axes.
///
/// Equivalent ellipsoid: half-axes a, b, c whose own surface has these principal moments,
///   G_i = a_i^2 int n_i^2 w dOmega / int w dOmega,
///   w = (b^2 c^2 n_x^2 + a^2 c^2 n_y^2 + a^2 b^2 n_z^2)^{1/2}
/// over the unit sphere. Taylor's deformation is D = (longest - shortest)/(longest + shortest).
///
/// Volume gyration tensor (of the enclosed volume, about its centroid c), exact for flat triangles by tetrahedra from c:
///   G = 1/V int (r - c)(r - c)^T dV,   per tetrahedron  V_k/20 [sum_i p_i p_i^T + (sum_i p_i)(sum_i p_i)^T]
/// with p_i = R_i - c. The ellipsoid with the same inertia has a_i^2 = 5 G_i; studies of capsules take D from it, or
/// from the greatest and least distance of the membrane from the centroid. All three agree on an ellipsoid only: an
/// end that is drawn out counts most in the distances, least in the volume.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "exchange/vec3.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::membrane {

using Triangles = std::vector<meshing::Triangle>;

/// Integral quantities of one closed surface.
struct ShapeMoments {
    double volume = 0;          ///< um^3
    double area = 0;            ///< um^2
    double reduced_volume = 0;  ///< 1 for a sphere
    Vec3d centroid{};           ///< of the enclosed volume, um
    /// Principal moments of the surface gyration tensor, um^2, greatest first, and their unit axes.
    std::array<double, 3> moments{};
    std::array<Vec3d, 3> axes{};
    /// Principal moments of the volume gyration tensor, um^2, greatest first.
    std::array<double, 3> volume_moments{};
};

/// Moments of a closed surface of outward triangles; positions in um.
ShapeMoments shape_moments(const Triangles& triangles, const std::vector<Vec3d>& positions);

/// Half-axes (um), greatest first, of the ellipsoid whose surface has these principal moments (um^2, greatest
/// first, all positive).
std::array<double, 3> ellipsoid_half_axes(const std::array<double, 3>& moments);

/// Principal moments (um^2) of the surface of the ellipsoid with these half-axes (um).
std::array<double, 3> ellipsoid_moments(const std::array<double, 3>& half_axes);

/// Taylor's deformation of the equivalent ellipsoid, 0 for a sphere.
double taylor_deformation(const ShapeMoments& moments);

/// Half-axes (um), greatest first, of the ellipsoid with the inertia of the enclosed volume.
std::array<double, 3> inertia_half_axes(const ShapeMoments& moments);

/// Taylor's deformation of the ellipsoid with the inertia of the enclosed volume (Ramanujan and Pozrikidis 1998).
double taylor_deformation_volume(const ShapeMoments& moments);

/// Taylor's deformation from the greatest and the least distance of a vertex from the volume centroid, exactly 0 for the
/// vertices of a sphere. Of a capsule; in a biconcave cell the least distance is that to a dimple.
double taylor_deformation_extent(const std::vector<Vec3d>& positions, const Vec3d& centroid);

/// Angle in degrees, in (-90, 90], from +x to the longest principal axis projected on the xy plane. Where
/// that axis is within 30 degrees of z, as one of the two equal axes of a disc may be, the next one counts.
double inclination(const ShapeMoments& moments);

/// Angle in radians, in (-pi, pi], of a point about the volume centroid in the xy plane.
double angle_about(const Vec3d& point, const Vec3d& centroid);

/// How far the membrane has turned since its vertices had the angles `labels` (angle_about the centroid, rad; one a vertex), in the xy
/// plane, in radians in (-pi, pi]: the inclination (rad; half turns do not matter) less the mean label of the vertices
/// that are now at the ends of the cell in that direction. The caller unwraps it in time; it falls as the membrane rolls
/// with u = G y, and is the angle of a body that turns as a whole. A point that is followed about the centroid loses
/// a turn where a folded cell does not enclose its centroid; the ends are never there.
double membrane_turn(const std::vector<Vec3d>& positions, std::span<const double> labels,
                     const Vec3d& centroid, double inclination);

/// Diameters along and across x of a cell centred at `centroid`: 2 max |r| and 2 max (y^2 + z^2)^{1/2}
/// (section 7.2.2), um.
struct Diameters {
    double axial = 0, transverse = 0;
};
Diameters stretch_diameters(const std::vector<Vec3d>& positions, const Vec3d& centroid);

/// Smallest rectangle around a cell's shadow on the xy plane.
struct Rectangle {
    double length = 0, width = 0;  ///< length >= width, um
    double angle_deg = 0;          ///< of the length, from +x, in (-90, 90]

    /// Deformation index (7.1), (length - width)/(length + width).
    [[nodiscard]] double deformation_index() const { return (length - width) / (length + width); }
};

/// The rectangle of least area that bounds the x and y coordinates (section 7.3), by an edge of their convex hull. Of a
/// slender ellipse it has the axes; of a nearly round one its area hardly depends on its angle (by 2 D^2 of it for
/// D = deformation_index()), so that on a coarse mesh it may lie askew and tell too little.
Rectangle minimum_rectangle(const std::vector<Vec3d>& positions);

/// The ellipse with the area moments of a cell's shadow on the xy plane.
struct ShadowEllipse {
    double longest = 0, shortest = 0;  ///< half-axes, um

    /// Deformation index (7.1) of its axes.
    [[nodiscard]] double deformation_index() const { return (longest - shortest) / (longest + shortest); }
};

/// Of the convex hull of the x and y coordinates: half-axes 2 m_i^{1/2} with m_i the principal second moments of its area
/// over the area. InputError as minimum_rectangle().
ShadowEllipse shadow_ellipse(const std::vector<Vec3d>& positions);

/// Measures of a disc about its axis, the shortest principal axis, um.
struct DiscMeasures {
    double diameter = 0;            ///< largest extent in any direction of the disc's plane
    double centre_thickness = 0;    ///< along the axis through the volume centroid
    double greatest_thickness = 0;  ///< along the axis through any vertex
};
DiscMeasures disc_measures(const Triangles& triangles, const std::vector<Vec3d>& positions);

/// Thickness along the disc's axis at a distance from it, um: the mean over `directions` directions, and the
/// least and greatest of them.
struct ThicknessSample {
    double radius = 0, mean = 0, least = 0, greatest = 0;
};

/// Thickness at `samples` evenly spaced radii from the axis to the mean radius of the rim; 0 outside the cell.
std::vector<ThicknessSample> thickness_profile(const Triangles& triangles,
                                               const std::vector<Vec3d>& positions, int samples = 41,
                                               int directions = 24);

}  // namespace hemoflux::membrane
