/// Loads what the faces of an unstructured grid need and calls face_flux() in the frame of each face.
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

    HEMOFLUX_INLINE Value field(std::size_t k) const { return exchange::load<Value>(grid.field(first, k)); }

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

    /// One side, in the face's frame, moved along the face; reach: first of the three fields of that side.
    HEMOFLUX_INLINE FaceSide<Value> side(const double* records, const std::uint32_t* cells,
                                         const Rotation<Value>& r, std::size_t reach) const {
        Value v[16];
        exchange::load_records(records, cells + first, v);
        FaceSide<Value> s;
        for (int c = 0; c < 4; ++c) {
            Value gradient[3] = {v[4 + c], v[8 + c], v[12 + c]};
            r.apply(gradient[0], gradient[1], gradient[2]);
            s.phi[c] = v[c];
            s.n[c] = gradient[0], s.t1[c] = gradient[1], s.t2[c] = gradient[2];
        }
        r.apply(s.phi[1], s.phi[2], s.phi[3]);
        r.apply(s.n[1], s.n[2], s.n[3]);
        r.apply(s.t1[1], s.t1[2], s.t1[3]);
        r.apply(s.t2[1], s.t2[2], s.t2[3]);
        const Value along1 = field(reach + 1), along2 = field(reach + 2);
        for (int c = 0; c < 4; ++c) s.phi[c] = s.phi[c] + along1 * s.t1[c] + along2 * s.t2[c];
        return s;
    }

    /// Fluxes of mass and momentum x, y, z through the whole faces, from left to right. force: null, or records of force
    /// and viscosity.
    template <bool Force, bool Viscosity, bool Preconditioned>
    HEMOFLUX_INLINE void flux(const double* records, const double* force, const FlowParameters& parameters,
                              double inv_gamma, Value (&out)[4]) const {
        const Rotation<Value> r = rotation();
        FaceGeometry<Value> face;
        face.half_left = field(face_reach_left);
        face.half_right = -field(face_reach_right);
        face.weight_left = field(face_weight);
        face.delta = field(face_delta);
        face.inv_delta = field(face_inverse_delta);
        Value f[3] = {Value(0.0), Value(0.0), Value(0.0)};
        if constexpr (Force) {
            for (std::size_t a = 0; a < 3; ++a) {
                const Value left = lanes_of(force + a, grid.left + first),
                            right = lanes_of(force + a, grid.right + first);
                f[a] = right + face.weight_left * (left - right) + parameters.uniform_force[a];
                if constexpr (Preconditioned) f[a] = f[a] * inv_gamma;
            }
            r.apply(f[0], f[1], f[2]);
        }
        Value nu = Value(parameters.nu);
        if constexpr (Viscosity)
            nu = 0.5 * (lanes_of(force + 3, grid.left + first) + lanes_of(force + 3, grid.right + first));
        const FaceSide<Value> left = side(records, grid.left, r, face_reach_left);
        const FaceSide<Value> right = side(records, grid.right, r, face_reach_right);
        const Quad<Value> q = face_flux<Force, Preconditioned>(left, right, face, nu, f, inv_gamma);
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
