/// Density and velocity of a flow at any point, better than second order, on either kind of grid.
#pragma once

#include <array>
#include <memory>

#include "exchange/vec3.hpp"
#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// The fields as they stood when the probe was made.
class Probe {
  public:
    virtual ~Probe() = default;
    /// Density and velocity x, y, z at a point inside the domain.
    [[nodiscard]] virtual std::array<double, 4> operator()(const Vec3d& at) const = 0;

  protected:
    Probe() = default;
    Probe(const Probe&) = default;
    Probe& operator=(const Probe&) = default;
};

class Solver;
class HexSolver;

/// Cubic interpolation between cell centres and the sides with given values (see GridInterpolant).
std::unique_ptr<Probe> make_probe(const Solver& solver);

/// Moving least squares between cell centres and the faces with given values (see HexInterpolant). The solver must
/// outlive the probe.
std::unique_ptr<Probe> make_probe(const HexSolver& solver);

/// The same for a flow of either kind; std::invalid_argument for a kind that has no probe.
std::unique_ptr<Probe> make_probe(const Flow& flow);

}  // namespace hemoflux::fluid
