/// Records: N values of one item side by side in memory (array of structures), as unstructured kernels gather them.
/// A pack of items is loaded with whole-register loads and a transposition, several times faster than gathering
/// value by value.
#pragma once

#include <cstdint>
#include <utility>

#include "exchange/pack.hpp"

namespace hemoflux::exchange {

#if defined(HEMOFLUX_BACKEND_CUDA)
/// Four values of one item that are treated alike.
struct Four {
    double c[4];
    HEMOFLUX_INLINE Four() : c{0, 0, 0, 0} {}
    HEMOFLUX_INLINE explicit Four(double a) : c{a, a, a, a} {}
    HEMOFLUX_INLINE Four& operator+=(const Four& b) {
        for (int i = 0; i < 4; ++i) c[i] += b.c[i];
        return *this;
    }
};
HEMOFLUX_INLINE Four operator+(Four a, const Four& b) { return a += b; }
HEMOFLUX_INLINE Four operator-(Four a, const Four& b) {
    for (int i = 0; i < 4; ++i) a.c[i] -= b.c[i];
    return a;
}
HEMOFLUX_INLINE Four operator*(double s, Four a) {
    for (double& value : a.c) value *= s;
    return a;
}
HEMOFLUX_INLINE Four operator*(Four a, const Four& b) {
    for (int i = 0; i < 4; ++i) a.c[i] *= b.c[i];
    return a;
}
HEMOFLUX_INLINE Four load_four(const double* p) {
    Four a;
    for (int i = 0; i < 4; ++i) a.c[i] = p[i];
    return a;
}
HEMOFLUX_INLINE void store_four(double* p, const Four& a) {
    for (int i = 0; i < 4; ++i) p[i] = a.c[i];
}
#else
/// Four values of one item that are treated alike, in one register where the machine has one wide enough.
using Four = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4> >;
HEMOFLUX_INLINE Four load_four(const double* p) { return Four(p, std::experimental::element_aligned); }
HEMOFLUX_INLINE void store_four(double* p, const Four& a) {
    a.copy_to(p, std::experimental::element_aligned);
}
#endif

#if !defined(HEMOFLUX_BACKEND_CUDA)
namespace detail {

using Register __attribute__((vector_size(sizeof(double) * pack_lanes))) = double;
constexpr int width = static_cast<int>(pack_lanes);

HEMOFLUX_INLINE Register load_register(const double* p) {
    return __builtin_bit_cast(Register, load<Pack>(p));
}

/// One step of a transposition in squares of `Half` lanes: swaps the upper half of each 2 Half lanes of a with the
/// lower half of those of b.
template <int Half, int... L>
HEMOFLUX_INLINE void swap_halves(Register& a, Register& b, std::integer_sequence<int, L...>) {
    const Register low = __builtin_shufflevector(a, b, ((L & Half) ? width + L - Half : L)...);
    b = __builtin_shufflevector(a, b, ((L & Half) ? width + L : L + Half)...);
    a = low;
}

/// Transposes a square of `width` registers.
template <int Half>
HEMOFLUX_INLINE void transpose(Register (&row)[pack_lanes]) {
    if constexpr (Half > 0) {
        for (int i = 0; i < width; ++i)
            if (!(i & Half))
                swap_halves<Half>(row[i], row[i + Half], std::make_integer_sequence<int, width>());
        transpose<Half / 2>(row);
    }
}

/// Groups of `Group` lanes of a and b in turn; the first (Upper = 0) or second half of the result.
template <int Group, int Upper, int... L>
HEMOFLUX_INLINE Register zip(const Register& a, const Register& b, std::integer_sequence<int, L...>) {
    if constexpr (Group == width)
        return Upper == 0 ? a : b;
    else
        return __builtin_shufflevector(
            a, b, (((L / Group) & 1) * width + (L / Group / 2) * Group + L % Group + Upper * width / 2)...);
}

}  // namespace detail
#endif

/// out[c] = value c of the records index[0], index[1], ..., one a lane. Records have N values, N a multiple of 8.
template <class Value, std::size_t N>
HEMOFLUX_INLINE void load_records(const double* records, const std::uint32_t* index, Value (&out)[N]) {
    static_assert(N % row_alignment == 0);
    if constexpr (lanes<Value> == 1) {
        const double* p = records + N * *index;
        for (std::size_t c = 0; c < N; ++c) out[c] = p[c];
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        for (std::size_t c = 0; c < N; c += pack_lanes) {
            detail::Register row[pack_lanes];
            for (std::size_t l = 0; l < pack_lanes; ++l)
                row[l] = detail::load_register(records + N * index[l] + c);
            detail::transpose<detail::width / 2>(row);
            for (std::size_t l = 0; l < pack_lanes; ++l) out[c + l] = __builtin_bit_cast(Pack, row[l]);
        }
#endif
    }
}

/// Writes one record of four values per lane, one after the other: p[4 l + c] = value[c][l].
template <class Value>
HEMOFLUX_INLINE void store_fours(double* p, const Value (&value)[4]) {
    if constexpr (lanes<Value> == 1) {
        for (int c = 0; c < 4; ++c) p[c] = value[c];
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        using detail::Register;
        using detail::zip;
        constexpr auto all = std::make_integer_sequence<int, detail::width>();
        Register v[4];
        for (int c = 0; c < 4; ++c) v[c] = __builtin_bit_cast(Register, value[c]);
        const Register low01 = zip<1, 0>(v[0], v[1], all), high01 = zip<1, 1>(v[0], v[1], all);
        const Register low23 = zip<1, 0>(v[2], v[3], all), high23 = zip<1, 1>(v[2], v[3], all);
        const Register out[4] = {zip<2, 0>(low01, low23, all), zip<2, 1>(low01, low23, all),
                                 zip<2, 0>(high01, high23, all), zip<2, 1>(high01, high23, all)};
        for (std::size_t k = 0; k < 4; ++k) store(p + k * pack_lanes, __builtin_bit_cast(Pack, out[k]));
#endif
    }
}

}  // namespace hemoflux::exchange
