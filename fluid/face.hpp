/// What a face of a rectilinear grid needs besides the values of its two cells: lengths, viscosity, force; and
/// for the cell-by-cell residual those values and gradients, loaded from the padded fields.
#pragma once

#include "exchange/pack.hpp"
#include "fluid/flux.hpp"
#include "fluid/grid.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Compile-time variants of the residual, so that a run pays only for what it uses. Cubic: GridView::delta is
/// set.
template <bool Cubic, bool Viscosity, bool Force, bool Preconditioned>
struct Features {
    static constexpr bool cubic = Cubic, viscosity = Viscosity, force = Force,
                          preconditioned = Preconditioned;
};

/// Faces normal to one axis, known at compile time: normal n = Axis, tangents the next two, cyclically.
template <class F, class Value, int Axis>
struct FaceLoader {
    static constexpr int n = Axis, t1 = (Axis + 1) % 3, t2 = (Axis + 2) % 3;
    /// Components of the state, of which the vector's run n, t1, t2.
    HEMOFLUX_INLINE static constexpr int field(int c) { return c == 0 ? 0 : 1 + (c - 1 + Axis) % 3; }

    const GridView& grid;
    const BasicStateView<exchange::Scalar<Value>>& state;
    const FlowParameters& parameters;
    double inv_gamma;

    /// Distance in memory between neighbours along an axis.
    HEMOFLUX_INLINE std::ptrdiff_t stride(int axis) const {
        return axis == 0 ? 1 : static_cast<std::ptrdiff_t>(axis == 1 ? grid.layout.row : grid.layout.plane);
    }

    /// A 1-D quantity at index i of an axis: a pack along x (where lanes run), the same for all lanes
    /// elsewhere.
    HEMOFLUX_INLINE static Value along(int axis, const double* values, std::ptrdiff_t i) {
        return axis == 0 ? exchange::load<Value>(values + i) : Value(values[i]);
    }

    /// Lengths at the upper face of the cell ijk.
    HEMOFLUX_INLINE FaceGeometry<Value> geometry(const std::ptrdiff_t (&ijk)[3]) const {
        const AxisView& a = grid.axis[n];
        using exchange::maximum;
        using exchange::minimum;
        return {
            along(n, a.half, ijk[n]), along(n, a.half, ijk[n] + 1), along(n, a.weight_left, ijk[n]),
            minimum(along(n, a.normal, ijk[n]), minimum(along(t1, grid.axis[t1].lateral, ijk[t1]),
                                                        along(t2, grid.axis[t2].lateral, ijk[t2]))),
            maximum(along(n, a.inv_normal, ijk[n]), maximum(along(t1, grid.axis[t1].inv_lateral, ijk[t1]),
                                                            along(t2, grid.axis[t2].inv_lateral, ijk[t2])))};
    }

    /// Viscosity on the face between the cells at `left` and `right`.
    HEMOFLUX_INLINE Value viscosity(std::size_t left, std::size_t right) const {
        if constexpr (F::viscosity)
            return 0.5 * (exchange::load<Value>(state.nu + left) + exchange::load<Value>(state.nu + right));
        else
            return Value(exchange::Scalar<Value>(parameters.nu));
    }

    /// Body force per volume on the face (n, t1, t2), divided by gamma, times `scale`.
    HEMOFLUX_INLINE void body_force(std::size_t left, std::size_t right, const Value& weight_left,
                                    const Value& scale, Value (&force)[3]) const {
        if constexpr (F::force) {
            for (int c = 0; c < 3; ++c) {
                const int component = field(c + 1) - 1;
                const double* f = state.force[component];
                force[c] = weight_left * exchange::load<Value>(f + left) +
                           (1.0 - weight_left) * exchange::load<Value>(f + right) +
                           parameters.uniform_force[component];
                force[c] = force[c] * scale;
                if constexpr (F::preconditioned) force[c] = force[c] * inv_gamma;
            }
        }
    }

    /// Gradient along one axis of the field p points into, at index i of that axis.
    HEMOFLUX_INLINE Value gradient(const double* p, int axis, std::ptrdiff_t i) const {
        const Value here = exchange::load<Value>(p), up = exchange::load<Value>(p + stride(axis)),
                    down = exchange::load<Value>(p - stride(axis));
        return along(axis, grid.axis[axis].plus, i) * (up - here) +
               along(axis, grid.axis[axis].minus, i) * (here - down);
    }

    /// Values and gradients of the cell ijk, which lies at `at`, along n, t1, t2.
    HEMOFLUX_INLINE FaceSide<Value> side(std::size_t at, const std::ptrdiff_t (&ijk)[3]) const {
        FaceSide<Value> s;
        for (int c = 0; c < 4; ++c) {
            const double* p = state.q[field(c)] + at;
            s.phi[c] = exchange::load<Value>(p);
            s.n[c] = gradient(p, n, ijk[n]);
            s.t1[c] = gradient(p, t1, ijk[t1]);
            s.t2[c] = gradient(p, t2, ijk[t2]);
        }
        return s;
    }

    /// From components along n, t1, t2 back to x, y, z.
    HEMOFLUX_INLINE static Quad<Value> back(const Quad<Value>& q) {
        Quad<Value> xyz;
        for (int c = 0; c < 4; ++c) xyz.c[field(c)] = q.c[c];
        return xyz;
    }

    /// Flux through the upper face of the cell ijk, which lies at `left`, from the two cells' values.
    HEMOFLUX_INLINE Quad<Value> flux(const FaceSide<Value>& of_left, const FaceSide<Value>& of_right,
                                     std::size_t left, const std::ptrdiff_t (&ijk)[3]) const {
        const std::size_t right = left + static_cast<std::size_t>(stride(n));
        const FaceGeometry<Value> face = geometry(ijk);
        Value force[3] = {};
        body_force(left, right, face.weight_left, Value(1), force);
        return back(face_flux<F::force, F::preconditioned>(of_left, of_right, face, viscosity(left, right),
                                                           force, inv_gamma));
    }

    /// The same with the values loaded.
    HEMOFLUX_INLINE Quad<Value> flux(std::size_t left, const std::ptrdiff_t (&ijk)[3]) const {
        std::ptrdiff_t next[3] = {ijk[0], ijk[1], ijk[2]};
        ++next[n];
        return flux(side(left, ijk), side(left + static_cast<std::size_t>(stride(n)), next), left, ijk);
    }
};

}  // namespace hemoflux::fluid
