/// Pass 2 of the forces: the kernel over the rings of a chunk of vertices. Only kernel sources include it.
#pragma once

#include "membrane/area.hpp"
#include "membrane/bending.hpp"
#include "membrane/ring_kernels.hpp"
#include "membrane/volume.hpp"

namespace hemoflux::membrane {

/// Pass 2 for one chunk of vertices of one cell; `Triangles` for laws that pull on the triangles' areas.
template <class Value, bool Triangles>
struct ForceTask {
    ForceView w;

    /// One pack of vertices, from number v of the cell on. pressure, tension, by_total_curvature: dE/dV, dE/dA and
    /// dE/dM of the cell.
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
            Value surface =
                tension + local_area_tension<Value>(w.k_local_area, strain) + (q + q_d + q_next) * (1.0 / 3);
            if constexpr (Triangles) surface += load<Value>(w.triangle_tension + in);
            const Value in_plane = 0.5 * inverse * surface;
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
        const Chunk chunk = chunk_of(task, w.stride);
        const CellSums& sums = w.sums[chunk.cell];
        const double pressure = volume_pressure(w.k_volume, sums.volume, w.volume0);
        const double tension = area_tension(w.k_area, sums.area, w.total_area0) + w.linear_area;
        const double by_total_curvature =
            area_difference_by_curvature(w.k_area_difference, sums.total_curvature, w.total_curvature0,
                                         w.total_area0) +
            w.linear_curvature;
        for (std::size_t v = chunk.first; v < chunk.last; v += exchange::lanes<Value>)
            vertices(chunk.cell, v, pressure, tension, by_total_curvature);
    }
};

}  // namespace hemoflux::membrane
