/// Floating-point operations and bytes of memory traffic per cell of the residual kernels, counted by hand, for the
/// roofline. A fused multiply-add counts as two operations, a division as one; what tiles recompute is left out.
///
///                                         cubic cells   any widths, viscosity and force fields
///   per cell  differences or gradients         24            60
///             scalar products                  53             -
///             balance                          32            38
///   per face  nodes of both sides               -            34      (a, d1, d2)
///             scalar products                   -            62
///             sums of both sides              122           122      (side_sums, 61 each)
///             nodes in the plane               20            52
///             their sums                       71            71      (plane_sums)
///             flux                             26            26
///             lengths, viscosity, force         -            47
///   total = per cell + 3 faces                826          1340
///   bytes: state read, R written (and its lines read first), fields read; 8 per double
///                                     32 + 64 = 96     32 + 64 + 32 = 128
#pragma once

namespace hemoflux::bench {

/// Per cell.
struct Work {
    double operations, bytes;
};
inline constexpr Work cubic_work{24 + 53 + 32 + 3 * (122 + 20 + 71 + 26), 96};
inline constexpr Work full_work{60 + 38 + 3 * (34 + 62 + 122 + 52 + 71 + 26 + 47), 128};
inline constexpr Work single_work{cubic_work.operations, 48};

}  // namespace hemoflux::bench
