/// Kernels of incomplete block LU factors, one call a row of blocks of 4 x 4; rows of one level do not depend on each other
/// (see fluid/compact_pattern.hpp).
///
///   A_ik <- A_ik A_kk^-1,  A_ij <- A_ij - A_ik A_kj  for k < i;   L y = S^-1 r,  U x = y
#pragma once

#include <cstddef>
#include <cstdint>

#include "exchange/macros.hpp"
#include "fluid/block4.hpp"

namespace hemoflux::fluid {

/// Rows of one level.
struct LevelKernel {
    std::size_t begin;
    const std::uint32_t *cell, *first, *upper, *column;
    float *block, *diagonal;
};

/// Eliminates a row and inverts its diagonal block.
struct FactorRow : LevelKernel {
    HEMOFLUX_FN void operator()(std::size_t index) const {
        const std::size_t row = begin + index;
        float* own = diagonal + 16 * row;
        for (std::uint32_t p = first[row]; p < upper[row]; ++p) {
            const std::uint32_t k = column[p];
            float t[16];
            multiply(block + 16 * std::size_t{p}, diagonal + 16 * std::size_t{k}, t);
            for (int e = 0; e < 16; ++e) block[16 * std::size_t{p} + static_cast<std::size_t>(e)] = t[e];
            std::uint32_t at = p + 1;  // columns ascend in both rows
            for (std::uint32_t u = upper[k]; u < first[k + 1]; ++u) {
                if (column[u] == row) {
                    subtract_product(t, block + 16 * std::size_t{u}, own);
                    continue;
                }
                while (at < first[row + 1] && column[at] < column[u]) ++at;
                if (at < first[row + 1] && column[at] == column[u])
                    subtract_product(t, block + 16 * std::size_t{u}, block + 16 * std::size_t{at});
            }
        }
        invert(own);
    }
};

/// y of a row; scale: 1 / S.
struct ForwardRow : LevelKernel {
    const float* r;
    float scale[4];
    std::size_t cells;
    float* work;
    HEMOFLUX_FN void operator()(std::size_t index) const {
        const std::size_t row = begin + index;
        float x[4];
        for (std::size_t c = 0; c < 4; ++c) x[c] = scale[c] * r[c * cells + cell[row]];
        for (std::uint32_t p = first[row]; p < upper[row]; ++p)
            subtract_applied(block + 16 * std::size_t{p}, work + 4 * std::size_t{column[p]}, x);
        for (std::size_t c = 0; c < 4; ++c) work[4 * row + c] = x[c];
    }
};

/// x of a row.
struct BackwardRow : LevelKernel {
    std::size_t cells;
    float* work;
    double* out;
    HEMOFLUX_FN void operator()(std::size_t index) const {
        const std::size_t row = begin + index;
        float x[4], y[4];
        for (std::size_t c = 0; c < 4; ++c) x[c] = work[4 * row + c], y[c] = 0;
        for (std::uint32_t p = upper[row]; p < first[row + 1]; ++p)
            subtract_applied(block + 16 * std::size_t{p}, work + 4 * std::size_t{column[p]}, x);
        subtract_applied(diagonal + 16 * row, x, y);
        for (std::size_t c = 0; c < 4; ++c) {
            work[4 * row + c] = -y[c];
            out[c * cells + cell[row]] = static_cast<double>(-y[c]);
        }
    }
};

}  // namespace hemoflux::fluid
