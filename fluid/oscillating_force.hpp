/// A body force that is the same everywhere and oscillates in time: f(t) = amplitude cos(omega t + phase)   (3.26)
#pragma once

#include <cmath>

#include "exchange/vec3.hpp"

namespace hemoflux::fluid {

/// Force per volume; omega in radians per unit of time.
struct OscillatingForce {
    Vec3d amplitude{0, 0, 0};
    double omega = 0, phase = 0;

    /// The force at time t.
    [[nodiscard]] Vec3d at(double t) const { return std::cos(omega * t + phase) * amplitude; }
};

}  // namespace hemoflux::fluid
