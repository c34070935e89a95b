/// One triangle of a membrane and what it tells the rows of cells near it: their distance to it, and where a
/// row crosses it.
///
/// Distance: the foot of p in the plane of (a, b, c) is inside the triangle, and the distance is |n . (p -
/// a)|, where its barycentric coordinates are all positive; else the least of the distances to the three
/// edges, |p - a - t (b - a)| with t = ab . ap / ab . ab limited to [0, 1]. All terms are linear or quadratic
/// in x, so a row computes its part once and the cells of a row go through SIMD packs.
///
/// Inside or outside: the winding number of the surface along the row. Vertices and rows are rounded to a
/// lattice in y and z on which the edge functions are exact in double precision, and ties are broken by an
/// infinitesimal shift of the row, the same for all triangles (Edelsbrunner and Muecke, ACM Trans. Graph. 9,
/// 1990). Neighbouring triangles therefore never disagree, and every row leaves a closed surface as often as
/// it enters it.
#pragma once

#include <cmath>

#include "coupling/cell_grid.hpp"
#include "exchange/macros.hpp"
#include "exchange/pack.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Unwrapped cells first[q] .. last[q] - 1 on each axis; empty when last <= first.
struct CellBox {
    int first[3];
    int last[3];
};

/// Lattice units of the inside test per um, a power of two: 65536 or more per smallest cell. Fine enough not to
/// matter (1e-5 of a cell), and coarse enough that edge functions of triangles up to 1000 cells wide fit the
/// 53 bits of a double.
inline double inside_test_lattice(double smallest_cell) {
    return std::exp2(std::ceil(std::log2(65536 / smallest_cell)));
}

/// A triangle (a, b, c) prepared for many distance evaluations; lengths in um.
struct BandTriangle {
    Vec3d a, ab, ac;
    /// Unit normal, outward.
    Vec3d n;
    /// ab.ab, ac.ac, bc.bc, ab.ac and the reciprocals of the first three.
    double ab2, ac2, bc2, abac, inverse_ab2, inverse_ac2, inverse_bc2;
    /// Half-width of the band and 1/half_width^2.
    double half_width, inverse_half2;
    /// Corners rounded to the lattice of the inside test, their bounds, and the half-width, in its units.
    double y[3], z[3], y_low, y_high, z_low, z_high, reach;
    /// x of the corners, um.
    double x[3];
};

/// Corners of the triangle and half-width of its band -> BandTriangle; `lattice` is the number of lattice
/// units per um.
HEMOFLUX_INLINE BandTriangle band_triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, double half_width,
                                           double lattice) {
    BandTriangle t;
    t.a = a, t.ab = b - a, t.ac = c - a;
    const Vec3d bc = c - b, area = cross(t.ab, t.ac);
    t.n = (1 / norm(area)) * area;
    t.ab2 = dot(t.ab, t.ab), t.ac2 = dot(t.ac, t.ac), t.bc2 = dot(bc, bc), t.abac = dot(t.ab, t.ac);
    t.inverse_ab2 = 1 / t.ab2, t.inverse_ac2 = 1 / t.ac2, t.inverse_bc2 = 1 / t.bc2;
    t.half_width = half_width;
    t.inverse_half2 = 1 / (half_width * half_width);
    const Vec3d corner[3] = {a, b, c};
    for (int v = 0; v < 3; ++v) {
        t.x[v] = corner[v].x;
        t.y[v] = std::floor(corner[v].y * lattice + 0.5);
        t.z[v] = std::floor(corner[v].z * lattice + 0.5);
    }
    using exchange::maximum;
    using exchange::minimum;
    t.y_low = minimum(t.y[0], minimum(t.y[1], t.y[2])), t.y_high = maximum(t.y[0], maximum(t.y[1], t.y[2]));
    t.z_low = minimum(t.z[0], minimum(t.z[1], t.z[2])), t.z_high = maximum(t.z[0], maximum(t.z[1], t.z[2]));
    t.reach = half_width * lattice + 1;
    return t;
}

/// Unwrapped cells whose centres may lie within the band of the triangle (a, b, c).
HEMOFLUX_INLINE CellBox band_box(const CellGridView& grid, const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                 double half_width) {
    using exchange::maximum;
    using exchange::minimum;
    const double low[3] = {minimum(a.x, minimum(b.x, c.x)), minimum(a.y, minimum(b.y, c.y)),
                           minimum(a.z, minimum(b.z, c.z))};
    const double high[3] = {maximum(a.x, maximum(b.x, c.x)), maximum(a.y, maximum(b.y, c.y)),
                            maximum(a.z, maximum(b.z, c.z))};
    CellBox box;
    for (int q = 0; q < 3; ++q) {
        box.first[q] = 1 + grid.axis[q].below_unwrapped(low[q] - half_width);
        box.last[q] = 1 + grid.axis[q].below_unwrapped(high[q] + half_width);
    }
    return box;
}

/// The part of the distance that a row of cells at (y, z) shares.
struct RowTerms {
    double yz2, d1, d2, s;

    /// Of the row of cells at (y, z), um.
    HEMOFLUX_INLINE RowTerms(const BandTriangle& t, double y, double z) {
        const double dy = y - t.a.y, dz = z - t.a.z;
        yz2 = dy * dy + dz * dz;
        d1 = t.ab.y * dy + t.ab.z * dz;
        d2 = t.ac.y * dy + t.ac.z * dz;
        s = t.n.y * dy + t.n.z * dz;
    }
    /// Whether all cells between x0 and x1 are further than the half-width from the plane of the triangle.
    HEMOFLUX_INLINE bool far(const BandTriangle& t, double x0, double x1) const {
        const double s0 = s + t.n.x * (x0 - t.a.x), s1 = s + t.n.x * (x1 - t.a.x);
        return (s0 > t.half_width && s1 > t.half_width) || (s0 < -t.half_width && s1 < -t.half_width);
    }
};

/// Squared distance of the cells at x of a row to the triangle, um^2.
template <class Value>
HEMOFLUX_INLINE Value squared_distance(const BandTriangle& t, const RowTerms& row, const Value& x) {
    using exchange::maximum;
    using exchange::minimum;
    using exchange::select;
    const Value zero = 0.0, one = 1.0;
    const Value q = x - Value(t.a.x);
    const Value ap2 = q * q + row.yz2;
    const Value d1 = q * t.ab.x + row.d1, d2 = q * t.ac.x + row.d2;
    const Value plane = q * t.n.x + row.s;
    const Value d3 = d2 - d1 - (t.abac - t.ab2);
    const Value t1 = maximum(zero, minimum(one, Value(d1 * t.inverse_ab2)));
    const Value t2 = maximum(zero, minimum(one, Value(d2 * t.inverse_ac2)));
    const Value t3 = maximum(zero, minimum(one, Value(d3 * t.inverse_bc2)));
    const Value e1 = ap2 + t1 * (t1 * t.ab2 - 2.0 * d1);
    const Value e2 = ap2 + t2 * (t2 * t.ac2 - 2.0 * d2);
    const Value e3 = ap2 - 2.0 * d1 + t.ab2 + t3 * (t3 * t.bc2 - 2.0 * d3);
    const Value edges = maximum(zero, minimum(e1, minimum(e2, e3)));
    const Value v = d1 * t.ac2 - d2 * t.abac, w = d2 * t.ab2 - d1 * t.abac;
    const Value u = (t.ab2 * t.ac2 - t.abac * t.abac) - v - w;
    return select(minimum(u, minimum(v, w)) >= zero, Value(plane * plane), edges);
}

/// Squared distance in the yz plane, lattice units, of a row to the rectangle around the triangle; zero
/// within it.
HEMOFLUX_INLINE double rectangle_distance2(const BandTriangle& t, double y, double z) {
    using exchange::maximum;
    const double dy = maximum(0.0, maximum(t.y_low - y, y - t.y_high));
    const double dz = maximum(0.0, maximum(t.z_low - z, z - t.z_high));
    return dy * dy + dz * dz;
}

/// Sign of the edge function of p seen from p0 -> p1 in the yz plane, with ties broken by moving p by an
/// infinitesimal step in y and a smaller one in z; zero only for an edge of no length.
HEMOFLUX_INLINE double edge_side(double e, double dy, double dz) { return e != 0 ? e : (dz != 0 ? -dz : dy); }

/// Whether the row at (y, z), in lattice units, crosses the triangle: +1 where it enters the cell in the
/// direction of x, -1 where it leaves it, 0 if it passes by. `x` becomes the place of the crossing, um.
HEMOFLUX_INLINE int row_crossing(const BandTriangle& t, double y, double z, double* x) {
    double e[3], side[3];
    for (int v = 0; v < 3; ++v) {
        const int p = v == 2 ? 0 : v + 1, q = p == 2 ? 0 : p + 1;
        const double dy = t.y[q] - t.y[p], dz = t.z[q] - t.z[p];
        e[v] = dy * (z - t.z[p]) - dz * (y - t.y[p]);
        side[v] = edge_side(e[v], dy, dz);
    }
    const bool positive = side[0] > 0 && side[1] > 0 && side[2] > 0;
    const bool negative = side[0] < 0 && side[1] < 0 && side[2] < 0;
    if (!positive && !negative) return 0;
    *x = (e[0] * t.x[0] + e[1] * t.x[1] + e[2] * t.x[2]) / (e[0] + e[1] + e[2]);
    return positive ? -1 : 1;
}

}  // namespace hemoflux::coupling
