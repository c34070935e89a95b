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

/// The triangles of a view by squares of its plane, so that a line along the axis meets few.
class Raster {
  public:
    explicit Raster(const View& view) : triangles_(view.triangles) {
        for (std::size_t i = 0; i < view.u.size(); ++i)
            half_ = std::max({half_, std::fabs(view.u[i]), std::fabs(view.v[i])});
        side_ = static_cast<long>(std::sqrt(static_cast<double>(triangles_.size()) / 4)) + 1;
        squares_.resize(static_cast<std::size_t>(side_ * side_));
        for (std::size_t k = 0; k < triangles_.size(); ++k) {
            const auto [u0, u1] = std::minmax_element(triangles_[k].u.begin(), triangles_[k].u.end());
            const auto [v0, v1] = std::minmax_element(triangles_[k].v.begin(), triangles_[k].v.end());
            for (long i = place(*u0 - slack); i <= place(*u1 + slack); ++i)
                for (long j = place(*v0 - slack); j <= place(*v1 + slack); ++j) square(i, j).push_back(k);
        }
    }

    /// Greatest distance of two crossings of the line along the axis through (u, v); 0 outside the cell.
    double thickness(double u, double v) {
        double low = std::numeric_limits<double>::infinity(), high = -low, height = 0;
        for (const std::size_t k : square(place(u), place(v)))
            if (meet(triangles_[k], u, v, height)) {
                low = std::min(low, height);
                high = std::max(high, height);
            }
        return std::max(0.0, high - low);
    }

  private:
    static constexpr double slack = 1e-9;  // um, more than the slack of meet()
    [[nodiscard]] long place(double a) const {
        return std::clamp(static_cast<long>(0.5 * (a / half_ + 1) * static_cast<double>(side_)), 0L,
                          side_ - 1);
    }
    std::vector<std::size_t>& square(long i, long j) {
        return squares_[static_cast<std::size_t>(i * side_ + j)];
    }

    const std::vector<Projected>& triangles_;
    double half_ = 0;
    long side_ = 1;
    std::vector<std::vector<std::size_t>> squares_;
};

}  // namespace

DiscMeasures disc_measures(const Triangles& triangles, const std::vector<Vec3d>& positions) {
    const View view(triangles, positions);
    Raster raster(view);
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
    d.centre_thickness = raster.thickness(0, 0);
    for (std::size_t i = 0; i < view.u.size(); ++i)
        d.greatest_thickness = std::max(d.greatest_thickness, raster.thickness(view.u[i], view.v[i]));
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
    Raster raster(view);
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
            const double t = raster.thickness(s.radius * std::cos(angle), s.radius * std::sin(angle));
            s.mean += t / directions;
            s.least = std::min(s.least, t);
            s.greatest = std::max(s.greatest, t);
        }
        profile.push_back(s);
    }
    return profile;
}

}  // namespace hemoflux::membrane
