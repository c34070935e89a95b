/// Floating-point operations and bytes of memory traffic per cell of the residual kernels, counted by hand, for the
/// roofline. A fused multiply-add counts as two operations, a division as one; what tiles recompute is left out.
///
///                                         cubic cells   any widths, viscosity and force fields   unstructured
///   per cell  differences or gradients         24            60                                      168
///             scalar products                  53             -                                        -
///             balance                          32            38                                       52
///   per face  turning into its frame            -             -                                      300
///             nodes of both sides               -            34      (a, d1, d2)                       34
///             scalar products                   -            62                                       62
///             sums of both sides              110           110      (side_sums, 55 each)            110
///             nodes in the plane               20            62                                       62
///             their sums                       59            59      (plane_sums)                     59
///             flux                             28            28                                       28
///             lengths, viscosity, force         -            47                                        2
///   total = per cell + 3 faces                760          1304                                     2191
///
/// Bytes, each array once and what is written read first; 8 per double. Rectilinear: state read, R written, fields read,
/// 32 + 64 (+ 32). Unstructured: values, neighbours and weights 200, records written 256 and read by faces 128, face data
/// and their cells 432, fluxes written 192 and read with their sides 120, volume and rate 72.
#pragma once

namespace hemoflux::fluid {

/// Per cell; zero where it is not counted.
struct Work {
    double operations = 0, bytes = 0;
};
inline constexpr Work cubic_work{24 + 53 + 32 + 3 * (110 + 20 + 59 + 28), 32 + 64};
inline constexpr Work full_work{60 + 38 + 3 * (34 + 62 + 110 + 62 + 59 + 28 + 47), 32 + 64 + 32};
inline constexpr Work single_work{cubic_work.operations, cubic_work.bytes / 2};
inline constexpr Work unstructured_work{168 + 52 + 3 * (300 + 34 + 62 + 110 + 62 + 59 + 28 + 2),
                                        200 + 256 + 128 + 432 + 192 + 120 + 72};

}  // namespace hemoflux::fluid
