#include "membrane/gompper_kroll.hpp"

#include "exchange/buffer.hpp"
#include "membrane/ring_kernels.hpp"

namespace hemoflux::membrane {
namespace {

/// H_j of one chunk of vertices of one cell.
template <class Value>
struct LaplacianTask {
    ForceView w;
    LaplacianView b;
    CellSums* partial;

    HEMOFLUX_INLINE void vertices(std::size_t cell, std::size_t v, Value& energy, Value& degenerate) const {
        const std::size_t here = cell * w.stride + v;
        const std::size_t degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
        const Value degree = load<Value>(w.degree + v), zero(0.0), one(1.0);
        const Vec3<Value> r = load_position<Value>(w, here);
        Vec3<Value> d = gather_position<Value>(w, cell, w.neighbour + v) - r, area_gradient{zero, zero, zero};
        Value voronoi = zero;
        for (std::size_t i = 0; i < degrees; ++i) {
            const auto inside = Value(static_cast<double>(i)) < degree;
            const Vec3<Value> next =
                gather_position<Value>(w, cell, w.neighbour + (i + 1) * w.stride + v) - r;
            const Vec3<Value> rim = next - d, xi = cross(d, next);
            const Value inverse = select(inside, 1.0 / square_root(dot(xi, xi)), zero);
            voronoi += 0.125 * inverse *
                       select(inside, dot(next, rim) * dot(d, d) - dot(d, rim) * dot(next, next), zero);
            area_gradient += (0.5 * inverse) * select3(inside, cross(xi, rim), Vec3<Value>{zero, zero, zero});
            d = next;
        }
        const auto real = zero < degree;
        const Value inverse = select(real, 1.0 / voronoi, zero);
        const Value energy_here = 0.5 * b.k_bending * inverse * dot(area_gradient, area_gradient);
        energy += select(real, energy_here, zero);
        degenerate += select(real, select(voronoi > zero, zero, one), zero);
        store(b.hx + here, inverse * area_gradient.x);
        store(b.hy + here, inverse * area_gradient.y);
        store(b.hz + here, inverse * area_gradient.z);
    }

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const Chunk chunk = chunk_of(task, w.stride);
        Value energy = 0.0, degenerate = 0.0;
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>)
            vertices(chunk.cell, v, energy, degenerate);
        CellSums sums;
        sums.helfrich_energy = exchange::lane_sum(energy);
        sums.degenerate = exchange::lane_sum(degenerate);
        partial[task] = sums;
    }
};

/// The force of one chunk of vertices of one cell.
template <class Value>
struct LaplacianForceTask {
    ForceView w;
    LaplacianView b;

    HEMOFLUX_INLINE Vec3<Value> gather_h(std::size_t base, const int* index) const {
        return {exchange::gather<Value>(b.hx + base, index), exchange::gather<Value>(b.hy + base, index),
                exchange::gather<Value>(b.hz + base, index)};
    }

    HEMOFLUX_INLINE void vertices(std::size_t cell, std::size_t v) const {
        const std::size_t base = cell * w.stride, here = base + v;
        const std::size_t degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
        const Value degree = load<Value>(w.degree + v), zero(0.0);
        const Vec3<Value> r = load_position<Value>(w, here), none{zero, zero, zero};
        const Vec3<Value> h{load<Value>(b.hx + here), load<Value>(b.hy + here), load<Value>(b.hz + here)};
        Vec3<Value> d = gather_position<Value>(w, cell, w.neighbour + v) - r;
        Vec3<Value> h_d = gather_h(base, w.neighbour + v), gradient = none;
        const Value q = 0.5 * dot(h, h);
        Value q_d = 0.5 * dot(h_d, h_d);
        for (std::size_t i = 0; i < degrees; ++i) {
            const auto inside = Value(static_cast<double>(i)) < degree;
            const int* index = w.neighbour + (i + 1) * w.stride + v;
            const Vec3<Value> e = gather_position<Value>(w, cell, index) - r, rim = e - d;
            const Vec3<Value> h_e = gather_h(base, index);
            const Value q_e = 0.5 * dot(h_e, h_e);
            const Vec3<Value> xi = cross(d, e);
            const Value inverse = load<Value>(w.inverse_normal + (cell * w.slots + i) * w.stride + v);
            const Vec3<Value> n = inverse * xi;
            const Vec3<Value> dxi = cross(h_d - h, e) + cross(d, h_e - h);
            const Vec3<Value> dn = inverse * (dxi - dot(n, dxi) * n);
            const Vec3<Value> n_rim = cross(n, rim);
            const Value d2 = dot(d, d), e2 = dot(e, e), rim2 = dot(rim, rim), u_e = dot(e, rim),
                        u_d = -dot(d, rim);
            const Value at_d = q + q_d, at_e = q + q_e, at_rim = q_d + q_e, eighth = 0.125 * inverse;
            const Value t = eighth * (at_d * u_e * d2 + at_e * u_d * e2 + at_rim * dot(d, e) * rim2);
            // 8 |xi| dT/dR_j without the change of |xi|, whose gradient is N x rim
            const Value by_rim = at_e * e2 - at_d * d2, by_d = -2.0 * at_d * u_e - at_rim * rim2,
                        by_e = -2.0 * at_e * u_d - at_rim * rim2;
            const Vec3<Value> along = by_rim * rim + by_d * d + by_e * e;
            const Vec3<Value> total =
                0.5 * (cross(dn, rim) + cross(n, h_e - h_d)) - eighth * along + (t * inverse) * n_rim;
            gradient += select3(inside, total, none);
            d = e;
            h_d = h_e;
            q_d = q_e;
        }
        const auto real = zero < degree;
        const Value k(b.k_bending);
        store(w.fx + here, select(real, load<Value>(w.fx + here) - k * gradient.x, zero));
        store(w.fy + here, select(real, load<Value>(w.fy + here) - k * gradient.y, zero));
        store(w.fz + here, select(real, load<Value>(w.fz + here) - k * gradient.z, zero));
    }

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const Chunk chunk = chunk_of(task, w.stride);
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>)
            vertices(chunk.cell, v);
    }
};

}  // namespace

struct LaplacianScratch::Memory {
    exchange::Buffer<CellSums> partial;
    exchange::Reduction<CellSums> reduction;
};

LaplacianScratch::LaplacianScratch(std::size_t cells, std::size_t stride)
    : memory_(std::make_unique<Memory>()) {
    memory_->partial = exchange::Buffer<CellSums>(cells * chunks_of(stride));
}
LaplacianScratch::~LaplacianScratch() = default;
LaplacianScratch::LaplacianScratch(LaplacianScratch&&) noexcept = default;
LaplacianScratch& LaplacianScratch::operator=(LaplacianScratch&&) noexcept = default;

void laplacian_pass(const ForceView& view, const LaplacianView& laplacian, LaplacianScratch& scratch) {
    const std::size_t chunks = chunks_of(view.stride);
    CellSums* partial = scratch.memory_->partial.data();
    exchange::for_each_index(view.cells * chunks, LaplacianTask<exchange::Pack>{view, laplacian, partial},
                             cost_of(view));
    scratch.memory_->reduction.sum_segments(view.cells, chunks, PartialSum{partial, chunks}, laplacian.sums);
}

void laplacian_force_pass(const ForceView& view, const LaplacianView& laplacian) {
    exchange::for_each_index(view.cells * chunks_of(view.stride),
                             LaplacianForceTask<exchange::Pack>{view, laplacian}, cost_of(view));
}

}  // namespace hemoflux::membrane
