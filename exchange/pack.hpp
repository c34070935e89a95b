/// The value type of a kernel: a SIMD pack of doubles (or floats) on the CPU, one double for a CUDA thread.
/// A kernel templated on `Value` is written once with the functions below and runs as either.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "exchange/macros.hpp"

#if !defined(HEMOFLUX_BACKEND_CUDA)
#include <experimental/simd>
#endif

namespace hemoflux::exchange {

/// Rows of fields start on a multiple of this many values, whatever the width of a pack.
inline constexpr std::size_t row_alignment = 8;

#if defined(HEMOFLUX_BACKEND_CUDA)
using Pack = double;
using SinglePack = float;
inline constexpr std::size_t pack_lanes = 1;
#else
/// As many doubles (floats) as one register of this machine holds; never wider.
using Pack = std::experimental::native_simd<double>;
using SinglePack = std::experimental::native_simd<float>;
inline constexpr std::size_t pack_lanes = Pack::size();
#endif
#if defined(HEMOFLUX_PACK_LANES)
static_assert(
    pack_lanes == HEMOFLUX_PACK_LANES,
    "the installed hemoflux was built for registers of another width: build and install it on this machine, "
    "or both sides with HEMOFLUX_NATIVE=OFF");
#endif

/// Number and type of the values that `Value` carries side by side.
template <class Value>
struct Lanes {
    static constexpr std::size_t count = 1;
    using Type = Value;
};
#if !defined(HEMOFLUX_BACKEND_CUDA)
template <class T, class Abi>
struct Lanes<std::experimental::simd<T, Abi>> {
    static constexpr std::size_t count = std::experimental::simd<T, Abi>::size();
    using Type = T;
};
#endif
template <class Value>
inline constexpr std::size_t lanes = Lanes<Value>::count;
/// double or float.
template <class Value>
using Scalar = typename Lanes<Value>::Type;
/// Whether `Value` is single precision.
template <class Value>
inline constexpr bool is_single = std::is_same_v<Scalar<Value>, float>;

/// lanes<Value> consecutive values from p (no alignment needed).
template <class Value>
HEMOFLUX_INLINE Value load(const Scalar<Value>* p) {
    if constexpr (lanes<Value> == 1) {
        return *p;
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        return Value(p, std::experimental::element_aligned);
#endif
    }
}

/// Writes all lanes of v to p (no alignment needed).
template <class Value>
HEMOFLUX_INLINE void store(Scalar<Value>* p, const Value& v) {
    if constexpr (lanes<Value> == 1) {
        *p = v;
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        v.copy_to(p, std::experimental::element_aligned);
#endif
    }
}

/// Writes the first `count` lanes of v to p and leaves the rest alone; count >= lanes writes all.
template <class Value>
HEMOFLUX_INLINE void store_first(Scalar<Value>* p, const Value& v, std::ptrdiff_t count) {
    if constexpr (lanes<Value> == 1) {
        if (count > 0) *p = v;
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        if (count >= static_cast<std::ptrdiff_t>(lanes<Value>)) {
            v.copy_to(p, std::experimental::element_aligned);
        } else {
            for (std::ptrdiff_t l = 0; l < count; ++l) p[l] = v[static_cast<std::size_t>(l)];
        }
#endif
    }
}

/// Asks for the line at p ahead of its use; nothing on a GPU.
template <class T>
HEMOFLUX_INLINE void prefetch([[maybe_unused]] const T* p) {
#if defined(__GNUC__) && !defined(__CUDACC__)
    __builtin_prefetch(p, 0, 3);
#endif
}

/// Values p[index[0]], p[index[1]], ... of one pack.
template <class Value>
HEMOFLUX_INLINE Value gather(const double* p, const int* index) {
    if constexpr (lanes<Value> == 1) {
        return p[*index];
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        return Value([&](std::size_t l) { return p[index[l]]; });
#endif
    }
}

/// Values p[0], p[pitch], p[2 pitch], ... of one pack; lanes from `count` on repeat the last value.
template <class Value>
HEMOFLUX_INLINE Value load_strided(const double* p, std::ptrdiff_t pitch, std::ptrdiff_t count) {
    if constexpr (lanes<Value> == 1) {
        return *p;
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        return Value([&](auto l) {
            const auto row = static_cast<std::ptrdiff_t>(l);
            return p[(row < count ? row : count - 1) * pitch];
        });
#endif
    }
}

/// Writes the first `count` lanes of v to p[0], p[pitch], p[2 pitch], ...
template <class Value>
HEMOFLUX_INLINE void store_strided(double* p, std::ptrdiff_t pitch, const Value& v, std::ptrdiff_t count) {
    if constexpr (lanes<Value> == 1) {
        if (count > 0) *p = v;
    } else {
#if !defined(HEMOFLUX_BACKEND_CUDA)
        for (std::ptrdiff_t l = 0; l < count; ++l) p[l * pitch] = v[static_cast<std::size_t>(l)];
#endif
    }
}

/// The smaller, the larger value; square root and magnitude; of packs lane by lane.
HEMOFLUX_INLINE double minimum(double a, double b) { return a < b ? a : b; }
HEMOFLUX_INLINE double maximum(double a, double b) { return a > b ? a : b; }
/// yes where condition holds, else no.
HEMOFLUX_INLINE double select(bool condition, double yes, double no) { return condition ? yes : no; }
HEMOFLUX_INLINE double square_root(double a) { return std::sqrt(a); }
HEMOFLUX_INLINE double absolute(double a) { return std::fabs(a); }
/// Sum over the lanes, in lane order.
HEMOFLUX_INLINE double lane_sum(double a) { return a; }

#if !defined(HEMOFLUX_BACKEND_CUDA)
HEMOFLUX_INLINE Pack minimum(const Pack& a, const Pack& b) { return std::experimental::min(a, b); }
HEMOFLUX_INLINE Pack maximum(const Pack& a, const Pack& b) { return std::experimental::max(a, b); }
HEMOFLUX_INLINE Pack select(const Pack::mask_type& condition, const Pack& yes, const Pack& no) {
    Pack r = no;
    std::experimental::where(condition, r) = yes;
    return r;
}
HEMOFLUX_INLINE Pack square_root(const Pack& a) { return std::experimental::sqrt(a); }
HEMOFLUX_INLINE Pack absolute(const Pack& a) { return std::experimental::abs(a); }
HEMOFLUX_INLINE double lane_sum(const Pack& a) {
    double s = 0;
    for (std::size_t l = 0; l < pack_lanes; ++l) s += a[l];
    return s;
}
#endif

/// Smallest multiple of `multiple` that is not below n.
HEMOFLUX_INLINE constexpr std::size_t round_up(std::size_t n, std::size_t multiple) {
    return (n + multiple - 1) / multiple * multiple;
}

}  // namespace hemoflux::exchange
