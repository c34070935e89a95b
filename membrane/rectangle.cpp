#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::membrane {
namespace {

using Point = std::array<double, 2>;

/// Twice the signed area of triangle a, b, c.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Convex hull, counter-clockwise, by Andrew's monotone chain.
std::vector<Point> convex_hull(std::vector<Point> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<Point> hull;
    const auto half = [&](auto begin, auto end) {
        const std::size_t first = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();  // it begins the other half
    };
    half(points.begin(), points.end());
    half(points.rbegin(), points.rend());
    return hull;
}

std::vector<Point> hull_of_shadow(const std::vector<Vec3d>& positions) {
    std::vector<Point> points;
    for (const Vec3d& p : positions) points.push_back({p.x, p.y});
    std::vector<Point> hull = convex_hull(points);
    if (hull.size() < 3)
        throw InputError("a cell whose shadow on the xy plane has no area",
                         "neither rectangle nor ellipse fits it", "Give a closed surface");
    return hull;
}

}  // namespace

ShadowEllipse shadow_ellipse(const std::vector<Vec3d>& positions) {
    const std::vector<Point> hull = hull_of_shadow(positions);
    const Point origin = hull.front();
    double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
        const double ax = hull[i][0] - origin[0], ay = hull[i][1] - origin[1];
        const double bx = hull[i + 1][0] - origin[0], by = hull[i + 1][1] - origin[1];
        const double part = 0.5 * (ax * by - ay * bx);  // of the triangle origin, a, b
        area += part;
        x += part * (ax + bx) / 3;
        y += part * (ay + by) / 3;
        xx += part * (ax * ax + ax * bx + bx * bx) / 6;
        yy += part * (ay * ay + ay * by + by * by) / 6;
        xy += part * (2 * (ax * ay + bx * by) + ax * by + bx * ay) / 12;
    }
    x /= area;
    y /= area;
    xx = xx / area - x * x;
    yy = yy / area - y * y;
    xy = xy / area - x * y;
    const double middle = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
    return {.longest = 2 * std::sqrt(middle + half), .shortest = 2 * std::sqrt(middle - half)};
}

Rectangle minimum_rectangle(const std::vector<Vec3d>& positions) {
    const std::vector<Point> hull = hull_of_shadow(positions);
    Rectangle best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point &a = hull[i], &b = hull[(i + 1) % hull.size()];
        const double size = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double x = (b[0] - a[0]) / size, y = (b[1] - a[1]) / size;
        double low = 0, high = 0, height = 0;
        for (const Point& p : hull) {
            const double along = (p[0] - a[0]) * x + (p[1] - a[1]) * y;
            low = std::min(low, along);
            high = std::max(high, along);
            height = std::max(height, (p[1] - a[1]) * x - (p[0] - a[0]) * y);
        }
        if (!((high - low) * height < least)) continue;
        least = (high - low) * height;
        const bool lies = high - low >= height;
        best = {.length = lies ? high - low : height, .width = lies ? height : high - low};
        best.angle_deg = (lies ? std::atan2(y, x) : std::atan2(x, -y)) * 180 / std::numbers::pi;
        if (best.angle_deg > 90) best.angle_deg -= 180;
        if (best.angle_deg <= -90) best.angle_deg += 180;
    }
    return best;
}

}  // namespace hemoflux::membrane
