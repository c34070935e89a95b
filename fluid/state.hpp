/// The fluid's fields: density and velocity, and where needed body force and viscosity, all in one padded
/// layout.
#pragma once

#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/field.hpp"
#include "exchange/layout.hpp"

namespace hemoflux::fluid {

/// Pointers a kernel needs; trivially copyable. q: density, then velocity x, y, z (c = 1). force: per volume.
/// nu: kinematic viscosity. force and nu are null where the solver was not asked for them.
template <class Real>
struct BasicStateView {
    Real* q[4] = {nullptr, nullptr, nullptr, nullptr};
    Real* force[3] = {nullptr, nullptr, nullptr};
    Real* nu = nullptr;
};
using StateView = BasicStateView<double>;
/// In single precision the density is stored as rho - 1.
using SingleStateView = BasicStateView<float>;

/// Owns the fields. All fields start as: density 1, velocity 0, force 0, viscosity `nu`; padding values too,
/// so that unused SIMD lanes stay finite.
class State {
  public:
    /// Without force or viscosity their pointers in view() are null.
    State(const exchange::Layout& layout, bool with_force, bool with_viscosity, double nu);

    [[nodiscard]] const StateView& view() const { return view_; }
    [[nodiscard]] const exchange::Layout& layout() const { return layout_; }

    /// Interior values of a field, x fastest, n[0] n[1] n[2] of them.
    [[nodiscard]] std::vector<double> interior(const double* field) const;
    /// Replaces the interior values of a field; values.size() must be the number of cells
    /// (std::length_error).
    void set_interior(double* field, const std::vector<double>& values);

  private:
    exchange::Layout layout_;
    std::vector<exchange::Buffer<double>> fields_;
    StateView view_;
};

}  // namespace hemoflux::fluid
