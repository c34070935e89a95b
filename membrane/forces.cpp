#include "membrane/forces.hpp"

#include "exchange/buffer.hpp"
#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "exchange/vec3.hpp"
#include "membrane/area.hpp"
#include "membrane/bending.hpp"
#include "membrane/volume.hpp"

namespace hemoflux::membrane {
namespace {

using exchange::load, exchange::select, exchange::square_root, exchange::store;

/// Vertices of one task: enough to share among threads, and one per CUDA thread.
constexpr std::size_t chunk_vertices = exchange::on_gpu ? 1 : 128;

constexpr std::size_t chunks_of(std::size_t stride) { return (stride + chunk_vertices - 1) / chunk_vertices; }

template <class Value>
HEMOFLUX_INLINE Vec3<Value> load_position(const ForceView& w, std::size_t i) {
    return {load<Value>(w.x + i), load<Value>(w.y + i), load<Value>(w.z + i)};
}

template <class Value>
HEMOFLUX_INLINE Vec3<Value> gather_position(const ForceView& w, std::size_t cell, const int* index) {
    const std::size_t base = cell * w.stride;
    return {exchange::gather<Value>(w.x + base, index), exchange::gather<Value>(w.y + base, index),
            exchange::gather<Value>(w.z + base, index)};
}

template <class Mask, class Value>
HEMOFLUX_INLINE Vec3<Value> select3(const Mask& m, const Vec3<Value>& yes, const Vec3<Value>& no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}

/// The sums of pass 1, lane by lane.
template <class Value>
struct LaneSums {
    Value volume = 0.0, area = 0.0, total_curvature = 0.0, local_area = 0.0, helfrich = 0.0, shear = 0.0,
          overstretched = 0.0;
};

/// Pass 1 for one chunk of vertices of one cell.
template <class Value>
struct CurvatureTask {
    ForceView w;
    CellSums* partial;

    /// One ring edge `e`, between its left triangle xi_a (third vertex at to_opposite) and its right one
    /// xi_b: stores theta/L and tension/L, returns theta L.
    template <class Mask>
    HEMOFLUX_INLINE Value edge(std::size_t row, std::size_t out, const Mask& inside, const Vec3<Value>& e,
                               const Vec3<Value>& to_opposite, const Vec3<Value>& xi_a,
                               const Vec3<Value>& xi_b, LaneSums<Value>& sums) const {
        const Value length = square_root(dot(e, e));
        const Value theta = edge_angle(length, to_opposite, xi_a, xi_b);
        const Value contour = load<Value>(w.contour + row), l = length * load<Value>(w.inverse_contour + row);
        const Value free = 1.0 - l, shared = 1.0 / (length * free);
        const Value inverse_length = free * shared, inverse_free = length * shared;
        store(w.bend + out, theta * inverse_length);
        store(w.spring + out, w.chain.tension(l, inverse_free, contour) * inverse_length);
        const Value zero(0.0), one(1.0);
        sums.shear += select(inside, w.chain.energy(l, inverse_free, contour), zero);
        sums.overstretched += select(inside, select(l < one, zero, one), zero);
        return select(inside, theta * length, zero);
    }

    HEMOFLUX_INLINE void vertices(std::size_t cell, std::size_t v, LaneSums<Value>& sums) const {
        const std::size_t here = cell * w.stride + v;
        const std::size_t degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
        const Value degree = load<Value>(w.degree + v), zero(0.0);
        const Vec3<Value> r = load_position<Value>(w, here);
        const Vec3<Value> first = gather_position<Value>(w, cell, w.neighbour + v) - r;
        Vec3<Value> d = first, second = first, xi_first{zero, zero, zero}, xi_before = xi_first,
                    normal = xi_first;
        Value area = zero, curvature = zero;
        for (std::size_t i = 0; i < degrees; ++i) {
            const auto inside = Value(static_cast<double>(i)) < degree;
            const std::size_t row = i * w.stride + v, out = cell * w.slots * w.stride + row;
            const Vec3<Value> next =
                gather_position<Value>(w, cell, w.neighbour + (i + 1) * w.stride + v) - r;
            // Beyond the ring of a vertex of lower degree its last triangle is carried on to edge 0.
            const Vec3<Value> xi = select3(inside, cross(d, next), xi_before);
            const Value size = square_root(dot(xi, xi));
            const Value a = select(inside, 0.5 * size, zero);
            store(w.inverse_normal + out, 1.0 / size);
            area += a;
            const Value strain = a * load<Value>(w.inverse_area0 + row) - 1.0;
            sums.local_area += select(
                inside, local_area_energy<Value>(w.k_local_area, strain, load<Value>(w.area0 + row)), zero);
            normal += select3(inside, xi, {zero, zero, zero});
            if (i == 0) {
                second = next;
                xi_first = xi;
            } else {
                curvature += edge(row, out, inside, d, next, xi, xi_before, sums);
            }
            d = next;
            xi_before = xi;
        }
        const auto real = zero < degree;
        curvature += edge(v, cell * w.slots * w.stride + v, real, first, second, xi_first, xi_before, sums);
        area *= 1.0 / 3;
        curvature *= 0.5;
        const Value c = curvature / area;
        store(w.by_curvature + here, helfrich_by_curvature<Value>(w.k_bending, c, w.curvature0));
        store(w.by_area + here, helfrich_by_area<Value>(w.k_bending, c, w.curvature0));
        sums.helfrich += select(real, helfrich_energy<Value>(w.k_bending, area, c, w.curvature0), zero);
        sums.area += area;
        sums.total_curvature += curvature;
        const std::size_t o = cell * w.stride;
        const Vec3<Value> origin{Value(w.x[o]), Value(w.y[o]), Value(w.z[o])};
        sums.volume += select(real, dot(r - origin, normal), zero);
    }

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const std::size_t chunks = chunks_of(w.stride), cell = task / chunks;
        const std::size_t first = task % chunks * chunk_vertices;
        const std::size_t last = first + chunk_vertices < w.stride ? first + chunk_vertices : w.stride;
        LaneSums<Value> s;
        for (std::size_t v = first; v < last; v += exchange::lanes<Value>) vertices(cell, v, s);
        CellSums& p = partial[task];
        // Every triangle was met at three corners, every edge at two ends.
        p.volume = exchange::lane_sum(s.volume) / 18;
        p.area = exchange::lane_sum(s.area);
        p.total_curvature = exchange::lane_sum(s.total_curvature);
        p.local_area_energy = exchange::lane_sum(s.local_area) / 3;
        p.helfrich_energy = exchange::lane_sum(s.helfrich);
        p.shear_energy = exchange::lane_sum(s.shear) / 2;
        p.overstretched = exchange::lane_sum(s.overstretched);
    }
};

/// Pass 2 for one chunk of vertices of one cell.
template <class Value>
struct ForceTask {
    ForceView w;

    HEMOFLUX_INLINE void vertices(std::size_t cell, std::size_t v, double pressure, double tension,
                                  double by_total_curvature) const {
        const std::size_t base = cell * w.stride, here = base + v;
        const std::size_t degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
        const Value degree = load<Value>(w.degree + v), zero(0.0);
        const Vec3<Value> r = load_position<Value>(w, here);
        Vec3<Value> d = gather_position<Value>(w, cell, w.neighbour + v) - r, gradient{zero, zero, zero};
        const Value s = load<Value>(w.by_curvature + here), q = load<Value>(w.by_area + here);
        Value s_d = exchange::gather<Value>(w.by_curvature + base, w.neighbour + v);
        Value q_d = exchange::gather<Value>(w.by_area + base, w.neighbour + v);
        for (std::size_t i = 0; i < degrees; ++i) {
            const auto inside = Value(static_cast<double>(i)) < degree;
            const std::size_t row = i * w.stride + v, in = cell * w.slots * w.stride + row;
            const int* index = w.neighbour + (i + 1) * w.stride + v;
            const Vec3<Value> next = gather_position<Value>(w, cell, index) - r, rim = next - d;
            const Value s_next = exchange::gather<Value>(w.by_curvature + base, index);
            const Value q_next = exchange::gather<Value>(w.by_area + base, index);
            const Vec3<Value> xi = cross(d, next);
            const Value inverse = load<Value>(w.inverse_normal + in), size2 = dot(xi, xi);
            // u_d and u_next of bending.hpp.
            const Value u_d = -dot(d, rim), u_next = dot(next, rim);
            const Value along_xi =
                pressure / 6 + 0.5 * inverse * inverse * ((s - s_next) * u_d + (s - s_d) * u_next);
            const Value strain = 0.5 * size2 * inverse * load<Value>(w.inverse_area0 + row) - 1.0;
            const Value in_plane = 0.5 * inverse *
                                   (tension + local_area_tension<Value>(w.k_local_area, strain) +
                                    (q + q_d + q_next) * (1.0 / 3));
            const Value weight = 0.5 * (s + s_d) + by_total_curvature;
            const Value along_d = weight * load<Value>(w.bend + in) + load<Value>(w.spring + in);
            gradient += select(inside, along_xi, zero) * xi;
            gradient += select(inside, in_plane, zero) * cross(xi, rim);
            gradient -= select(inside, along_d, zero) * d;
            d = next;
            s_d = s_next;
            q_d = q_next;
        }
        const auto real = zero < degree;
        store(w.fx + here, select(real, -gradient.x, zero));
        store(w.fy + here, select(real, -gradient.y, zero));
        store(w.fz + here, select(real, -gradient.z, zero));
    }

    HEMOFLUX_FN void operator()(std::size_t task) const {
        const std::size_t chunks = chunks_of(w.stride), cell = task / chunks;
        const std::size_t first = task % chunks * chunk_vertices;
        const std::size_t last = first + chunk_vertices < w.stride ? first + chunk_vertices : w.stride;
        const CellSums& sums = w.sums[cell];
        const double pressure = volume_pressure(w.k_volume, sums.volume, w.volume0);
        const double tension = area_tension(w.k_area, sums.area, w.total_area0);
        const double by_total_curvature = area_difference_by_curvature(
            w.k_area_difference, sums.total_curvature, w.total_curvature0, w.total_area0);
        for (std::size_t v = first; v < last; v += exchange::lanes<Value>)
            vertices(cell, v, pressure, tension, by_total_curvature);
    }
};

/// Batches of one small cell stay on one thread: waking the others takes longer than the work.
exchange::Cost cost_of(const ForceView& w) {
    constexpr std::size_t worth_sharing = 1024;
    return w.cells * w.stride < worth_sharing ? exchange::Cost::cheap : exchange::Cost::heavy;
}

/// Reads the partial sums of one cell.
struct PartialSum {
    const CellSums* partial;
    std::size_t chunks;
    HEMOFLUX_FN const CellSums& operator()(std::size_t cell, std::size_t chunk) const {
        return partial[cell * chunks + chunk];
    }
};

}  // namespace

struct ForceScratch::Memory {
    exchange::Buffer<CellSums> partial;
    exchange::Reduction<CellSums> reduction;
};

ForceScratch::ForceScratch(std::size_t cells, std::size_t stride) : memory_(std::make_unique<Memory>()) {
    memory_->partial = exchange::Buffer<CellSums>(cells * chunks_of(stride));
}
ForceScratch::~ForceScratch() = default;
ForceScratch::ForceScratch(ForceScratch&&) noexcept = default;
ForceScratch& ForceScratch::operator=(ForceScratch&&) noexcept = default;

void curvature_pass(const ForceView& view, ForceScratch& scratch) {
    const std::size_t chunks = chunks_of(view.stride);
    CellSums* partial = scratch.memory_->partial.data();
    exchange::for_each_index(view.cells * chunks, CurvatureTask<exchange::Pack>{view, partial},
                             cost_of(view));
    scratch.memory_->reduction.sum_segments(view.cells, chunks, PartialSum{partial, chunks}, view.sums);
}

void force_pass(const ForceView& view) {
    exchange::for_each_index(view.cells * chunks_of(view.stride), ForceTask<exchange::Pack>{view},
                             cost_of(view));
}

}  // namespace hemoflux::membrane
