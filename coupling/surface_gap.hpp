/// Signed distance from a point to a closed triangulated surface near one of its vertices.
///
/// The nearest point of the triangles around the vertex, and the side of the surface by the pseudonormal there: the
/// triangle's normal inside it, the sum of both normals on an edge, the sum weighted by the angles at a corner
/// (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 243, 2005).
#pragma once

#include <cmath>

#include "exchange/macros.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Nearest point of triangle a, b, c to p (Ericson, Real-Time Collision Detection, 5.1.5).
HEMOFLUX_INLINE Vec3d nearest_point(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vec3d bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + (d1 / (d1 - d3)) * ab;
    const Vec3d cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + (d2 / (d2 - d6)) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    const double sum = va + vb + vc;
    return a + (vb / sum) * ab + (vc / sum) * ac;
}

/// Takes the triangles around a vertex one by one, the vertex first in each, and knows the signed distance to them:
/// positive outside.
class RingDistance {
  public:
    /// From p to the triangles around a vertex.
    HEMOFLUX_INLINE explicit RingDistance(const Vec3d& p) : p_(p) {}

    /// Takes triangle a, b, c; a is the vertex.
    HEMOFLUX_INLINE void add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        const Vec3d ab = b - a, ac = c - a;
        Vec3d n = cross(ab, ac);
        const double size = norm(n);
        n = (1 / size) * n;
        const Vec3d from = p_ - nearest_point(p_, a, b, c);
        const double d2 = dot(from, from);
        // two triangles meet in the nearest point: its pseudonormal is made of both
        const double tie = 1e-12 * (dot(ab, ab) + dot(p_ - a, p_ - a));
        if (d2 < d2_ - tie) side_ = 0;
        if (d2 < d2_ + tie) {
            const double angle = std::atan2(size, dot(ab, ac));
            const double corner = dot(p_ - a, p_ - a) <= d2 + tie ? angle : 1;
            side_ += corner * dot(from, n);
        }
        if (d2 < d2_) d2_ = d2;
    }

    /// Infinite before the first triangle.
    [[nodiscard]] HEMOFLUX_INLINE double value() const {
        const double d = std::sqrt(d2_);
        return side_ < 0 ? -d : d;
    }

  private:
    Vec3d p_;
    double d2_ = 1e300, side_ = 0;
};

}  // namespace hemoflux::coupling
