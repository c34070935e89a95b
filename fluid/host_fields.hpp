/// The solver's fields on the host, for what is measured after or between steps.
#pragma once

#include <array>
#include <vector>

#include "fluid/solver.hpp"

namespace hemoflux::fluid {

/// Padded copies of density and velocity in the solver's layout, ghost cells filled as the boundary conditions say.
struct HostFields {
    exchange::Layout layout;
    std::array<std::vector<double>, 4> q;  ///< density, velocity x, y, z

    /// Value of a field in cell (i, j, k); negative indices are ghosts.
    [[nodiscard]] double at(std::size_t field, std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        return q[field][layout.at(i, j, k)];
    }
};

/// Fills the ghost cells and copies the fields.
HostFields host_fields(const Solver& solver);

}  // namespace hemoflux::fluid
