/// Loads what a face of a rectilinear grid needs from the padded fields, and calls face_flux().
#pragma once

#include "exchange/pack.hpp"
#include "fluid/flux.hpp"
#include "fluid/grid.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Compile-time variants of the residual, so that a run pays only for what it uses.
template <bool Uniform, bool Viscosity, bool Force, bool Preconditioned>
struct Features {
    static constexpr bool uniform = Uniform, viscosity = Viscosity, force = Force,
                          preconditioned = Preconditioned;
};

/// 1-D gradient coefficients at one cell (or pack of cells) along one axis.
template <class Value>
struct Slope {
    Value plus, minus;
};

/// Everything a face needs, with the axis known at compile time: normal n = Axis, tangents the next two,
/// cyclically.
template <class F, class Value, int Axis>
struct FaceLoader {
    static constexpr int n = Axis, t1 = (Axis + 1) % 3, t2 = (Axis + 2) % 3;

    const GridView& grid;
    const StateView& state;
    const FlowParameters& parameters;
    double inv_gamma;

    HEMOFLUX_INLINE std::ptrdiff_t stride(int axis) const {
        return axis == 0 ? 1 : static_cast<std::ptrdiff_t>(axis == 1 ? grid.layout.row : grid.layout.plane);
    }

    /// A 1-D quantity at index i of an axis: a pack along x (where lanes run), the same for all lanes
    /// elsewhere.
    HEMOFLUX_INLINE Value along(int axis, const double* values, std::ptrdiff_t i) const {
        if (F::uniform) return Value(values[0]);
        return axis == 0 ? exchange::load<Value>(values + i) : Value(values[i]);
    }
    HEMOFLUX_INLINE Slope<Value> slope(int axis, std::ptrdiff_t i) const {
        return {along(axis, grid.axis[axis].plus, i), along(axis, grid.axis[axis].minus, i)};
    }

    HEMOFLUX_INLINE Value gradient(const double* p, std::ptrdiff_t s, const Value& here,
                                   const Slope<Value>& c) const {
        const Value up = exchange::load<Value>(p + s), down = exchange::load<Value>(p - s);
        if constexpr (F::uniform) return c.plus * (up - down);
        return c.plus * (up - here) + c.minus * (here - down);
    }

    HEMOFLUX_INLINE FaceSide<Value> side(std::size_t at, const Slope<Value>& cn, const Slope<Value>& c1,
                                         const Slope<Value>& c2) const {
        constexpr int field[4] = {0, 1 + n, 1 + t1, 1 + t2};
        FaceSide<Value> s;
        for (int c = 0; c < 4; ++c) {
            const double* p = state.q[field[c]] + at;
            s.phi[c] = exchange::load<Value>(p);
            s.n[c] = gradient(p, stride(n), s.phi[c], cn);
            s.t1[c] = gradient(p, stride(t1), s.phi[c], c1);
            s.t2[c] = gradient(p, stride(t2), s.phi[c], c2);
        }
        return s;
    }

    /// Flux through the face between the cell at `at` (indices ijk) and its upper neighbour along Axis.
    HEMOFLUX_INLINE Quad<Value> flux(std::size_t at, const std::ptrdiff_t (&ijk)[3]) const {
        const std::size_t right_at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + stride(n));
        const Slope<Value> c1 = slope(t1, ijk[t1]), c2 = slope(t2, ijk[t2]);
        const AxisView& a = grid.axis[n];
        FaceGeometry<Value> face;
        face.half_left = along(n, a.half, ijk[n]);
        face.half_right = along(n, a.half, ijk[n] + 1);
        face.weight_left = F::uniform ? Value(0.5) : along(n, a.weight_left, ijk[n]);
        using exchange::maximum;
        using exchange::minimum;
        face.delta = minimum(along(n, a.normal, ijk[n]), minimum(along(t1, grid.axis[t1].lateral, ijk[t1]),
                                                                 along(t2, grid.axis[t2].lateral, ijk[t2])));
        face.inv_delta =
            maximum(along(n, a.inv_normal, ijk[n]), maximum(along(t1, grid.axis[t1].inv_lateral, ijk[t1]),
                                                            along(t2, grid.axis[t2].inv_lateral, ijk[t2])));
        Value nu = Value(parameters.nu);
        if constexpr (F::viscosity)
            nu = 0.5 * (exchange::load<Value>(state.nu + at) + exchange::load<Value>(state.nu + right_at));
        Value force[3] = {Value(0.0), Value(0.0), Value(0.0)};
        if constexpr (F::force) {
            constexpr int component[3] = {n, t1, t2};
            for (int c = 0; c < 3; ++c) {
                const double* f = state.force[component[c]];
                force[c] = face.weight_left * exchange::load<Value>(f + at) +
                           (1.0 - face.weight_left) * exchange::load<Value>(f + right_at) +
                           parameters.uniform_force[component[c]];
                if constexpr (F::preconditioned) force[c] = force[c] * inv_gamma;
            }
        }
        const FaceSide<Value> left = side(at, slope(n, ijk[n]), c1, c2);
        const FaceSide<Value> right = side(right_at, slope(n, ijk[n] + 1), c1, c2);
        const Quad<Value> q = face_flux<F::force, F::preconditioned>(left, right, face, nu, force, inv_gamma);
        Quad<Value> xyz;  // back to mass, x, y, z
        xyz.c[0] = q.c[0];
        xyz.c[1 + n] = q.c[1];
        xyz.c[1 + t1] = q.c[2];
        xyz.c[1 + t2] = q.c[3];
        return xyz;
    }
};

}  // namespace hemoflux::fluid
