#include "coupling/viscosity.hpp"

#include <algorithm>
#include <string>

#include "coupling/band_triangle.hpp"
#include "coupling/triangle_rings.hpp"
#include "exchange/error.hpp"
#include "exchange/memory.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Unit normal of vertex v: the mean of the triangles around it, weighted by area.
struct VertexNormal {
    const BandTriangle* triangle;
    const int *ring_begin, *ring;
    std::size_t vertices, triangles;
    double* normal[3];
    HEMOFLUX_FN void operator()(std::size_t v) const {
        const std::size_t c = v / vertices;
        Vec3d sum{0, 0, 0};
        if (ring_begin[v % vertices] == ring_begin[v % vertices + 1]) {  // padding between two cells
            normal[0][v] = normal[1][v] = normal[2][v] = 0;
            return;
        }
        for (int i = ring_begin[v % vertices]; i < ring_begin[v % vertices + 1]; ++i) {
            const BandTriangle& t = triangle[c * triangles + static_cast<std::size_t>(ring[i] / 3)];
            sum += cross(t.ab, t.ac);
        }
        const Vec3d n = (1 / norm(sum)) * sum;
        normal[0][v] = n.x;
        normal[1][v] = n.y;
        normal[2][v] = n.z;
    }
};

/// Motion of vertex v since the last recomputation over what is allowed.
struct MotionOverLimit {
    const double *now[3], *then[3], *normal[3], *half_width;
    MotionLimits limits;
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t v) const {
        const Vec3d d{now[0][v] - then[0][v], now[1][v] - then[1][v], now[2][v] - then[2][v]};
        const double along = std::fabs(d.x * normal[0][v] + d.y * normal[1][v] + d.z * normal[2][v]);
        const double h = half_width[v];
        const double a = along / (limits.normal * h), b = norm(d) / (limits.total * h);
        return {a > b ? a : b};
    }
};

void check(double nu, const char* where) {
    if (!(nu > 0))
        throw InputError(std::string("viscosity ") + where + " of " + std::to_string(nu),
                         "it must be positive", "give a viscosity above zero");
}

}  // namespace

struct InteriorViscosity::Motion {
    exchange::Reduction<exchange::Maximum> largest;
};

InteriorViscosity::InteriorViscosity(const FluidGrid& grid, const std::vector<std::array<int, 3>>& triangles,
                                     std::size_t vertices, const std::vector<double>& nu_inside,
                                     double nu_outside, HalfWidth half_width, MotionLimits limits,
                                     double surface_nu)
    : band_(grid.band({triangles, vertices, nu_inside.size()}, half_width)),
      nu_outside_(nu_outside),
      surface_nu_(surface_nu),
      half_width_(half_width),
      limits_(limits),
      vertices_(vertices),
      triangles_(triangles.size()),
      nu_inside_(nu_inside),
      motion_(std::make_unique<Motion>()) {
    check(nu_outside, "outside the cells");
    if (!(surface_nu >= 0))
        throw InputError("surface viscosity of " + std::to_string(surface_nu), "it must not be negative",
                         "give zero or more");
    low_ = high_ = nu_outside;
    for (const double nu : nu_inside) {
        check(nu, "inside a cell");
        low_ = std::min(low_, nu);
        high_ = std::max(high_, nu);
    }
    const TriangleRings rings(triangles, vertices);
    ring_begin_ = exchange::Buffer<int>(rings.begin);
    ring_ = exchange::Buffer<int>(rings.corner);
    for (int q = 0; q < 3; ++q) {
        position_[q] = exchange::Buffer<double>(vertices * nu_inside.size());
        normal_[q] = exchange::Buffer<double>(vertices * nu_inside.size());
    }
}

InteriorViscosity::~InteriorViscosity() = default;

bool InteriorViscosity::update(const double* x, const double* y, const double* z, double* nu,
                               std::size_t stride) {
    if (recomputations_ > 0) {
        const MotionOverLimit motion{{x, y, z},
                                     {position_[0].data(), position_[1].data(), position_[2].data()},
                                     {normal_[0].data(), normal_[1].data(), normal_[2].data()},
                                     band_->half_widths(),
                                     limits_};
        if (motion_->largest.sum(position_[0].size(), motion).value <= 1) return false;
    }
    recompute(x, y, z, nu, stride);
    return true;
}

void InteriorViscosity::recompute(const double* x, const double* y, const double* z, double* nu,
                                  std::size_t stride) {
    band_->prepare(x, y, z);
    band_->viscosity({nu_inside_.data(), nu_outside_, low_, high_, surface_nu_, half_width_}, nu, stride);
    const double* from[3] = {x, y, z};
    for (int q = 0; q < 3; ++q)
        exchange::copy_on_device(position_[q].data(), from[q], position_[q].size() * sizeof(double));
    exchange::for_each_index(position_[0].size(),
                             VertexNormal{band_->triangles(),
                                          ring_begin_.data(),
                                          ring_.data(),
                                          vertices_,
                                          triangles_,
                                          {normal_[0].data(), normal_[1].data(), normal_[2].data()}});
    ++recomputations_;
}

std::array<std::vector<double>, 3> InteriorViscosity::positions() const {
    if (recomputations_ == 0) return {};
    return {position_[0].to_host(), position_[1].to_host(), position_[2].to_host()};
}

}  // namespace hemoflux::coupling
