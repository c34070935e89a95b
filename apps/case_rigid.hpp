/// [[body]] of a case: rigid bodies in the fluid.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "apps/toml_input.hpp"

namespace hemoflux::apps {

/// body.shape, of a body without a file.
enum class RigidShape { sphere, spheroid, cylinder };
/// body.motion, see coupling::BodyFreedom.
enum class RigidMotion { prescribed, torque_free, free };
/// body.method, see coupling::BodyForcing.
enum class RigidMethod { direct, feedback };

/// One [[body]]; lengths um, velocities um/s, see the schema for the meaning.
struct RigidInput {
    std::string name;
    RigidShape shape = RigidShape::sphere;
    std::string file;
    double diameter = 0, aspect = 1, length = 0;
    std::optional<double> nodes;
    std::array<double, 3> position{}, axis{0, 0, 1};
    RigidMotion motion = RigidMotion::prescribed;
    std::array<double, 3> velocity{}, angular_velocity{};
    std::optional<double> density;            ///< kg/m^3; empty: the fluid's
    std::array<double, 3> force{}, torque{};  ///< N, N m
    RigidMethod method = RigidMethod::direct;
    std::optional<double> stiffness;  ///< Pa/m
    int iterations = 4;
    std::optional<double> retraction;  ///< cells; empty: the kernel's
    std::optional<double> speed, reference_area;
    std::array<double, 3> drag_direction{1, 0, 0}, lift_direction{0, 1, 0};
    bool operator==(const RigidInput&) const = default;
};

/// One [[body]] from a resolved table; directions are made unit vectors.
RigidInput read_rigid(const Section& in);

/// The keys of [[body]] against each other and the rest of the case. Throws InputError.
void check_rigid_rules(const Section& top, const std::string& name);

}  // namespace hemoflux::apps
