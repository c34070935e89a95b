/// Arithmetic of 4 x 4 blocks, row after row, in single precision.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"

namespace hemoflux::fluid {

/// out = a b; out must be neither.
HEMOFLUX_INLINE void multiply(const float* a, const float* b, float* out) {
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k)
            out[4 * i + k] = a[4 * i] * b[k] + a[4 * i + 1] * b[4 + k] + a[4 * i + 2] * b[8 + k] +
                             a[4 * i + 3] * b[12 + k];
}

/// out -= a b
HEMOFLUX_INLINE void subtract_product(const float* a, const float* b, float* out) {
    float product[16];
    multiply(a, b, product);
    for (int e = 0; e < 16; ++e) out[e] -= product[e];
}

/// y -= a x
HEMOFLUX_INLINE void subtract_applied(const float* a, const float* x, float* y) {
    for (int i = 0; i < 4; ++i)
        y[i] -= a[4 * i] * x[0] + a[4 * i + 1] * x[1] + a[4 * i + 2] * x[2] + a[4 * i + 3] * x[3];
}

/// a <- a^-1 by Gauss-Jordan elimination with row pivoting, in double precision.
HEMOFLUX_INLINE void invert(float* a) {
    double m[4][8];
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) {
            m[i][k] = static_cast<double>(a[4 * i + k]);
            m[i][4 + k] = i == k ? 1 : 0;
        }
    for (int c = 0; c < 4; ++c) {
        int pivot = c;
        for (int i = c + 1; i < 4; ++i)
            if (std::fabs(m[i][c]) > std::fabs(m[pivot][c])) pivot = i;
        for (int k = 0; k < 8; ++k) {
            const double upper = m[pivot][k];
            m[pivot][k] = m[c][k];
            m[c][k] = upper;
        }
        const double inverse = 1 / m[c][c];
        for (int k = 0; k < 8; ++k) m[c][k] *= inverse;
        for (int i = 0; i < 4; ++i) {
            if (i == c) continue;
            const double factor = m[i][c];
            for (int k = 0; k < 8; ++k) m[i][k] -= factor * m[c][k];
        }
    }
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) a[4 * i + k] = static_cast<float>(m[i][4 + k]);
}

}  // namespace hemoflux::fluid
