/// Immersed boundary kernels: weights w_k of the cells k around a marker at X, one axis at a time.
///
///   phi2(r) = 1 - r                                     r <= 1                (5.7)
///   phi3(r) = (1 + sqrt(1 - 3 r^2))/3                   r <= 1/2
///             (5 - 3 r - sqrt(-2 + 6 r - 3 r^2))/6      1/2 <= r <= 3/2       (5.8)
///   phi4(r) = (3 - 2 r + sqrt(1 + 4 r - 4 r^2))/8       r <= 1                (5.9; the thesis prints - sqrt)
///             (5 - 2 r - sqrt(-7 + 12 r - 4 r^2))/8     1 <= r <= 2
///   Lagrange  w_a = prod_{b != a} (X - x_b)/(x_a - x_b) over four cells       (5.18)
///
/// r = |s - k| is a distance in cells, s(X) the cell number continued linearly between the centres. On
/// stretched grids and near walls sum w_k (x_k - X) would not vanish, hence the linear moment correction
///   w_k <- w_k (a + b (x_k - X)),  a = M2/D, b = -M1/D, D = M0 M2 - M1^2, M_p = sum w_k (x_k - X)^p,
/// after which sum w_k = 1 and sum w_k x_k = X to rounding: forces and torques are conserved (5.10, 5.11).
/// Near walls the support is shifted inside: s is held where the whole support lies in the domain (Lagrange
/// and phi2: the window is), which keeps the weights continuous and well conditioned.
#pragma once

#include <cmath>

#include "coupling/axis_view.hpp"

namespace hemoflux::coupling {

/// Which kernel interpolates and spreads.
enum class Kernel { phi2, phi3, phi4, lagrange };

namespace detail {

/// First cell of the window of four whose second cell is k, shifted inside the domain between walls.
HEMOFLUX_INLINE int window(const AxisView& axis, int k) {
    const int f = k - 1;
    if (axis.periodic) return f;
    const int last = axis.n - stencil_width;
    return f < 0 ? 0 : (f < last ? f : last);
}

/// The linear moment correction of the four weights w of the cells from `first` on.
HEMOFLUX_INLINE void correct_moments(const AxisView& axis, double X, int first, double* w) {
    double d[stencil_width], m0 = 0, m1 = 0, m2 = 0;
    for (int a = 0; a < stencil_width; ++a) {
        d[a] = axis.centre[first + a] - X;
        m0 += w[a];
        m1 += w[a] * d[a];
        m2 += w[a] * d[a] * d[a];
    }
    const double inverse = 1 / (m0 * m2 - m1 * m1);
    for (int a = 0; a < stencil_width; ++a) w[a] *= (m2 - m1 * d[a]) * inverse;
}

/// Weights of a smooth kernel: its values at the four cells from first on, moment-corrected. `margin` is how
/// many cells s stays away from the first and last centre between walls: half the support less half a cell.
template <class Phi>
HEMOFLUX_INLINE int smooth_weights(const AxisView& axis, double X, double margin, double* w) {
    int k = axis.below(X);
    double t = (X - axis.centre[k]) / (axis.centre[k + 1] - axis.centre[k]);
    if (!axis.periodic && (k + t < margin || k + t > axis.n - 1 - margin)) {
        const double s = k + t < margin ? margin : axis.n - 1 - margin;
        k = static_cast<int>(s);
        t = s - k;
    }
    const int first = window(axis, k);
    Phi::fill(t + (k - (first + 1)), w);
    correct_moments(axis, X, first, w);
    return first;
}

}  // namespace detail

// Every kernel: value(r) is the function of the literature, operator() writes the four weights of the
// unwrapped cells first .. first + 3 for a marker at X in [axis.lower, axis.upper] and returns first.

/// Support of two cells, (5.7); not moment-corrected, as it is linear interpolation.
struct Phi2 {
    HEMOFLUX_INLINE static double value(double r) { return r < 1 ? 1 - r : 0; }
    HEMOFLUX_INLINE int operator()(const AxisView& axis, double X, double* w) const {
        int k = axis.below(X);
        if (!axis.periodic) k = k < 0 ? 0 : (k < axis.n - 1 ? k : axis.n - 2);
        const int first = detail::window(axis, k);
        const double t = (X - axis.centre[k]) / (axis.centre[k + 1] - axis.centre[k]);
        for (int a = 0; a < stencil_width; ++a) w[a] = first + a == k ? 1 - t : (first + a == k + 1 ? t : 0);
        return first;
    }
};

/// Support of three cells, (5.8).
struct Phi3 {
    HEMOFLUX_INLINE static double value(double r) {
        return r < 0.5 ? (1 + std::sqrt(1 - 3 * r * r)) / 3
                       : (r < 1.5 ? (5 - 3 * r - std::sqrt(-2 + 6 * r - 3 * r * r)) / 6 : 0);
    }
    /// phi3 at the distances 1 + t, t, 1 - t, 2 - t (absolute values), -1/2 <= t <= 3/2, with one square
    /// root.
    HEMOFLUX_INLINE static void fill(double t, double* w) {
        const bool left = t <= 0.5;
        const double r = left ? t : t - 1;
        const double centre = (1 + std::sqrt(1 - 3 * r * r)) / 3;
        const double below = (1 - centre - r) / 2, above = (1 - centre + r) / 2;
        w[0] = left ? below : 0;
        w[1] = left ? centre : below;
        w[2] = left ? above : centre;
        w[3] = left ? 0 : above;
    }
    HEMOFLUX_INLINE int operator()(const AxisView& axis, double X, double* w) const {
        return detail::smooth_weights<Phi3>(axis, X, 0.5, w);
    }
};

/// Support of four cells, (5.9).
struct Phi4 {
    HEMOFLUX_INLINE static double value(double r) {
        return r < 1 ? (3 - 2 * r + std::sqrt(1 + 4 * r - 4 * r * r)) / 8
                     : (r < 2 ? (5 - 2 * r - std::sqrt(-7 + 12 * r - 4 * r * r)) / 8 : 0);
    }
    /// phi4 at the distances 1 + t, t, 1 - t, 2 - t, 0 <= t <= 1: all four share one square root.
    HEMOFLUX_INLINE static void fill(double t, double* w) {
        const double q = std::sqrt(1 + 4 * t - 4 * t * t);
        w[0] = (3 - 2 * t - q) / 8;
        w[1] = (3 - 2 * t + q) / 8;
        w[2] = (1 + 2 * t + q) / 8;
        w[3] = (1 + 2 * t - q) / 8;
    }
    HEMOFLUX_INLINE int operator()(const AxisView& axis, double X, double* w) const {
        return detail::smooth_weights<Phi4>(axis, X, 1, w);
    }
};

/// Cubic interpolation between four cells, (5.18).
struct Lagrange {
    HEMOFLUX_INLINE int operator()(const AxisView& axis, double X, double* w) const {
        const int first = detail::window(axis, axis.below(X));
        const double* x = axis.centre + first;
        const double* inverse = axis.lagrange + stencil_width * (first + axis_ghosts);
        const double d0 = X - x[0], d1 = X - x[1], d2 = X - x[2], d3 = X - x[3];
        w[0] = d1 * d2 * d3 * inverse[0];
        w[1] = d0 * d2 * d3 * inverse[1];
        w[2] = d0 * d1 * d3 * inverse[2];
        w[3] = d0 * d1 * d2 * inverse[3];
        return first;
    }
};

}  // namespace hemoflux::coupling
