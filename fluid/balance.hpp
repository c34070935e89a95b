/// Balance of one cell, or of a pack of cells along x: face fluxes in, rate of change out (2.3).
#pragma once

#include "exchange/pack.hpp"
#include "fluid/face.hpp"

namespace hemoflux::fluid {

/// What both arrangements of the residual (tiles of rows, single cells) share: fluxes, prescribed mass fluxes
/// on border faces, and the sum over a cell's faces.
template <class F>
struct Balance {
    GridView grid;
    StateView state;
    BoundaryView boundary;
    FlowParameters parameters;
    ResidualView out;
    double inv_gamma;

    template <class Value, int Axis>
    HEMOFLUX_INLINE Quad<Value> flux(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        const FaceLoader<F, Value, Axis> loader{grid, state, parameters, inv_gamma};
        const std::ptrdiff_t ijk[3] = {i, j, k};
        Quad<Value> q = loader.flux(grid.layout.at(i, j, k), ijk);
        return q;
    }

    /// Replaces the mass flux on a border face whose normal velocity is given. face: index of the cell below
    /// the face.
    template <class Value, int Axis>
    HEMOFLUX_INLINE void prescribe_mass(Quad<Value>& q, std::ptrdiff_t face, std::ptrdiff_t a,
                                        std::ptrdiff_t b) const {
        const auto n = static_cast<std::ptrdiff_t>(grid.layout.n[Axis]);
        if (face != -1 && face != n - 1) return;
        const MassFluxView& m = boundary.mass_flux[2 * Axis + (face == -1 ? 0 : 1)];
        if (m.value) q.c[0] = exchange::load<Value>(m.value + static_cast<std::ptrdiff_t>(m.pitch) * b + a);
    }

    /// R of the cells at (i, j, k) from their six face fluxes.
    template <class Value>
    HEMOFLUX_INLINE void write(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k, std::ptrdiff_t count,
                               const Quad<Value>& xl, const Quad<Value>& xr, const Quad<Value>& yl,
                               const Quad<Value>& yr, const Quad<Value>& zl, const Quad<Value>& zr) const {
        const Value inv_dx =
            F::uniform ? Value(grid.axis[0].inverse[0]) : exchange::load<Value>(grid.axis[0].inverse + i);
        const double inv_dy = grid.axis[1].inverse[j], inv_dz = grid.axis[2].inverse[k];
        const std::size_t at = grid.layout.at(i, j, k);
        for (int c = 0; c < 4; ++c) {
            Value r =
                (xl.c[c] - xr.c[c]) * inv_dx + (yl.c[c] - yr.c[c]) * inv_dy + (zl.c[c] - zr.c[c]) * inv_dz;
            if constexpr (F::force) {
                if (c > 0) {
                    Value f =
                        exchange::load<Value>(state.force[c - 1] + at) + parameters.uniform_force[c - 1];
                    if constexpr (F::preconditioned) f = f * inv_gamma;
                    r = r + f;
                }
            }
            exchange::store_first(out.r[c] + at, r, count);
        }
    }
};

}  // namespace hemoflux::fluid
