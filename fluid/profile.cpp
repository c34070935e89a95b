#include "fluid/profile.hpp"

#include <algorithm>
#include <cmath>

namespace hemoflux::fluid {

Profile sample(const Probe& probe, const Vec3d& from, const Vec3d& to, int points) {
    Profile profile;
    for (int i = 0; i < points; ++i) {
        const double s = static_cast<double>(i) / (points - 1);
        profile.at.push_back((1 - s) * from + s * to);
        profile.values.push_back(probe(profile.at.back()));
    }
    return profile;
}

Extremum minimum(const std::function<double(double)>& f, double low, double high, int samples) {
    const double step = (high - low) / (samples - 1);
    Extremum best{low, f(low)};
    for (int i = 1; i < samples; ++i) {
        const double x = low + i * step, value = f(x);
        if (value < best.value) best = {x, value};
    }
    const double ratio = (std::sqrt(5.0) - 1) / 2;
    double a = std::max(low, best.at - step), b = std::min(high, best.at + step);
    double c = b - ratio * (b - a), d = a + ratio * (b - a), fc = f(c), fd = f(d);
    // a minimum is flat: closer than the root of the rounding error its place is not defined
    while (b - a > 1e-9 * std::max(std::abs(low), std::abs(high))) {
        if (fc < fd)
            b = d, d = c, fd = fc, c = b - ratio * (b - a), fc = f(c);
        else
            a = c, c = d, fc = fd, d = a + ratio * (b - a), fd = f(d);
    }
    const double middle = (a + b) / 2, value = f(middle);
    return value < best.value ? Extremum{middle, value} : best;
}

std::optional<double> first_rise_through_zero(const std::function<double(double)>& f, double low, double high,
                                              int samples) {
    double a = low, fa = f(low);
    for (int i = 1; i < samples; ++i) {
        double b = low + (high - low) * i / (samples - 1);
        const double fb = f(b);
        if (fa < 0 && fb >= 0) {
            for (int bisection = 0; bisection < 60; ++bisection) {
                const double middle = (a + b) / 2;
                (f(middle) < 0 ? a : b) = middle;
            }
            return b;
        }
        a = b, fa = fb;
    }
    return std::nullopt;
}

}  // namespace hemoflux::fluid
