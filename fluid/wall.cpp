#include "fluid/wall.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemoflux::fluid {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
/// Points closer than this are one (degrees).
constexpr double same_angle = 1e-6;

/// First passage of the shear from backward to forward, among points (|angle|, shear) by ascending angle.
std::optional<double> first_zero(const std::vector<std::pair<double, double>>& half) {
    for (std::size_t i = 1; i < half.size(); ++i) {
        const auto& [a, fa] = half[i - 1];
        const auto& [b, fb] = half[i];
        if (fa < 0 && fb >= 0) return a + (b - a) * fa / (fa - fb);
    }
    return std::nullopt;
}

}  // namespace

WallForce total_force(const std::vector<WallFace>& faces) {
    WallForce sum;
    for (const WallFace& face : faces) {
        sum.pressure += face.pressure;
        sum.viscous += face.viscous;
    }
    return sum;
}

double force_coefficient(const Vec3d& force, const Vec3d& direction, double speed, double area) {
    return dot(force, direction) / (0.5 * speed * speed * area);
}

std::vector<WallPoint> wall_points(const std::vector<WallFace>& faces, const BodyFrame& frame) {
    struct Weighted {
        WallPoint point;
        double area;
    };
    std::vector<Weighted> all;
    for (const WallFace& face : faces) {
        const double area = norm(face.area);
        const Vec3d arm = face.centre - frame.centre, normal = (-1 / area) * face.area;
        const double angle = std::atan2(dot(arm, frame.lift), dot(arm, frame.stream));
        // the wall's own tangent, turned anticlockwise from its normal, points to growing angles
        const Vec3d tangent = dot(normal, frame.stream) * frame.lift - dot(normal, frame.lift) * frame.stream;
        const double shear = (angle > 0 ? -1 : 1) * dot(face.viscous, tangent) / area;
        all.push_back({{face.centre, degrees * angle, -dot(face.pressure, normal) / area, shear}, area});
    }
    std::sort(all.begin(), all.end(),
              [](const Weighted& a, const Weighted& b) { return a.point.angle_deg < b.point.angle_deg; });
    std::vector<WallPoint> points;
    for (std::size_t i = 0; i < all.size();) {
        WallPoint mean{{0, 0, 0}, all[i].point.angle_deg, 0, 0};
        double area = 0;
        for (; i < all.size() && all[i].point.angle_deg - mean.angle_deg < same_angle; ++i) {
            const auto& [p, a] = all[i];
            mean.centre += a * p.centre;
            mean.pressure += a * p.pressure;
            mean.shear += a * p.shear;
            area += a;
        }
        mean.centre = (1 / area) * mean.centre;
        mean.pressure /= area;
        mean.shear /= area;
        points.push_back(mean);
    }
    return points;
}

std::optional<double> separation_angle_deg(const std::vector<WallPoint>& points) {
    std::vector<std::pair<double, double>> halves[2];
    for (const WallPoint& p : points) halves[p.angle_deg > 0].emplace_back(std::abs(p.angle_deg), p.shear);
    std::reverse(halves[0].begin(), halves[0].end());
    const auto below = first_zero(halves[0]), above = first_zero(halves[1]);
    if (below && above) return (*below + *above) / 2;
    return below ? below : above;
}

}  // namespace hemoflux::fluid
