/// Forces between membranes, as a pressure Pi(d) between flat surfaces at distance d:
///
///   repulsion     Pi(d) = P (1 - d/d_0)^2                           for d < d_0
///   aggregation   Pi(d) = -dW/dd,  W = D [e^{2 beta (d_1 - d)} - 2 e^{beta (d_1 - d)}]      (Morse, for d < d_c)
///
/// with D the adhesion energy per area at the distance d_1 of no force (Neu and Meiselman, Biophys. J. 83, 2482, 2002;
/// Liu and Liu, J. Comput. Phys. 220, 139, 2006). Between two nodes that stand for areas A_i and A_j acts the potential
///
///   E_ij = A_i A_j w(r),   w(r) = Pi(r) / (2 pi r),
///
/// because the sum over a plane at distance d, int_d^inf w(r) 2 pi r dr, is then int_d^inf Pi = W(d): the moduli do not
/// depend on the mesh as long as its edges are shorter than the reach. From d_1 + 2/beta on the Morse pressure is led to
/// zero, by 1 - 3 s^2 + 2 s^3, which it reaches with its slope at the cut-off d_c = d_1 + 4/beta. A node and a flat wall
/// meet with A_i Pi(d), repulsion only.
/// Units: um, pressure 10 Pa, energy 1e-17 J.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"

namespace hemoflux::coupling {

/// Parameters of the forces between membranes; zero moduli switch a part off.
struct ContactOptions {
    double pressure = 1;             ///< P, 10 Pa
    double range = 0.5;              ///< d_0, um
    double adhesion = 0;             ///< D, 1e-5 J/m^2
    double adhesion_distance = 0.5;  ///< d_1, um
    double adhesion_scale = 4;       ///< beta, 1/um
    bool walls = true;               ///< repulsion from sides of the box that are not periodic

    /// Where the aggregation ends, um.
    [[nodiscard]] double cut_off() const { return adhesion > 0 ? adhesion_distance + 4 / adhesion_scale : 0; }
    /// Where all forces end, um.
    [[nodiscard]] double reach() const { return range > cut_off() ? range : cut_off(); }
    /// Throws InputError unless moduli are finite and not negative, and lengths positive.
    void check() const;
};

/// The potential and its slope over r: what a pair needs.
struct ContactPair {
    double energy;  ///< w
    double force;   ///< -w'/r: times the vector between the nodes, the force that parts them
};

/// The law as kernels see it.
class ContactLaw {
  public:
    /// The parameters are taken as they are; ContactOptions::check() is the caller's.
    explicit ContactLaw(const ContactOptions& o)
        : pressure_(o.pressure),
          range_(o.range),
          adhesion_(o.adhesion),
          distance_(o.adhesion_distance),
          scale_(o.adhesion_scale),
          cut_off_(o.cut_off()),
          reach_(o.reach()) {}

    /// Where all forces end, um.
    [[nodiscard]] HEMOFLUX_INLINE double reach() const { return reach_; }

    /// Pair at distance r, 0 < r < reach().
    HEMOFLUX_INLINE ContactPair pair(double r) const {
        ContactPair p{0, 0};
        if (r < range_) {
            const Slope w = per_area(repulsion(r), r);
            p = {w.value, -w.slope / r};
        }
        if (r < cut_off_) {
            const Slope w = per_area(morse(r), r);
            p.energy += w.value;
            p.force -= w.slope / r;
        }
        return p;
    }

    /// Repulsive pressure at distance d from a wall, 10 Pa, and its energy per area; beyond the wall it grows on.
    HEMOFLUX_INLINE double wall_pressure(double d) const { return d < range_ ? repulsion(d).value : 0; }
    HEMOFLUX_INLINE double wall_energy(double d) const {
        if (!(d < range_)) return 0;
        const double s = 1 - d / range_;
        return pressure_ * range_ / 3 * s * s * s;
    }

    /// Pi of both parts between flat surfaces.
    HEMOFLUX_INLINE double pressure(double d) const {
        return (d < range_ ? repulsion(d).value : 0) + (d < cut_off_ ? morse(d).value : 0);
    }

  private:
    struct Slope {
        double value, slope;
    };
    HEMOFLUX_INLINE Slope repulsion(double d) const {
        const double s = 1 - d / range_;
        return {pressure_ * s * s, -2 * pressure_ * s / range_};
    }
    HEMOFLUX_INLINE Slope morse(double d) const {
        const double e = std::exp(scale_ * (distance_ - d));
        const Slope p{2 * adhesion_ * scale_ * e * (e - 1),
                      -2 * adhesion_ * scale_ * scale_ * e * (2 * e - 1)};
        const double s = 0.5 * scale_ * (d - distance_) - 1;
        if (s <= 0) return p;
        const double fade = 1 - s * s * (3 - 2 * s);
        return {p.value * fade, p.slope * fade - 3 * scale_ * s * (1 - s) * p.value};
    }
    /// w = Pi/(2 pi r) and w'.
    HEMOFLUX_INLINE static Slope per_area(const Slope& p, double r) {
        constexpr double two_pi = 6.28318530717958648;
        return {p.value / (two_pi * r), (p.slope - p.value / r) / (two_pi * r)};
    }

    double pressure_, range_, adhesion_, distance_, scale_, cut_off_, reach_;
};

}  // namespace hemoflux::coupling
