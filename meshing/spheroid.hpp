/// Ellipsoids and spheroids as affine maps of a sphere mesh.
///
///   spheroid of semi-axes a, a, c:  V = 4/3 pi a^2 c
///   oblate,  e^2 = 1 - c^2/a^2:     A = 2 pi a^2 (1 + (1 - e^2)/e artanh e)
///   prolate, e^2 = 1 - a^2/c^2:     A = 2 pi a^2 (1 + c/(a e) arcsin e)
#pragma once

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Semi-axes of a spheroid, um: equatorial (x and y) and polar (z).
struct SpheroidAxes {
    double equatorial = 1, polar = 1;
};

/// Area of the spheroid, um^2.
double area(const SpheroidAxes& axes);

/// Volume of the spheroid, um^3.
double volume(const SpheroidAxes& axes);

/// Volume over that of the sphere of equal area.
double reduced_volume(const SpheroidAxes& axes);

/// The oblate spheroid of this area (um^2) and reduced volume. InputError unless area > 0 and
/// 0.05 <= reduced volume <= 1.
SpheroidAxes oblate_axes(double area, double reduced_volume);

/// Maps a sphere mesh around the origin onto the ellipsoid of semi-axes a, b, c along x, y, z (um).
/// InputError unless all are positive.
SurfaceMesh spheroid(const SurfaceMesh& sphere, double a, double b, double c);

/// Maps a sphere mesh around the origin onto the spheroid.
SurfaceMesh spheroid(const SurfaceMesh& sphere, const SpheroidAxes& axes);

}  // namespace hemoflux::meshing
