/// The flux solver written down plainly, as the yardstick of the benchmarks: one cell, one face, one lattice
/// direction after the other in doubles. It shares no code with fluid/.
///
///   dQ/dt = -1/h sum_faces F.n,  Q = (rho, rho u, rho v, rho w)                                     (2.3)
///   F from the D3Q15 solution at the face centre: f_a = f_a^pre - (tau - 1/2)(f_a^eq - f_a^pre) ...
///   (2.4)-(2.9)
///
/// Uniform cubic cells, periodic on all sides, constant viscosity, no body force, streaming distance h/2.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hemoflux::bench {

/// Fields on nx x ny x nz cells, x fastest.
class ScalarFlow {
  public:
    /// n: cells along x, y, z; width: of a cell; viscosity: kinematic (width times c).
    ScalarFlow(std::array<std::size_t, 3> n, double width, double viscosity);

    /// Density, then velocity x, y, z (c = 1) of all cells.
    std::array<std::vector<double>, 4>& fields() { return fields_; }
    /// dQ/dt of all cells as of the last evaluate().
    [[nodiscard]] const std::array<std::vector<double>, 4>& residual() const { return residual_; }

    /// Gradients of all cells, then the fluxes of all faces, each added to its two cells.
    void evaluate();

  private:
    using Moments = std::array<double, 4>;
    void compute_gradients();
    [[nodiscard]] Moments extrapolate(std::size_t cell, const std::array<double, 3>& offset) const;
    [[nodiscard]] Moments face_flux(std::size_t left, std::size_t right, std::size_t normal) const;

    std::size_t cells_;
    double width_, viscosity_;
    std::array<std::vector<double>, 4> fields_, residual_;
    std::array<std::array<std::vector<double>, 3>, 4> gradient_;  // [field][axis]
    std::array<std::vector<std::size_t>, 3> below_, above_;       // neighbours of each cell along an axis
};

}  // namespace hemoflux::bench
