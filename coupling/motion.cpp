#include "coupling/motion.hpp"

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

struct MoveNode {
    double dt;
    const double *vx, *vy, *vz;
    double *x, *y, *z;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        x[i] += dt * vx[i];
        y[i] += dt * vy[i];
        z[i] += dt * vz[i];
    }
};

struct AddTerm {
    const double* term;
    double* sum;
    HEMOFLUX_FN void operator()(std::size_t i) const { sum[i] += term[i]; }
};

struct ShiftNode {
    Vec3d by;
    double *x, *y, *z;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        x[i] += by.x;
        y[i] += by.y;
        z[i] += by.z;
    }
};

/// Six volumes and their first moments.
struct VolumeMoments {
    double volume = 0;
    Vec3d first{0, 0, 0};
    HEMOFLUX_FN VolumeMoments& operator+=(const VolumeMoments& b) {
        volume += b.volume;
        first += b.first;
        return *this;
    }
};

/// Tetrahedron of one triangle and the target: 6 V = R1.(R2 x R3), centroid (R1 + R2 + R3)/4 about the
/// target.
struct TriangleMoments {
    const int* corners;
    std::size_t triangles, stride;
    const double *x, *y, *z;
    Vec3d target;
    HEMOFLUX_INLINE Vec3d node(std::size_t triangle, int c) const {
        const std::size_t cell = triangle / triangles, t = triangle % triangles;
        const std::size_t i =
            cell * stride + static_cast<std::size_t>(corners[3 * t + static_cast<std::size_t>(c)]);
        return Vec3d{x[i], y[i], z[i]} - target;
    }
    HEMOFLUX_FN VolumeMoments operator()(std::size_t triangle) const {
        const Vec3d a = node(triangle, 0), b = node(triangle, 1), c = node(triangle, 2);
        const double volume = dot(a, cross(b, c));
        return {volume, 0.25 * volume * (a + b + c)};
    }
};

}  // namespace

void add(std::size_t n, const double* term, double* sum) { exchange::for_each_index(n, AddTerm{term, sum}); }

void move(std::size_t n, double dt, const double* vx, const double* vy, const double* vz, double* x,
          double* y, double* z) {
    exchange::for_each_index(n, MoveNode{dt, vx, vy, vz, x, y, z}, exchange::Cost::cheap);
}

struct Recentring::Scratch {
    exchange::Reduction<VolumeMoments> reduction;
};

Recentring::Recentring(const std::vector<std::array<int, 3>>& triangles, std::size_t stride,
                       std::size_t cells, const Vec3d& target)
    : stride_(stride), cells_(cells), triangles_(triangles.size()), target_(target), scratch_(new Scratch) {
    std::vector<int> corners;
    for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    corners_ = exchange::Buffer<int>(corners);
}

Recentring::~Recentring() = default;

Vec3d Recentring::apply(double* x, double* y, double* z) {
    const VolumeMoments m = scratch_->reduction.sum(
        triangles_ * cells_, TriangleMoments{corners_.data(), triangles_, stride_, x, y, z, target_});
    const Vec3d shift = (-1 / m.volume) * m.first;
    exchange::for_each_index(stride_ * cells_, ShiftNode{shift, x, y, z}, exchange::Cost::cheap);
    return shift;
}

}  // namespace hemoflux::coupling
