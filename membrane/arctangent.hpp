/// atan2 for packs and plain doubles, to 4e-16 of pi: the standard one is scalar and dominates the forces.
///
/// With t = min(|x|,|y|) / max(|x|,|y|) in [0, 1]:
///   t <= tan(pi/8):  atan t = P(t);   else atan t = pi/4 + P((t - 1)/(t + 1)),   so |argument| <= tan(pi/8),
///   P(z) = z + z u g(u),  u = z^2,  g the degree-10 interpolant of (atan(z)/z - 1)/u at the Chebyshev points
/// of 0 <= u <= tan^2(pi/8); its error is 5e-18 of z, below rounding. Both cases share one division.
#pragma once

#include "exchange/pack.hpp"

namespace hemoflux::membrane {

/// Signed angle of the point (x, y) from the +x axis, in [-pi, pi]; 0 at the origin, where the standard one
/// may give pi. The sign of y = -0 is not kept. Not for NaN or infinity.
template <class Value>
HEMOFLUX_INLINE Value arctangent(const Value& y, const Value& x) {
    using exchange::absolute, exchange::maximum, exchange::minimum, exchange::select;
    constexpr double pi = 3.14159265358979323846, tan_eighth = 0.41421356237309504880;
    const Value ax = absolute(x), ay = absolute(y);
    const Value low = minimum(ax, ay), high = maximum(ax, ay);
    const auto steep = low > tan_eighth * high;
    const Value numerator = select(steep, low - high, low);
    const Value denominator = select(steep, low + high, high);
    const Value z = numerator / select(denominator > 0.0, denominator, Value(1.0));
    const Value u = z * z, u2 = u * u, u4 = u2 * u2;
    const Value a = -0.3333333333333333 + 0.1999999999999552 * u;
    const Value b = -0.14285714284666542 + 0.11111111015256361 * u;
    const Value c = -0.09090904578123903 + 0.07692183190826087 * u;
    const Value d = -0.06664511447381948 + 0.0585814891280221 * u;
    const Value e = -0.0508544973794026 + 0.03923165829558719 * u - 0.019176887119062257 * u2;
    const Value g = (a + b * u2) + ((c + d * u2) + e * u4) * u4;
    Value angle = select(steep, Value(0.25 * pi), Value(0.0)) + (z + z * (u * g));
    angle = select(ay > ax, 0.5 * pi - angle, angle);
    angle = select(x < 0.0, pi - angle, angle);
    angle = select(y < 0.0, -angle, angle);
    return angle;
}

}  // namespace hemoflux::membrane
