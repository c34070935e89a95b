#include "apps/extrapolation.hpp"

#include <cmath>
#include <limits>
#include <set>

namespace hemoflux::apps {
namespace {

constexpr double lowest_order = 0.25, highest_order = 8;

struct Fit {
    double limit, misfit;
};

/// The line y = limit + a x^order for a fixed order, with its sum of squared distances.
Fit fit(const std::vector<double>& x, const std::vector<double>& y, double order) {
    const auto n = static_cast<double>(x.size());
    double sz = 0, sy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sz += std::pow(x[i], order), sy += y[i];
    double szz = 0, szy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double z = std::pow(x[i], order) - sz / n;
        szz += z * z, szy += z * (y[i] - sy / n);
    }
    const double slope = szy / szz, limit = (sy - slope * sz) / n;
    double misfit = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double rest = y[i] - limit - slope * std::pow(x[i], order);
        misfit += rest * rest;
    }
    return {limit, misfit};
}

}  // namespace

Extrapolation extrapolate(const std::vector<double>& all_x, const std::vector<double>& all_y) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> x, y;
    for (std::size_t i = 0; i < all_x.size(); ++i)
        if (all_x[i] > 0 && std::isfinite(all_x[i]) && std::isfinite(all_y[i]))
            x.push_back(all_x[i]), y.push_back(all_y[i]);
    if (std::set<double>(x.begin(), x.end()).size() < 3) return {nan, nan};
    // The misfit may have several minima in the order: a scan finds the basin, bisection of its thirds the bottom.
    constexpr int scan = 400;
    const auto order_at = [](int i) { return lowest_order + (highest_order - lowest_order) * i / scan; };
    int best = 0;
    for (int i = 1; i <= scan; ++i)
        if (fit(x, y, order_at(i)).misfit < fit(x, y, order_at(best)).misfit) best = i;
    if (best == 0 || best == scan) return {nan, nan};
    double low = order_at(best - 1), high = order_at(best + 1);
    for (int i = 0; i < 100; ++i) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (fit(x, y, a).misfit < fit(x, y, b).misfit)
            high = b;
        else
            low = a;
    }
    const double order = (low + high) / 2;
    return {fit(x, y, order).limit, order};
}

}  // namespace hemoflux::apps
