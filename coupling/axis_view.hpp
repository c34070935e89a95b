/// One axis of the fluid grid as the coupling kernels see it: centres, widths and a cell look-up of constant
/// cost.
///
/// Cells are counted 0 .. n-1 inside the domain. On a periodic axis they may be counted on ("unwrapped"):
/// cell k + n is cell k moved by the length of the axis, so that weights never see the seam.
#pragma once

#include <cmath>
#include <cstddef>

#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"
#include "exchange/pack.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::coupling {

/// Cells per axis in every stencil; kernels with a smaller support leave the rest at weight zero.
inline constexpr int stencil_width = 4;
/// Cells known on each side beyond the domain: what a stencil can reach on a periodic axis.
inline constexpr int axis_ghosts = 2;

/// Trivially copyable window on one axis in device memory; lengths in um.
struct AxisView {
    /// Number of cells.
    int n = 0;
    bool periodic = false;
    /// First face, last face and their distance, um.
    double lower = 0, upper = 0, length = 0;
    /// Centre and width of cells -axis_ghosts .. n - 1 + axis_ghosts, um: the periodic
    /// continuation, or mirrored cells beyond a wall. A pack may be read past the last.
    const double *centre = nullptr, *width = nullptr;
    /// 1/width of cells 0 .. n-1, 1/um.
    const double* inverse_width = nullptr;
    /// 1 / prod_{b != a} (x_a - x_b) over the window of four cells that starts at cell f, at
    /// [4 (f + axis_ghosts) + a], f = -axis_ghosts .. n - 2: the denominators of (5.18).
    const double* lagrange = nullptr;
    /// Look-up: bin t of equal bins, the first starting at lower, begins right of centre bin[t].
    const int* bin = nullptr;
    int bins = 0;
    double bins_per_length = 0;

    /// Whether X lies in the domain; on a periodic axis everything within a million lengths does. NaN does
    /// not.
    HEMOFLUX_INLINE bool contains(double X) const {
        return periodic ? std::fabs(X - lower) < 1e6 * length : X >= lower && X <= upper;
    }
    /// X moved by whole lengths into [lower, upper), and that number of lengths: X = result + turns * length.
    HEMOFLUX_INLINE double wrap(double X, int* turns) const {
        *turns = 0;
        if (!periodic || (X >= lower && X < upper)) return X;
        const double t = std::floor((X - lower) / length);
        *turns = static_cast<int>(t);
        const double Y = X - t * length;
        if (Y < upper) return Y < lower ? lower : Y;
        ++*turns;
        return lower;
    }
    /// Greatest k with centre[k] <= X, for X in [lower, upper]: -1 .. n-1.
    HEMOFLUX_INLINE int below(double X) const {
        const double at = (X - lower) * bins_per_length;
        const int t = at > 0 ? (at < bins ? static_cast<int>(at) : bins - 1) : 0;
        int k = bin[t];
        while (k < n - 1 && centre[k + 1] <= X) ++k;
        while (k >= 0 && centre[k] > X) --k;
        return k;
    }
    /// Greatest unwrapped k with centre <= X for any X; -1 and n-1 bound it between walls. -1 for NaN.
    HEMOFLUX_INLINE int below_unwrapped(double X) const {
        if (!(std::fabs(X - lower) < 2e6 * length)) return -1;
        int turns;
        const double Y = wrap(X, &turns);
        return (Y < lower ? -1 : Y > upper ? n - 1 : below(Y)) + turns * n;
    }
    /// The cell 0 .. n-1 that unwrapped cell k of a periodic axis is; k itself between walls.
    HEMOFLUX_INLINE int cell(int k) const {
        if (k >= 0 && k < n) return k;
        const int r = k % n;
        return r < 0 ? r + n : r;
    }
    /// Number of lengths between unwrapped cell k and cell(k).
    HEMOFLUX_INLINE int turns(int k) const { return (k - cell(k)) / n; }
    /// Width at X, linear between the centres, um; beyond a wall that at the wall.
    HEMOFLUX_INLINE double width_at(double X) const {
        int t;
        const double Y = contains(X) ? wrap(X, &t) : (X > upper ? upper : lower);
        const int k = below(Y);
        const double s = (Y - centre[k]) / (centre[k + 1] - centre[k]);
        return width[k] + s * (width[k + 1] - width[k]);
    }
};

/// Owns the arrays of an AxisView on the device.
class AxisData {
  public:
    /// InputError when an axis between walls has fewer than stencil_width cells: its stencils could not stay
    /// inside.
    AxisData(const meshing::Axis& axis, bool periodic, const char* name);
    /// Valid as long as this object lives, also after it was moved.
    [[nodiscard]] AxisView view() const;

  private:
    AxisView shape_;
    exchange::Buffer<double> centre_, width_, inverse_width_, lagrange_;
    exchange::Buffer<int> bin_;
};

}  // namespace hemoflux::coupling
