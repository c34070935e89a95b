// Reductions over the fluid's interior cells.
#include <cmath>

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/norm_kernels.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

struct Cells {
    GridView grid;
    StateView state;
    HEMOFLUX_INLINE std::size_t at(std::size_t cell) const {
        const auto& n = grid.layout.n;
        return grid.layout.origin + cell % n[0] + cell / n[0] % n[1] * grid.layout.row +
               cell / (n[0] * n[1]) * grid.layout.plane;
    }
};

struct SquareOf : Cells {
    HEMOFLUX_FN Squares operator()(std::size_t cell) const {
        const std::size_t i = at(cell);
        Squares s;
        for (int c = 0; c < 4; ++c) s.c[c] = state.q[c][i] * state.q[c][i];
        return s;
    }
};

struct DensityTimesVolume : Cells {
    HEMOFLUX_FN double operator()(std::size_t cell) const {
        const auto& n = grid.layout.n;
        return (state.q[0][at(cell)] - 1) * 8 * grid.axis[0].half[cell % n[0]] *
               grid.axis[1].half[cell / n[0] % n[1]] * grid.axis[2].half[cell / (n[0] * n[1])];
    }
};

struct SquaredSpeed : Cells {
    HEMOFLUX_FN exchange::Maximum operator()(std::size_t cell) const {
        const std::size_t i = at(cell);
        return {state.q[1][i] * state.q[1][i] + state.q[2][i] * state.q[2][i] +
                state.q[3][i] * state.q[3][i]};
    }
};

struct IsBad : Cells {
    HEMOFLUX_FN bool operator()(std::size_t cell) const {
        const std::size_t i = at(cell);
        const double speed2 =
            state.q[1][i] * state.q[1][i] + state.q[2][i] * state.q[2][i] + state.q[3][i] * state.q[3][i];
        return !possible(state.q[0][i], speed2);
    }
};

}  // namespace

ResidualNorm Solver::residual_norm() {
    if (evaluations_ == 0) return {NAN, {NAN, NAN, NAN}};
    exchange::Reduction<Squares> reduction;
    const std::size_t n = grid_.view().layout.cells();
    const Squares s = reduction.sum(n, SquareOf{{grid_.view(), residual_.view()}});
    ResidualNorm norm;
    const auto count = static_cast<double>(n);
    norm.density = std::sqrt(s.c[0] / count);
    for (int c = 0; c < 3; ++c) norm.momentum[c] = std::sqrt(s.c[c + 1] / count);
    return norm;
}

double Solver::mean_density() {
    exchange::Reduction<double> reduction;
    const double excess =
        reduction.sum(grid_.view().layout.cells(), DensityTimesVolume{{grid_.view(), state_.view()}});
    double volume = 1;
    for (const auto& axis : grid_.rectilinear().axes) volume *= axis.length();
    return 1 + excess / volume;
}

double Solver::largest_speed() {
    exchange::Reduction<exchange::Maximum> reduction;
    return std::sqrt(
        reduction.sum(grid_.view().layout.cells(), SquaredSpeed{{grid_.view(), state_.view()}}).value);
}

std::size_t Solver::first_bad_cell() {
    return exchange::find_first(grid_.view().layout.cells(), IsBad{{grid_.view(), state_.view()}});
}

}  // namespace hemoflux::fluid
