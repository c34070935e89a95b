/// What both arrangements of the residual (tiles of rows, single cells) share.
#pragma once

#include "exchange/pack.hpp"
#include "fluid/face.hpp"

namespace hemoflux::fluid {

/// Geometry, state and where R goes; the body force in the balance of a cell and prescribed mass fluxes.
template <class F, class Real = double>
struct Balance {
    GridView grid;
    BasicStateView<Real> state;
    BoundaryView boundary;
    FlowParameters parameters;
    BasicResidualView<Real> out;
    double inv_gamma;

    template <class Value, int Axis>
    HEMOFLUX_INLINE FaceLoader<F, Value, Axis> loader() const {
        return {grid, state, parameters, inv_gamma};
    }

    /// Replaces the mass flux on a border face whose normal velocity is given. face: index of the cell below
    /// the face; a, b: the other two indices in ascending order of their axes.
    template <class Value, int Axis>
    HEMOFLUX_INLINE void prescribe_mass(Quad<Value>& q, std::ptrdiff_t face, std::ptrdiff_t a,
                                        std::ptrdiff_t b) const {
        const auto n = static_cast<std::ptrdiff_t>(grid.layout.n[Axis]);
        if (face != -1 && face != n - 1) return;
        const MassFluxView& m = boundary.mass_flux[2 * Axis + (face == -1 ? 0 : 1)];
        if (!m.value) return;
        const double* value = m.value + static_cast<std::ptrdiff_t>(m.pitch) * b + a;
        if constexpr (!exchange::is_single<Value>)
            q.c[0] = exchange::load<Value>(value);
        else
            q.c[0] = narrow<Value>(value);
    }

    /// Doubles from p on, rounded to single precision.
    template <class Value>
    HEMOFLUX_INLINE static Value narrow(const double* p) {
        float rounded[exchange::lanes<Value>];
        for (std::size_t l = 0; l < exchange::lanes<Value>; ++l) rounded[l] = static_cast<float>(p[l]);
        return exchange::load<Value>(rounded);
    }

    /// Body force per volume (component c - 1) in the cells at `at`, as it enters R.
    template <class Value>
    HEMOFLUX_INLINE Value source(std::size_t at, int c) const {
        Value f = exchange::load<Value>(state.force[c - 1] + at) + parameters.uniform_force[c - 1];
        if constexpr (F::preconditioned) f = f * inv_gamma;
        return f;
    }
};

}  // namespace hemoflux::fluid
