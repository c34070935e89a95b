/// Loads what the faces of an unstructured grid need and calls flux_of_nodes() in the frame of each face.
#pragma once

#include "exchange/records.hpp"
#include "fluid/flux.hpp"
#include "fluid/hex_geometry.hpp"
#include "fluid/hex_residual.hpp"

namespace hemoflux::fluid {

/// Rows of the rotation into a face's frame.
template <class Value>
struct Rotation {
    Value n[3], t1[3], t2[3];

    /// Components of (x, y, z) along n, t1, t2.
    HEMOFLUX_INLINE void apply(Value& x, Value& y, Value& z) const {
        const Value a = n[0] * x + n[1] * y + n[2] * z, b = t1[0] * x + t1[1] * y + t1[2] * z,
                    c = t2[0] * x + t2[1] * y + t2[2] * z;
        x = a, y = b, z = c;
    }
    /// The vector with components (a, b, c) along n, t1, t2.
    HEMOFLUX_INLINE void invert(Value& a, Value& b, Value& c) const {
        const Value x = n[0] * a + t1[0] * b + t2[0] * c, y = n[1] * a + t1[1] * b + t2[1] * c,
                    z = n[2] * a + t1[2] * b + t2[2] * c;
        a = x, b = y, c = z;
    }
};

/// A pack of consecutive faces.
template <class Value>
struct HexFace {
    const HexView& grid;
    std::size_t first;

    /// Field k of the pack.
    HEMOFLUX_INLINE Value field(std::size_t k) const { return exchange::load<Value>(grid.field(first, k)); }

    /// Asks for the face data of a pack to come, one line a field.
    HEMOFLUX_INLINE void prefetch() const {
        if constexpr (exchange::lanes < Value >> 1)
            for (std::size_t k = 0; k < face_fields; ++k)
                exchange::prefetch(grid.field(first + 4 * face_block, k));
    }

    /// Into the frames of the faces.
    HEMOFLUX_INLINE Rotation<Value> rotation() const {
        Rotation<Value> r;
        for (std::size_t a = 0; a < 3; ++a) {
            r.n[a] = field(face_normal + a);
            r.t1[a] = field(face_tangent + a);
        }
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
            r.t2[a] = r.n[b] * r.t1[c] - r.n[c] * r.t1[b];
        }
        return r;
    }

    /// One side's nodes in the face's frame, and its values at the face's centre, in x, y, z. Sign: +1 left, -1 right;
    /// step: delta times n, t1, t2; reach: first of the three fields of that side.
    template <int Sign>
    HEMOFLUX_INLINE void side(const double* records, const std::uint32_t* index, const Rotation<Value>& step,
                              const Rotation<Value>& r, std::size_t reach, SideNodes<Value>& s,
                              Value (&centre)[4]) const {
        Value v[16], to[3];
        exchange::load_records(records, index + first, v);
        for (std::size_t a = 0; a < 3; ++a)
            to[a] = Sign > 0 ? field(reach + a) - step.n[a] : field(reach + a) + step.n[a];
        for (int c = 0; c < 4; ++c) {
            const Value &x = v[4 + c], &y = v[8 + c], &z = v[12 + c];
            s.a[c] = ((v[c] + to[0] * x) + to[1] * y) + to[2] * z;
            s.d1[c] = step.t1[0] * x + step.t1[1] * y + step.t1[2] * z;
            s.d2[c] = step.t2[0] * x + step.t2[1] * y + step.t2[2] * z;
            centre[c] = Sign > 0 ? ((s.a[c] + step.n[0] * x) + step.n[1] * y) + step.n[2] * z
                                 : ((s.a[c] - step.n[0] * x) - step.n[1] * y) - step.n[2] * z;
        }
        r.apply(s.a[1], s.a[2], s.a[3]);
        r.apply(s.d1[1], s.d1[2], s.d1[3]);
        r.apply(s.d2[1], s.d2[2], s.d2[3]);
    }

    /// Fluxes of mass and momentum x, y, z through the whole faces, from left to right. force: null, or records of force
    /// and viscosity.
    template <bool Force, bool Viscosity, bool Preconditioned>
    HEMOFLUX_INLINE void flux(const double* records, const double* force, const FlowParameters& parameters,
                              double inv_gamma, Value (&out)[4]) const {
        const Rotation<Value> r = rotation();
        const Value delta = field(face_delta), left_share = 2.0 * field(face_weight),
                    right_share = 2.0 - left_share;
        Rotation<Value> step;
        for (std::size_t a = 0; a < 3; ++a) {
            step.n[a] = delta * r.n[a];
            step.t1[a] = delta * r.t1[a];
            step.t2[a] = delta * r.t2[a];
        }
        Value impulse[3] = {};
        if constexpr (Force) {
            for (std::size_t a = 0; a < 3; ++a) {
                const Value left = lanes_of(force + a, grid.left + first),
                            right = lanes_of(force + a, grid.right + first);
                impulse[a] = 0.5 * (left_share * left + right_share * right) + parameters.uniform_force[a];
                if constexpr (Preconditioned) impulse[a] = impulse[a] * inv_gamma;
            }
            step.apply(impulse[0], impulse[1], impulse[2]);
        }
        Value nu = Value(parameters.nu);
        if constexpr (Viscosity)
            nu = 0.5 * (lanes_of(force + 3, grid.left + first) + lanes_of(force + 3, grid.right + first));
        SideNodes<Value> left, right;
        PlaneNodes<Value> plane;
        Value of_left[4], of_right[4];
        side<1>(records, grid.left_record, step, r, face_reach_left, left, of_left);
        side<-1>(records, grid.right_record, step, r, face_reach_right, right, of_right);
        for (int c = 0; c < 4; ++c) {
            plane.c[c] = left_share * of_left[c] + right_share * of_right[c];
            plane.m1[c] = left_share * left.d1[c] + right_share * right.d1[c];
            plane.m2[c] = left_share * left.d2[c] + right_share * right.d2[c];
        }
        r.apply(plane.c[1], plane.c[2], plane.c[3]);
        Value relax = 3.0 * nu * field(face_inverse_delta);
        if constexpr (Preconditioned) relax = relax * inv_gamma;
        const Quad<Value> q = flux_of_nodes<Force, Preconditioned>(
            left, detail::products<Preconditioned>(left, inv_gamma), right,
            detail::products<Preconditioned>(right, inv_gamma), plane, relax, impulse, inv_gamma);
        const Value area = field(face_area);
        for (int c = 0; c < 4; ++c) out[c] = area * q.c[c];
        r.invert(out[1], out[2], out[3]);
    }

    /// Value at p of the records of four `index`, one a lane.
    HEMOFLUX_INLINE static Value lanes_of(const double* p, const std::uint32_t* index) {
        if constexpr (exchange::lanes<Value> == 1) {
            return p[4 * *index];
        } else {
            double value[exchange::lanes<Value>];
            for (std::size_t l = 0; l < exchange::lanes<Value>; ++l) value[l] = p[4 * index[l]];
            return exchange::load<Value>(value);
        }
    }
};

}  // namespace hemoflux::fluid
