/// Pass 1 of the forces: the kernel over the rings of a chunk of vertices. Only kernel sources include it.
#pragma once

#include "membrane/area.hpp"
#include "membrane/bending.hpp"
#include "membrane/in_plane.hpp"
#include "membrane/ring_kernels.hpp"

namespace hemoflux::membrane {

/// The sums of pass 1, lane by lane.
template <class Value>
struct LaneSums {
    Value volume = 0.0, area = 0.0, total_curvature = 0.0, local_area = 0.0, helfrich = 0.0, shear = 0.0,
          strain = 0.0, overstretched = 0.0;
};

/// What a continuum triangle (vertex, n_i, n_{i+1}) pulls with along its edges to n_i and n_{i+1}, over L.
template <class Value>
struct EdgePulls {
    Value first = 0.0, second = 0.0;
};

/// Pass 1 for one chunk of vertices of one cell; Law is one of in_plane.hpp.
template <class Value, class Law>
struct CurvatureTask {
    ForceView w;
    Law law;
    CellSums* partial;

    /// In-plane law of ring triangle (vertex, n_i, n_{i+1}) of area a, its neighbours at d and next: stores
    /// dE/dA_k, adds the energy, returns what it pulls with along its edges.
    template <class Mask>
    HEMOFLUX_INLINE EdgePulls<Value> triangle(std::size_t row, std::size_t out, const Mask& inside,
                                              const Vec3<Value>& d, const Vec3<Value>& next, const Value& a,
                                              LaneSums<Value>& sums) const {
        const Value zero(0.0);
        if constexpr (Law::continuum) {
            const Vec3<Value> rim = next - d;
            const Value inverse = load<Value>(w.inverse_rest_area + row);
            const Value first = load<Value>(w.cot_first + row), second = load<Value>(w.cot_second + row);
            const Value i = 0.5 * inverse *
                            (load<Value>(w.cot_here + row) * dot(rim, rim) + first * dot(next, next) +
                             second * dot(d, d));
            const auto strain = law.material(i, select(inside, a * inverse, Value(1.0)));
            store(w.triangle_tension + out, strain.by_j);
            sums.strain += select(inside, load<Value>(w.rest_area + row) * strain.density, zero);
            sums.overstretched += select(inside, select(i < 1e30, zero, Value(1.0)), zero);
            return {strain.by_i * second, strain.by_i * first};
        } else if constexpr (Law::triangles) {
            const Value ratio = select(inside, a * load<Value>(w.inverse_area0 + row), Value(1.0));
            store(w.triangle_tension + out, law.hydrostatic.area_tension(ratio));
            sums.strain +=
                select(inside, law.hydrostatic.area_energy(ratio, load<Value>(w.area0 + row)), zero);
        }
        return {};
    }

    /// One ring edge `e`, between its left triangle xi_a (third vertex at to_opposite) and its right one
    /// xi_b: stores theta/L and tension/L (continuum laws: `pull`), returns theta L.
    template <class Mask>
    HEMOFLUX_INLINE Value edge(std::size_t row, std::size_t out, const Mask& inside, const Vec3<Value>& e,
                               const Vec3<Value>& to_opposite, const Vec3<Value>& xi_a,
                               const Vec3<Value>& xi_b, const Value& pull, LaneSums<Value>& sums) const {
        const Value length = square_root(dot(e, e));
        const Value theta = edge_angle(length, to_opposite, xi_a, xi_b);
        if constexpr (Law::continuum) {
            store(w.bend + out, theta / length);
            store(w.spring + out, pull);
            return select(inside, theta * length, Value(0.0));
        } else {
            return spring(row, out, inside, length, theta, sums);
        }
    }

    /// The spring of an edge of this length and angle; stores and returns as edge().
    template <class Mask>
    HEMOFLUX_INLINE Value spring(std::size_t row, std::size_t out, const Mask& inside, const Value& length,
                                 const Value& theta, LaneSums<Value>& sums) const {
        const Value contour = load<Value>(w.contour + row), l = length * load<Value>(w.inverse_contour + row);
        const Value free = 1.0 - l, shared = 1.0 / (length * free);
        const Value inverse_length = free * shared, inverse_free = length * shared;
        store(w.bend + out, theta * inverse_length);
        store(w.spring + out, law.chain.tension(l, inverse_free, contour) * inverse_length);
        const Value zero(0.0), one(1.0);
        sums.shear += select(inside, law.chain.energy(l, inverse_free, contour), zero);
        sums.overstretched += select(inside, select(l < one, zero, one), zero);
        return select(inside, theta * length, zero);
    }

    /// One pack of vertices, from number v of the cell on: stores dE/dS and dE/dA, adds to the sums.
    HEMOFLUX_INLINE void vertices(std::size_t cell, std::size_t v, LaneSums<Value>& sums) const {
        const std::size_t here = cell * w.stride + v;
        const std::size_t degrees = static_cast<std::size_t>(w.group_degree[v / exchange::row_alignment]);
        const Value degree = load<Value>(w.degree + v), zero(0.0);
        const Vec3<Value> r = load_position<Value>(w, here);
        const Vec3<Value> first = gather_position<Value>(w, cell, w.neighbour + v) - r;
        Vec3<Value> d = first, second = first, xi_first{zero, zero, zero}, xi_before = xi_first,
                    normal = xi_first;
        EdgePulls<Value> before, first_pulls;
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
            const EdgePulls<Value> pulls = triangle(row, out, inside, d, next, a, sums);
            if (i == 0) {
                second = next;
                xi_first = xi;
                first_pulls = pulls;
            } else {
                curvature +=
                    edge(row, out, inside, d, next, xi, xi_before, before.second + pulls.first, sums);
            }
            if constexpr (Law::continuum) before.second = select(inside, pulls.second, before.second);
            d = next;
            xi_before = xi;
        }
        const auto real = zero < degree;
        curvature += edge(v, cell * w.slots * w.stride + v, real, first, second, xi_first, xi_before,
                          before.second + first_pulls.first, sums);
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
        const Chunk chunk = chunk_of(task, w.stride);
        LaneSums<Value> s;
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>)
            vertices(chunk.cell, v, s);
        CellSums& p = partial[task];
        // Every triangle was met at three corners, every edge at two ends.
        p.volume = exchange::lane_sum(s.volume) / 18;
        p.area = exchange::lane_sum(s.area);
        p.total_curvature = exchange::lane_sum(s.total_curvature);
        p.local_area_energy = exchange::lane_sum(s.local_area) / 3;
        p.helfrich_energy = exchange::lane_sum(s.helfrich);
        p.shear_energy = exchange::lane_sum(s.shear) / 2 + exchange::lane_sum(s.strain) / 3;
        p.overstretched = exchange::lane_sum(s.overstretched);
    }
};

}  // namespace hemoflux::membrane
