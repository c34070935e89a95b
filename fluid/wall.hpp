/// What a flow does to a body: force coefficients (4.22, 4.23), wall shear stress, separation.
#pragma once

#include <optional>
#include <vector>

#include "exchange/vec3.hpp"
#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// Force of the fluid on a patch in lattice units (length^2 c^2), with its two parts.
struct WallForce {
    Vec3d pressure{0, 0, 0}, viscous{0, 0, 0};
    /// Pressure and viscous part together.
    [[nodiscard]] Vec3d total() const { return pressure + viscous; }
};

/// Sum over the faces.
WallForce total_force(const std::vector<WallFace>& faces);

/// How a body lies in a stream: the point its angles are counted around, and the unit vectors of the stream and of the
/// lift, normal to each other.
struct BodyFrame {
    Vec3d centre, stream, lift;
};

/// Force over dynamic pressure times area, F / (rho U^2 A / 2), rho = 1: (4.22).
double force_coefficient(const Vec3d& force, const Vec3d& direction, double speed, double area);

/// The wall at one place. angle: from the rear stagnation point, degrees, -180 to 180, positive on the lift's side.
/// shear: viscous stress along the wall, positive where the fluid drags the wall from front to rear.
struct WallPoint {
    Vec3d centre;
    double angle_deg, pressure, shear;
};

/// Faces as points by ascending angle; faces of one angle (a body several cells deep) become one point, their mean by
/// area.
std::vector<WallPoint> wall_points(const std::vector<WallFace>& faces, const BodyFrame& frame);

/// Angle of separation from the rear stagnation point, degrees: the mean, over the two halves of the body, of the zero
/// of the shear nearest to the rear, linear between points. Empty where the flow does not separate.
std::optional<double> separation_angle_deg(const std::vector<WallPoint>& points);

}  // namespace hemoflux::fluid
