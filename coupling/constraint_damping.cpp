#include "coupling/constraint_damping.hpp"

#include <algorithm>

#include "coupling/triangle_rings.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

constexpr int passes = 4;
constexpr double weight_at_most = 0.3, share_per_strength = 9;
/// Squared sine of the angle between grad V and grad A, below which (on a sphere) one follows from the other.
constexpr double parallel = 1e-6;

struct Surface {
    std::size_t triangles, stride;
    const int *corners, *ring_begin, *ring;
    /// Of a triangle counted through all cells.
    HEMOFLUX_INLINE std::size_t node(std::size_t triangle, int corner) const {
        return node(triangle / triangles, triangle % triangles, corner);
    }
    /// Of triangle t of a cell.
    HEMOFLUX_INLINE std::size_t node(std::size_t cell, std::size_t t, int corner) const {
        return cell * stride + static_cast<std::size_t>(corners[3 * t + static_cast<std::size_t>(corner)]);
    }
};

HEMOFLUX_INLINE Vec3d at(const double* const (&p)[3], std::size_t i) { return {p[0][i], p[1][i], p[2][i]}; }

struct TriangleTask {
    Surface surface;
    const double* x[3];
    TriangleGradient* out;
    HEMOFLUX_FN void operator()(std::size_t t) const {
        gradients(t, surface.node(t, 0), surface.node(t, 1), surface.node(t, 2));
    }
    /// Of triangle t, counted through all cells, with its corners.
    HEMOFLUX_INLINE void gradients(std::size_t t, std::size_t i, std::size_t j, std::size_t k) const {
        const Vec3d a = at(x, i), b = at(x, j), c = at(x, k);
        const Vec3d normal2 = cross(b - a, c - a);
        const double size = norm(normal2), half = 0.5 / size;
        out[t] = {{half * cross(normal2, c - b), half * cross(normal2, a - c), half * cross(normal2, b - a)},
                  normal2,
                  2 / size};
    }
};

struct NodeTask {
    Surface surface;
    const TriangleGradient* triangle;
    NodeGradient* out;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t cell = i / surface.stride, v = i % surface.stride;
        Vec3d volume{0, 0, 0}, area{0, 0, 0};
        double scale = 0;
        for (int r = surface.ring_begin[v]; r < surface.ring_begin[v + 1]; ++r) {
            const int corner = surface.ring[r];
            const TriangleGradient& t =
                triangle[cell * surface.triangles + static_cast<std::size_t>(corner / 3)];
            const Vec3d& g = t.area[corner % 3];
            volume += t.normal2;
            area += g;
            scale += dot(g, g) * t.inverse_area;
        }
        out[i] = {(1.0 / 6) * volume, area, scale > 0 ? 1 / scale : 0.0};
    }
};

struct Products {
    std::size_t stride;
    const NodeGradient* node;
    const double* u[3];
    HEMOFLUX_FN GradientSums operator()(std::size_t cell, std::size_t v) const {
        const std::size_t i = cell * stride + v;
        const NodeGradient& g = node[i];
        const Vec3d velocity = at(u, i);
        return {dot(g.volume, g.volume), dot(g.volume, g.area), dot(g.area, g.area), dot(g.volume, velocity),
                dot(g.area, velocity)};
    }
};

/// u <- u - share P u.
struct Project {
    std::size_t stride;
    const NodeGradient* node;
    const GradientSums* sums;
    double share;
    double* u[3];
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const GradientSums& s = sums[i / stride];
        const double det = s.volume2 * s.area2 - s.mixed * s.mixed;
        double along_volume = s.volume_rate / s.volume2, along_area = 0;
        if (det > parallel * s.volume2 * s.area2) {
            along_volume = (s.volume_rate * s.area2 - s.area_rate * s.mixed) / det;
            along_area = (s.area_rate * s.volume2 - s.volume_rate * s.mixed) / det;
        }
        const Vec3d change = share * (along_volume * node[i].volume + along_area * node[i].area);
        u[0][i] -= change.x;
        u[1][i] -= change.y;
        u[2][i] -= change.z;
    }
};

/// Rate of change of a triangle's area over its area.
struct RateTask {
    Surface surface;
    const TriangleGradient* triangle;
    const double* u[3];
    double* rate;
    HEMOFLUX_FN void operator()(std::size_t t) const {
        const TriangleGradient& g = triangle[t];
        double sum = 0;
        for (int c = 0; c < 3; ++c) sum += dot(g.area[c], at(u, surface.node(t, c)));
        rate[t] = sum * g.inverse_area;
    }
};

struct Relieve {
    Surface surface;
    const TriangleGradient* triangle;
    const NodeGradient* node;
    const double* rate;
    double weight;
    double* u[3];
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t cell = i / surface.stride, v = i % surface.stride;
        Vec3d sum{0, 0, 0};
        for (int r = surface.ring_begin[v]; r < surface.ring_begin[v + 1]; ++r) {
            const int corner = surface.ring[r];
            const std::size_t t = cell * surface.triangles + static_cast<std::size_t>(corner / 3);
            sum += rate[t] * triangle[t].area[corner % 3];
        }
        const Vec3d change = weight * node[i].inverse_scale * sum;
        u[0][i] -= change.x;
        u[1][i] -= change.y;
        u[2][i] -= change.z;
    }
};

/// All passes over one cell, one cell after the other: its gradients stay in the cache, and as no other thread writes to
/// its nodes, triangles add to them instead of nodes gathering from triangles.
struct RelieveCell {
    TriangleTask task;
    NodeGradient* node;
    Vec3d* pull;  ///< work, a value a node
    double weight;
    double* u[3];

    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const Surface& s = task.surface;
        const std::size_t n0 = cell * s.stride, n1 = n0 + s.stride;
        for (std::size_t i = n0; i < n1; ++i) node[i] = {{0, 0, 0}, {0, 0, 0}, 0};
        for (std::size_t t = 0; t < s.triangles; ++t) add_gradients(cell, t);
        for (std::size_t i = n0; i < n1; ++i) {
            node[i].volume = (1.0 / 6) * node[i].volume;
            node[i].inverse_scale = node[i].inverse_scale > 0 ? 1 / node[i].inverse_scale : 0.0;
        }
        for (int pass = 0; pass < passes; ++pass) {
            for (std::size_t i = n0; i < n1; ++i) pull[i] = {0, 0, 0};
            for (std::size_t t = 0; t < s.triangles; ++t) add_pull(cell, t);
            for (std::size_t i = n0; i < n1; ++i) follow(i);
        }
    }

  private:
    struct Corners {
        std::size_t of[3];
    };
    HEMOFLUX_INLINE Corners corners(std::size_t cell, std::size_t t) const {
        const Surface& s = task.surface;
        return {{s.node(cell, t, 0), s.node(cell, t, 1), s.node(cell, t, 2)}};
    }
    /// Until all triangles have added theirs, inverse_scale is d_i.
    HEMOFLUX_INLINE void add_gradients(std::size_t cell, std::size_t t) const {
        const Corners corner = corners(cell, t);
        const std::size_t number = cell * task.surface.triangles + t;
        task.gradients(number, corner.of[0], corner.of[1], corner.of[2]);
        const TriangleGradient& g = task.out[number];
        for (int c = 0; c < 3; ++c) {
            NodeGradient& n = node[corner.of[c]];
            n.volume += g.normal2;
            n.area += g.area[c];
            n.inverse_scale += dot(g.area[c], g.area[c]) * g.inverse_area;
        }
    }
    HEMOFLUX_INLINE void add_pull(std::size_t cell, std::size_t t) const {
        const Corners corner = corners(cell, t);
        const TriangleGradient& g = task.out[cell * task.surface.triangles + t];
        double rate = 0;
        for (int c = 0; c < 3; ++c) {
            const std::size_t i = corner.of[c];
            rate += dot(g.area[c], Vec3d{u[0][i], u[1][i], u[2][i]});
        }
        rate *= g.inverse_area;
        for (int c = 0; c < 3; ++c) pull[corner.of[c]] += rate * g.area[c];
    }
    HEMOFLUX_INLINE void follow(std::size_t i) const {
        const Vec3d change = weight * node[i].inverse_scale * pull[i];
        u[0][i] -= change.x;
        u[1][i] -= change.y;
        u[2][i] -= change.z;
    }
};

/// The nodes that pad a cell go with its first one, on which they lie.
struct MovePadding {
    std::size_t stride;
    const int* ring_begin;
    double* u[3];
    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t v = i % stride;
        if (ring_begin[v] < ring_begin[v + 1]) return;
        for (int q = 0; q < 3; ++q) u[q][i] = u[q][i - v];
    }
};

}  // namespace

struct ConstraintDamping::Scratch {
    exchange::Reduction<GradientSums> products;
};

ConstraintDamping::ConstraintDamping(const std::vector<std::array<int, 3>>& triangles, std::size_t stride,
                                     std::size_t cells, double strength)
    : triangles_(triangles.size()),
      stride_(stride),
      cells_(cells),
      triangle_(triangles.size() * cells),
      node_(stride * cells),
      rate_(taken_one_by_one() ? 0 : triangles.size() * cells),
      pull_(taken_one_by_one() ? stride * cells : 0),
      sums_(cells),
      scratch_(std::make_unique<Scratch>()) {
    set_strength(strength);
    std::vector<int> corners;
    for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    corners_ = exchange::Buffer<int>(corners);
    const TriangleRings rings(triangles, stride);
    ring_begin_ = exchange::Buffer<int>(rings.begin);
    ring_ = exchange::Buffer<int>(rings.corner);
}

ConstraintDamping::~ConstraintDamping() = default;

bool ConstraintDamping::taken_one_by_one() const {
    // a cell a task takes every triangle once, not from each of its corners; with few cells threads would stand idle
    constexpr std::size_t many = 16;
    return !exchange::on_gpu && cells_ >= many;
}

void ConstraintDamping::set_strength(double strength) {
    share_ = share_per_strength * strength / (1 + share_per_strength * strength);
    weight_ = weight_at_most * std::min(1.0, strength);
}

void ConstraintDamping::apply(const double* x, const double* y, const double* z,
                              const std::array<double*, 3>& u) {
    const Surface surface{triangles_, stride_, corners_.data(), ring_begin_.data(), ring_.data()};
    const std::size_t triangles = triangles_ * cells_, nodes = stride_ * cells_;
    const TriangleTask gradients{surface, {x, y, z}, triangle_.data()};
    // not by the number of threads, on which results must not depend
    if (taken_one_by_one()) {
        exchange::for_each_index(
            cells_, RelieveCell{gradients, node_.data(), pull_.data(), weight_, {u[0], u[1], u[2]}});
    } else {
        const RateTask rates{surface, triangle_.data(), {u[0], u[1], u[2]}, rate_.data()};
        const Relieve relieve{surface,      triangle_.data(), node_.data(),
                              rate_.data(), weight_,          {u[0], u[1], u[2]}};
        exchange::for_each_index(triangles, gradients);
        exchange::for_each_index(nodes, NodeTask{surface, triangle_.data(), node_.data()});
        for (int pass = 0; pass < passes; ++pass) {
            exchange::for_each_index(triangles, rates);
            exchange::for_each_index(nodes, relieve);
        }
    }
    scratch_->products.sum_segments(cells_, stride_, Products{stride_, node_.data(), {u[0], u[1], u[2]}},
                                    sums_.data());
    exchange::for_each_index(nodes, Project{stride_, node_.data(), sums_.data(), share_, {u[0], u[1], u[2]}});
    exchange::for_each_index(nodes, MovePadding{stride_, ring_begin_.data(), {u[0], u[1], u[2]}},
                             exchange::Cost::cheap);
}

}  // namespace hemoflux::coupling
