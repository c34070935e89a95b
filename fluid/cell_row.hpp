/// What the six faces of a cell share, computed once per cell and kept for a piece of one x row while the
/// faces around it are summed.
///
/// Cubic cells of width 2 delta: the change of every value over delta along x, y and z,
///   D = delta dphi/dx = (phi_{i+1} - phi_{i-1}) / 4,
/// and the scalar products of the velocity a and its changes. The nodes of any face are then sums of these.
/// Cells of other widths have another delta on every face; they keep their gradients.
#pragma once

#include "fluid/face.hpp"

namespace hemoflux::fluid {

/// Longest piece of an x row.
constexpr std::size_t max_segment = 128;

/// Arrays over the cells i0 - 1 .. i1 of a row piece i0 .. i1 - 1.
template <class F, class Real>
struct CellRow {
    /// Changes or gradients of the four fields along three axes; then a.a, a.D (3), for the faces normal to
    /// each axis the sum D.D of both tangents (3), and D.D of one tangent with the other (3).
    static constexpr std::size_t changes = 0, square = 12, mixed = 13, squares = 16, cross = 19;
    static constexpr std::size_t arrays = F::cubic ? 22 : 12;
    static constexpr std::size_t pad = 64 / sizeof(Real), pitch = max_segment + 2 * pad;

    alignas(64) Real values[arrays][pitch];

    /// Values of one array from cell i0 + offset on.
    template <class Value>
    HEMOFLUX_INLINE Value get(std::size_t array, std::ptrdiff_t offset) const {
        return exchange::load<Value>(values[array] + static_cast<std::ptrdiff_t>(pad) + offset);
    }
    template <class Value>
    HEMOFLUX_INLINE void set(std::size_t array, std::ptrdiff_t offset, const Value& v) {
        exchange::store(values[array] + static_cast<std::ptrdiff_t>(pad) + offset, v);
    }

    /// Computes the cells from i on (i - i0 = offset), which lie at `at`.
    template <class Value>
    HEMOFLUX_INLINE void compute(const GridView& grid, const BasicStateView<Real>& state, double inv_gamma,
                                 std::ptrdiff_t offset, std::size_t at, const std::ptrdiff_t (&ijk)[3]) {
        if constexpr (F::cubic)
            compute_cubic<Value>(grid, state, inv_gamma, offset, at);
        else
            compute_gradients<Value>(grid, state, offset, at, ijk);
    }

    /// Flux through the upper face along Axis of the cell ijk at `left`; the cell is at `offset` in the row
    /// low, its neighbour at `offset` (x: offset + 1) in the row high.
    template <class Value, int Axis>
    HEMOFLUX_INLINE static Quad<Value> flux(const FaceLoader<F, Value, Axis>& loader, const CellRow& low,
                                            const CellRow& high, std::ptrdiff_t offset, std::size_t left,
                                            const std::ptrdiff_t (&ijk)[3]) {
        const std::size_t right = left + static_cast<std::size_t>(loader.stride(Axis));
        const std::ptrdiff_t next = Axis == 0 ? offset + 1 : offset;
        if constexpr (F::cubic) {
            using R = exchange::Scalar<Value>;
            SideNodes<Value> l, r;
            PlaneNodes<Value> plane;
            low.template load_nodes<Value, Axis>(loader.state, offset, left, l);
            high.template load_nodes<Value, Axis>(loader.state, next, right, r);
            for (int c = 0; c < 4; ++c) {
                const auto normal = static_cast<std::size_t>(4 * Axis + loader.field(c));
                plane.c[c] = (l.a[c] + r.a[c]) + (low.template get<Value>(normal, offset) -
                                                  high.template get<Value>(normal, next));
                plane.m1[c] = l.d1[c] + r.d1[c];
                plane.m2[c] = l.d2[c] + r.d2[c];
            }
            const double per_nu = 3 * inv_gamma_of(loader) / loader.grid.delta;
            Value impulse[3] = {};
            loader.body_force(left, right, Value(R(0.5)), Value(R(loader.grid.delta)), impulse);
            return loader.back(flux_of_nodes<F::force, F::preconditioned>(
                l, low.template load_products<Value, Axis>(offset), r,
                high.template load_products<Value, Axis>(next), plane,
                Value(R(per_nu) * loader.viscosity(left, right)), impulse, loader.inv_gamma));
        } else {
            return loader.flux(low.template load_side<Value, Axis>(loader.state, offset, left),
                               high.template load_side<Value, Axis>(loader.state, next, right), left, ijk);
        }
    }

  private:
    template <class Loader>
    HEMOFLUX_INLINE static double inv_gamma_of(const Loader& loader) {
        return F::preconditioned ? loader.inv_gamma : 1.0;
    }

    /// Asks for the next row of the plane above, which the next row's gradients will be the first to touch:
    /// rows are too short for the processor to foresee where the next one starts.
    template <class Value>
    HEMOFLUX_INLINE static void ahead(const GridView& grid, const Real* p) {
        if constexpr (exchange::lanes < Value >> 1)
            exchange::prefetch(p + grid.layout.plane + grid.layout.row);
    }

    template <class Value>
    HEMOFLUX_INLINE void compute_cubic(const GridView& grid, const BasicStateView<Real>& state,
                                       double inv_gamma, std::ptrdiff_t offset, std::size_t at) {
        using R = exchange::Scalar<Value>;
        const std::ptrdiff_t stride[3] = {1, static_cast<std::ptrdiff_t>(grid.layout.row),
                                          static_cast<std::ptrdiff_t>(grid.layout.plane)};
        Value a[4], d[3][4];
        for (std::size_t f = 0; f < 4; ++f) {
            const auto* p = state.q[f] + at;
            if (f > 0) a[f] = exchange::load<Value>(p);
            ahead<Value>(grid, p);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                d[axis][f] = R(0.25) * (exchange::load<Value>(p + stride[axis]) -
                                        exchange::load<Value>(p - stride[axis]));
                set(changes + 4 * axis + f, offset, d[axis][f]);
            }
        }
        const R scale = F::preconditioned ? R(inv_gamma) : R(1);
        const auto product = [&](const Value(&x)[4], const Value(&y)[4]) {
            const Value xy = detail::dot(x, y);
            return F::preconditioned ? scale * xy : xy;
        };
        set(square, offset, product(a, a));
        const Value xx = product(d[0], d[0]), yy = product(d[1], d[1]), zz = product(d[2], d[2]);
        set(squares + 0, offset, yy + zz);
        set(squares + 1, offset, zz + xx);
        set(squares + 2, offset, xx + yy);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            set(mixed + axis, offset, product(a, d[axis]));
            set(cross + axis, offset, product(d[(axis + 1) % 3], d[(axis + 2) % 3]));
        }
    }

    template <class Value>
    HEMOFLUX_INLINE void compute_gradients(const GridView& grid, const BasicStateView<Real>& state,
                                           std::ptrdiff_t offset, std::size_t at,
                                           const std::ptrdiff_t (&ijk)[3]) {
        const FaceLoader<F, Value, 0> loader{grid, state, FlowParameters{}, 1};
        for (std::size_t f = 0; f < 4; ++f) {
            ahead<Value>(grid, state.q[f] + at);
            for (int axis = 0; axis < 3; ++axis)
                set(changes + 4 * static_cast<std::size_t>(axis) + f, offset,
                    loader.gradient(state.q[f] + at, axis, ijk[axis]));
        }
    }

    template <class Value, int Axis>
    HEMOFLUX_INLINE void load_nodes(const BasicStateView<Real>& state, std::ptrdiff_t offset, std::size_t at,
                                    SideNodes<Value>& s) const {
        using Face = FaceLoader<F, Value, Axis>;
        for (int c = 0; c < 4; ++c) {
            const int f = Face::field(c);
            s.a[c] = exchange::load<Value>(state.q[f] + at);
            s.d1[c] = get<Value>(static_cast<std::size_t>(4 * Face::t1 + f), offset);
            s.d2[c] = get<Value>(static_cast<std::size_t>(4 * Face::t2 + f), offset);
        }
    }

    template <class Value, int Axis>
    HEMOFLUX_INLINE SideProducts<Value> load_products(std::ptrdiff_t offset) const {
        using Face = FaceLoader<F, Value, Axis>;
        return {get<Value>(square, offset), get<Value>(mixed + Face::t1, offset),
                get<Value>(mixed + Face::t2, offset), get<Value>(squares + Axis, offset),
                get<Value>(cross + Axis, offset)};
    }

    template <class Value, int Axis>
    HEMOFLUX_INLINE FaceSide<Value> load_side(const BasicStateView<Real>& state, std::ptrdiff_t offset,
                                              std::size_t at) const {
        using Face = FaceLoader<F, Value, Axis>;
        FaceSide<Value> s;
        for (int c = 0; c < 4; ++c) {
            const int f = Face::field(c);
            s.phi[c] = exchange::load<Value>(state.q[f] + at);
            s.n[c] = get<Value>(static_cast<std::size_t>(4 * Face::n + f), offset);
            s.t1[c] = get<Value>(static_cast<std::size_t>(4 * Face::t1 + f), offset);
            s.t2[c] = get<Value>(static_cast<std::size_t>(4 * Face::t2 + f), offset);
        }
        return s;
    }
};

}  // namespace hemoflux::fluid
