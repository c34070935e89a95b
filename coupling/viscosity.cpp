#include "coupling/viscosity.hpp"

#include <algorithm>
#include <string>

#include "coupling/band_triangle.hpp"
#include "coupling/triangle_rings.hpp"
#include "exchange/error.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Unit normal of vertex v: the mean of the triangles around it, weighted by area.
struct VertexNormal {
    const BandTriangle* triangle;
    const int *ring_begin, *ring, *moved;
    std::size_t vertices, triangles;
    double* normal[3];
    HEMOFLUX_FN void operator()(std::size_t v) const {
        const std::size_t c = v / vertices;
        if (!moved[c]) return;
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

/// Motion of a vertex of a cell since the cell was last measured, over what is allowed.
struct MotionOverLimit {
    const double *now[3], *then[3], *normal[3], *half_width;
    MotionLimits limits;
    std::size_t vertices;
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t cell, std::size_t vertex) const {
        const std::size_t v = cell * vertices + vertex;
        const Vec3d d{now[0][v] - then[0][v], now[1][v] - then[1][v], now[2][v] - then[2][v]};
        const double along = std::fabs(d.x * normal[0][v] + d.y * normal[1][v] + d.z * normal[2][v]);
        const double h = half_width[v];
        const double a = along / (limits.normal * h), b = norm(d) / (limits.total * h);
        return {a > b ? a : b};
    }
};

/// Takes over the positions of the cells that moved.
struct TakePositions {
    const double* now[3];
    const int* moved;
    std::size_t vertices;
    double* then[3];
    HEMOFLUX_FN void operator()(std::size_t v) const {
        if (!moved[v / vertices]) return;
        for (int q = 0; q < 3; ++q) then[q][v] = now[q][v];
    }
};

void check(double nu, const char* where) {
    if (!(nu > 0))
        throw InputError(std::string("viscosity ") + where + " of " + std::to_string(nu),
                         "it must be positive", "give a viscosity above zero");
}

}  // namespace

struct InteriorViscosity::Motion {
    exchange::Reduction<exchange::Maximum> reduction;
    exchange::Buffer<exchange::Maximum> largest;
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
      moved_(nu_inside.size()),
      motion_(std::make_unique<Motion>()) {
    motion_->largest = exchange::Buffer<exchange::Maximum>(nu_inside.size());
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
    if (recomputations_ == 0) {
        recompute(x, y, z, nu, stride);
        return true;
    }
    const MotionOverLimit motion{{x, y, z},
                                 {position_[0].data(), position_[1].data(), position_[2].data()},
                                 {normal_[0].data(), normal_[1].data(), normal_[2].data()},
                                 band_->half_widths(),
                                 limits_,
                                 vertices_};
    motion_->reduction.sum_segments(nu_inside_.size(), vertices_, motion, motion_->largest.data());
    std::vector<int> moved;
    for (const exchange::Maximum& largest : motion_->largest.to_host())
        moved.push_back(!(largest.value <= 1));
    if (std::find(moved.begin(), moved.end(), 1) == moved.end()) return false;
    recompute_moved(moved, x, y, z, nu, stride);
    return true;
}

void InteriorViscosity::recompute(const double* x, const double* y, const double* z, double* nu,
                                  std::size_t stride) {
    recompute_moved(std::vector<int>(nu_inside_.size(), 1), x, y, z, nu, stride);
}

void InteriorViscosity::recompute_moved(const std::vector<int>& moved, const double* x, const double* y,
                                        const double* z, double* nu, std::size_t stride) {
    moved_.assign(moved);
    exchange::for_each_index(position_[0].size(),
                             TakePositions{{x, y, z},
                                           moved_.data(),
                                           vertices_,
                                           {position_[0].data(), position_[1].data(), position_[2].data()}});
    band_->prepare(position_[0].data(), position_[1].data(), position_[2].data(), moved);
    band_->viscosity({nu_inside_.data(), nu_outside_, low_, high_, surface_nu_, half_width_}, nu, stride);
    exchange::for_each_index(position_[0].size(),
                             VertexNormal{band_->triangles(),
                                          ring_begin_.data(),
                                          ring_.data(),
                                          moved_.data(),
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
