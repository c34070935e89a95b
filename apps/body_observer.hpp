/// Forces on a body, its wall shear stress, separation and wake.
#pragma once

#include <vector>

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/summary.hpp"
#include "fluid/flow.hpp"
#include "fluid/probe.hpp"

namespace hemoflux::apps {

/// InputError when the patch is not there or the directions are no frame.
void check_body(const BodyInput& body, const fluid::Flow& flow);

/// The point that the body's angles are counted around, um.
Vec3d centre_of(const BodyInput& body, const std::vector<fluid::WallFace>& faces);

/// A body and the units it is measured in.
struct BodyCase {
    const BodyInput& input;
    Scales scales;
    double gamma;   ///< pressure = gamma rho / 3
    double speed;   ///< lattice units
    double length;  ///< um
    Vec3d box_end;  ///< upper corner of the box, um
};

/// Puts drag_coefficient, lift_coefficient (and their parts _pressure and _viscous), separation_angle_deg (from the rear
/// stagnation point), recirculation_length (in lengths, from the rear), pressure_difference (front minus rear, in
/// units of rho U^2) and pressure_difference_pa into the summary, and writes wall.csv: angle_deg, x_um, y_um, z_um,
/// pressure_coefficient and friction_coefficient, both in units of rho U^2 / 2. What the flow does not have (separation,
/// a wake that flows back) is NaN.
void observe_body_flow(const BodyCase& body, const fluid::Flow& flow, const fluid::Probe& probe,
                       output::Summary& summary, const output::OutputFolder& folder);

}  // namespace hemoflux::apps
