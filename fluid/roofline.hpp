/// Floating-point operations and bytes of memory traffic per cell of the residual kernels, counted by hand, for the
/// roofline. A fused multiply-add counts as two operations, a division as one; what tiles recompute is left out.
///
///                                         cubic cells   any widths, viscosity and force fields   unstructured
///   per cell  differences or gradients         24            60                                      168
///             scalar products                  53             -                                        -
///             balance                          32            38                                       52
///   per face  turning into its frame            -             -                                      133
///             nodes of both sides               -            34      (a, d1, d2)                      191
///             scalar products                   -            62                                       62
///             sums of both sides              110           110      (side_sums, 55 each)            110
///             nodes in the plane               20            51                                       38
///             their sums                       59            59      (plane_sums)                     59
///             flux                             27            27                                       27
///             lengths, viscosity, force         -            41                                        2
///   total = per cell + 3 faces                757          1250                                     2086
///
/// Bytes, each array once and what is written read first; 8 per double. Rectilinear: state read, R written, fields read,
/// 32 + 64 (+ 32). Unstructured: values, neighbours and weights 200, face data and their cells 408, sides and volume 32,
/// rate 64; records and fluxes stay in the cache (hex_sweep.hpp).
#pragma once

namespace hemoflux::fluid {

/// Per cell; zero where it is not counted.
struct Work {
    double operations = 0, bytes = 0;
};
inline constexpr Work cubic_work{24 + 53 + 32 + 3 * (110 + 20 + 59 + 27), 32 + 64};
inline constexpr Work full_work{60 + 38 + 3 * (34 + 62 + 110 + 51 + 59 + 27 + 41), 32 + 64 + 32};
inline constexpr Work single_work{cubic_work.operations, cubic_work.bytes / 2};
inline constexpr Work unstructured_work{168 + 52 + 3 * (133 + 191 + 62 + 110 + 38 + 59 + 27 + 2),
                                        200 + 408 + 32 + 64};

}  // namespace hemoflux::fluid
