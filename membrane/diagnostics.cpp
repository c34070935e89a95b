#include "membrane/diagnostics.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemoflux::membrane {
namespace {

constexpr double pi = std::numbers::pi;

const Vec3d& at(const std::vector<Vec3d>& positions, int v) { return positions[static_cast<std::size_t>(v)]; }

Eigen::Vector3d eigen(const Vec3d& a) { return {a.x, a.y, a.z}; }

double taylor(double longest, double shortest) { return (longest - shortest) / (longest + shortest); }

/// Nodes and weights of the midpoint rule in angle and of Gauss-Legendre in height over one octant.
struct Octant {
    static constexpr int points = 32;
    std::array<double, points> height{}, weight{};

    Octant() {
        for (int i = 0; i < points; ++i) {
            double x = std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 1;
            for (int iteration = 0; iteration < 50; ++iteration) {
                double p = 1, before = 0;
                for (int k = 1; k <= points; ++k) {
                    const double last = before;
                    before = p;
                    p = ((2 * k - 1) * x * before - (k - 1) * last) / k;
                }
                slope = points * (x * p - before) / (x * x - 1);
                const double change = p / slope;
                x -= change;
                if (std::fabs(change) < 1e-16) break;
            }
            height[static_cast<std::size_t>(i)] = 0.5 * (1 + x);
            weight[static_cast<std::size_t>(i)] = 1 / ((1 - x * x) * slope * slope);
        }
    }
};

}  // namespace

ShapeMoments shape_moments(const Triangles& triangles, const std::vector<Vec3d>& positions) {
    ShapeMoments s;
    const Vec3d origin = positions.front();
    Vec3d volume_moment{0, 0, 0}, area_moment{0, 0, 0};
    for (const auto& t : triangles) {
        const Vec3d a = at(positions, t[0]) - origin, b = at(positions, t[1]) - origin,
                    c = at(positions, t[2]) - origin, sum = a + b + c;
        const double volume = dot(a, cross(b, c)) / 6, area = 0.5 * norm(cross(b - a, c - a));
        s.volume += volume;
        s.area += area;
        volume_moment += (volume / 4) * sum;
        area_moment += (area / 3) * sum;
    }
    s.centroid = origin + (1 / s.volume) * volume_moment;
    s.reduced_volume = 6 * std::sqrt(pi) * s.volume / std::pow(s.area, 1.5);
    const Vec3d middle = origin + (1 / s.area) * area_moment;
    Eigen::Matrix3d g = Eigen::Matrix3d::Zero(), solid = Eigen::Matrix3d::Zero();
    for (const auto& t : triangles) {
        const Vec3d a = at(positions, t[0]) - middle, b = at(positions, t[1]) - middle,
                    c = at(positions, t[2]) - middle;
        const double weight = norm(cross(b - a, c - a)) / 24;
        for (const Vec3d& p : {a, b, c, a + b + c}) g += weight * eigen(p) * eigen(p).transpose();
        const Vec3d to_middle = middle - s.centroid, d = a + to_middle, e = b + to_middle, f = c + to_middle;
        const double share = dot(d, cross(e, f)) / 120;
        for (const Vec3d& p : {d, e, f, d + e + f}) solid += share * eigen(p) * eigen(p).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(g / s.area), inside(solid / s.volume);
    for (int i = 0; i < 3; ++i) {
        const auto to = static_cast<std::size_t>(i);
        s.moments[to] = solver.eigenvalues()[2 - i];
        s.volume_moments[to] = inside.eigenvalues()[2 - i];
        const Eigen::Vector3d axis = solver.eigenvectors().col(2 - i);
        s.axes[to] = {axis.x(), axis.y(), axis.z()};
    }
    return s;
}

std::array<double, 3> ellipsoid_moments(const std::array<double, 3>& half_axes) {
    static const Octant octant;
    const double a = half_axes[0], b = half_axes[1], c = half_axes[2];
    double total = 0, x2 = 0, y2 = 0, z2 = 0;
    for (std::size_t i = 0; i < Octant::points; ++i)
        for (int k = 0; k < Octant::points; ++k) {
            const double nz = octant.height[i], rho2 = 1 - nz * nz;
            const double angle = 0.5 * pi * (k + 0.5) / Octant::points;
            const double nx2 = rho2 * std::pow(std::cos(angle), 2), ny2 = rho2 - nx2;
            const double w = octant.weight[i] *
                             std::sqrt(b * b * c * c * nx2 + a * a * c * c * ny2 + a * a * b * b * nz * nz);
            total += w;
            x2 += w * nx2;
            y2 += w * ny2;
            z2 += w * nz * nz;
        }
    return {a * a * x2 / total, b * b * y2 / total, c * c * z2 / total};
}

std::array<double, 3> ellipsoid_half_axes(const std::array<double, 3>& moments) {
    std::array<double, 3> axes{};
    for (std::size_t i = 0; i < 3; ++i) axes[i] = std::sqrt(3 * moments[i]);
    // G_i / a_i^2 varies slowly with the axes, so that this iteration contracts.
    for (int iteration = 0; iteration < 200; ++iteration) {
        const auto now = ellipsoid_moments(axes);
        double change = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double factor = std::sqrt(moments[i] / now[i]);
            axes[i] *= factor;
            change = std::max(change, std::fabs(factor - 1));
        }
        if (!(change > 1e-14)) break;
    }
    return axes;
}

double taylor_deformation(const ShapeMoments& moments) {
    const auto axes = ellipsoid_half_axes(moments.moments);
    return taylor(axes[0], axes[2]);
}

std::array<double, 3> inertia_half_axes(const ShapeMoments& moments) {
    std::array<double, 3> axes{};
    for (std::size_t i = 0; i < 3; ++i) axes[i] = std::sqrt(5 * moments.volume_moments[i]);
    return axes;
}

double taylor_deformation_volume(const ShapeMoments& moments) {
    const auto axes = inertia_half_axes(moments);
    return taylor(axes[0], axes[2]);
}

double taylor_deformation_extent(const std::vector<Vec3d>& positions, const Vec3d& centroid) {
    const auto [least, greatest] = std::minmax_element(
        positions.begin(), positions.end(),
        [&](const Vec3d& a, const Vec3d& b) { return norm(a - centroid) < norm(b - centroid); });
    return taylor(norm(*greatest - centroid), norm(*least - centroid));
}

double inclination(const ShapeMoments& moments) {
    Vec3d axis = moments.axes[0];
    if (std::hypot(axis.x, axis.y) < 0.5) axis = moments.axes[1];
    double degrees = std::atan2(axis.y, axis.x) * 180 / pi;
    if (degrees > 90) degrees -= 180;
    if (degrees <= -90) degrees += 180;
    return degrees;
}

double angle_about(const Vec3d& point, const Vec3d& centroid) {
    return std::atan2(point.y - centroid.y, point.x - centroid.x);
}

double membrane_turn(const std::vector<Vec3d>& positions, std::span<const double> labels,
                     const Vec3d& centroid, double inclination) {
    // weights fall by e within a fortieth of the length of the cell: wide enough for several vertices to count
    constexpr double sharpness = 20;
    const double cosine = std::cos(inclination), sine = std::sin(inclination);
    const auto along = [&](const Vec3d& p) {
        return cosine * (p.x - centroid.x) + sine * (p.y - centroid.y);
    };
    double low = 0, high = 0;
    for (const Vec3d& p : positions) low = std::min(low, along(p)), high = std::max(high, along(p));
    double x = 0, y = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const double at = along(positions[v]), per_length = 2 * sharpness / (high - low);
        const double weight = std::exp(per_length * (at - high)) - std::exp(per_length * (low - at));
        x += weight * std::cos(labels[v]);
        y += weight * std::sin(labels[v]);
    }
    const double turn = std::remainder(inclination - std::atan2(y, x), 2 * pi);
    return turn > -pi ? turn : pi;
}

Diameters stretch_diameters(const std::vector<Vec3d>& positions, const Vec3d& centroid) {
    Diameters d;
    for (const Vec3d& p : positions) {
        const Vec3d r = p - centroid;
        d.axial = std::max(d.axial, 2 * norm(r));
        d.transverse = std::max(d.transverse, 2 * std::hypot(r.y, r.z));
    }
    return d;
}

}  // namespace hemoflux::membrane
