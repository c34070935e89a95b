/// Marks shared by all kernels: the one place where CUDA's function qualifiers are named.
#pragma once

#if defined(__CUDACC__)
#define HEMOFLUX_FN __host__ __device__
#else
#define HEMOFLUX_FN
#endif

#if defined(__GNUC__)
#define HEMOFLUX_INLINE HEMOFLUX_FN inline __attribute__((always_inline))
#define HEMOFLUX_RESTRICT __restrict__
#if defined(__clang__) || defined(__CUDACC__)
#define HEMOFLUX_NOINLINE __attribute__((noinline))
#else
#define HEMOFLUX_NOINLINE __attribute__((noinline, noclone))
#endif
#else
#define HEMOFLUX_INLINE HEMOFLUX_FN inline
#define HEMOFLUX_RESTRICT
#define HEMOFLUX_NOINLINE
#endif

namespace hemoflux::exchange {

/// True when the parallel loops of this build run on a GPU (backend CUDA).
#if defined(HEMOFLUX_BACKEND_CUDA)
inline constexpr bool on_gpu = true;
#else
inline constexpr bool on_gpu = false;
#endif

}  // namespace hemoflux::exchange
