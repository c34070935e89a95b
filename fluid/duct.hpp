/// Steady flow along a straight duct driven by a body force f per volume: between two plates, or in a rectangle of half
/// widths a <= b across (White, Viscous Fluid Flow, 3-3.3), x_a and x_b counted from the middle:
///
///   u = F/2 (a^2 - x_a^2) - sum_{n odd} 16 F a^2/(pi^3 n^3) (-1)^{(n-1)/2} cosh(n pi x_b/2a)/cosh(n pi b/2a) cos(n pi x_a/2a)
///   mean = F a^2/3 [1 - 192 a/(pi^5 b) sum tanh(n pi b/2a)/n^5],   F = f/(rho nu)
///   rate at the middle of the long walls = F a [1 - 8/pi^2 sum 1/(n^2 cosh(n pi b/2a))]
#pragma once

#include <array>
#include <cstddef>

#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// The exact flow of one duct; any consistent units.
class DuctFlow {
  public:
    /// Along `axis`, between walls on those of the other two axes that are not periodic (one at least), in a box from
    /// lower of these lengths. drive: f/(rho nu), negative for a flow backwards.
    DuctFlow(std::size_t axis, double drive, std::array<double, 3> lower, std::array<double, 3> length,
             std::array<bool, 3> periodic);

    /// The flow in a round pipe of this radius about the line through the origin along `axis`:
    /// u = drive (R^2 - r^2) / 4.
    [[nodiscard]] static DuctFlow round(std::size_t axis, double drive, double radius);

    /// Velocity along the axis at a point.
    [[nodiscard]] double speed(const Vec3d& x) const;
    /// Mean over the cross-section.
    [[nodiscard]] double mean_speed() const { return mean_; }
    /// In the middle.
    [[nodiscard]] double largest_speed() const { return largest_; }
    /// Largest shear rate: at the middle of the long walls, not negative.
    [[nodiscard]] double wall_rate() const { return rate_; }
    /// Axis of the flow, 0 to 2.
    [[nodiscard]] std::size_t axis() const { return axis_; }

  private:
    DuctFlow() = default;

    std::size_t axis_ = 0, across_ = 1, along_ = 2;  ///< of the flow, of the short side, of the long side
    double drive_ = 0, a_ = 0, b_ = 0;               ///< b_ = 0: plates
    bool round_ = false;                             ///< a_ is then the radius
    std::array<double, 3> middle_{};
    double mean_ = 0, largest_ = 0, rate_ = 0;
};

}  // namespace hemoflux::fluid
