#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::membrane {
namespace {

constexpr double pi = std::numbers::pi;

/// A triangle seen along the disc's axis: corners in the plane, and their heights.
struct Projected {
    std::array<double, 3> u, v, h;
};

/// Height at which the line along the axis through (u, v) meets the triangle; false when it misses it.
bool meet(const Projected& t, double u, double v, double& height) {
    const double d1u = t.u[1] - t.u[0], d1v = t.v[1] - t.v[0], d2u = t.u[2] - t.u[0], d2v = t.v[2] - t.v[0];
    const double area = d1u * d2v - d1v * d2u;
    if (area == 0) return false;
    const double b = ((u - t.u[0]) * d2v - (v - t.v[0]) * d2u) / area;
    const double c = (d1u * (v - t.v[0]) - d1v * (u - t.u[0])) / area;
    constexpr double slack = 1e-12;  // a line through a vertex meets its triangles
    if (!(b >= -slack && c >= -slack && b + c <= 1 + slack)) return false;
    height = t.h[0] + b * (t.h[1] - t.h[0]) + c * (t.h[2] - t.h[0]);
    return true;
}

/// A cell seen along the disc's axis through its volume centroid.
struct View {
    std::vector<double> u, v, h;
    std::vector<Projected> triangles;

    View(const Triangles& all, const std::vector<Vec3d>& positions) {
        const ShapeMoments s = shape_moments(all, positions);
        for (const Vec3d& p : positions) {
            const Vec3d r = p - s.centroid;
            u.push_back(dot(r, s.axes[0]));
            v.push_back(dot(r, s.axes[1]));
            h.push_back(dot(r, s.axes[2]));
        }
        for (const auto& t : all) {
            Projected p{};
            for (std::size_t c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(t[c]);
                p.u[c] = u[i];
                p.v[c] = v[i];
                p.h[c] = h[i];
            }
            triangles.push_back(p);
        }
    }
};

double thickness(const std::vector<Projected>& triangles, double u, double v) {
    double low = std::numeric_limits<double>::infinity(), high = -low, height = 0;
    for (const Projected& t : triangles)
        if (meet(t, u, v, height)) {
            low = std::min(low, height);
            high = std::max(high, height);
        }
    return std::max(0.0, high - low);
}

}  // namespace

DiscMeasures disc_measures(const Triangles& triangles, const std::vector<Vec3d>& positions) {
    const View view(triangles, positions);
    DiscMeasures d;
    constexpr int directions = 180;
    for (int k = 0; k < directions; ++k) {
        const double x = std::cos(pi * k / directions), y = std::sin(pi * k / directions);
        double low = 0, high = 0;
        for (std::size_t i = 0; i < view.u.size(); ++i) {
            low = std::min(low, x * view.u[i] + y * view.v[i]);
            high = std::max(high, x * view.u[i] + y * view.v[i]);
        }
        d.diameter = std::max(d.diameter, high - low);
    }
    d.centre_thickness = thickness(view.triangles, 0, 0);
    for (std::size_t i = 0; i < view.u.size(); ++i)
        d.greatest_thickness =
            std::max(d.greatest_thickness, thickness(view.triangles, view.u[i], view.v[i]));
    return d;
}

std::vector<ThicknessSample> thickness_profile(const Triangles& triangles,
                                               const std::vector<Vec3d>& positions, int samples,
                                               int directions) {
    if (samples < 2 || directions < 1)
        throw InputError("a thickness profile of " + std::to_string(samples) + " radii in " +
                             std::to_string(directions) + " directions",
                         "it needs two radii and one direction", "Ask for more");
    const View view(triangles, positions);
    double rim = 0;  // mean over the directions of the furthest vertex
    for (int k = 0; k < directions; ++k) {
        const double x = std::cos(2 * pi * k / directions), y = std::sin(2 * pi * k / directions);
        double reach = 0;
        for (std::size_t i = 0; i < view.u.size(); ++i)
            reach = std::max(reach, x * view.u[i] + y * view.v[i]);
        rim += reach / directions;
    }
    std::vector<ThicknessSample> profile;
    for (int i = 0; i < samples; ++i) {
        ThicknessSample s{.radius = rim * i / (samples - 1),
                          .least = std::numeric_limits<double>::infinity()};
        for (int k = 0; k < directions; ++k) {
            const double angle = 2 * pi * k / directions;
            const double t =
                thickness(view.triangles, s.radius * std::cos(angle), s.radius * std::sin(angle));
            s.mean += t / directions;
            s.least = std::min(s.least, t);
            s.greatest = std::max(s.greatest, t);
        }
        profile.push_back(s);
    }
    return profile;
}

}  // namespace hemoflux::membrane
