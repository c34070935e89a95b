// The solver's fields as plain device vectors of cells, x fastest, one component after the other.
#include <stdexcept>

#include "exchange/parallel.hpp"
#include "fluid/row_kernel.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::lanes;
using exchange::load;
using exchange::Pack;

/// Base of kernels between the padded layout and a vector of cells.
struct VectorKernel : RowKernel {
    HEMOFLUX_INLINE std::size_t cell(std::size_t row, std::size_t pack) const {
        return row * layout.n[0] + pack * lanes<Pack>;
    }
};

/// to <- field
struct ReadField : VectorKernel {
    const double* field;
    double* to;
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        exchange::store_first(to + cell(row, pack), load<Pack>(field + at(row, pack)), count(pack));
    }
};

/// q <- (rho, rho u, rho v, rho w)
struct ReadConserved : VectorKernel {
    StateView state;
    double* q;
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t i = at(row, pack), to = cell(row, pack), cells = layout.cells();
        const Pack rho = load<Pack>(state.q[0] + i);
        exchange::store_first(q + to, rho, count(pack));
        for (std::size_t c = 1; c < 4; ++c)
            exchange::store_first(q + c * cells + to, Pack(rho * load<Pack>(state.q[c] + i)), count(pack));
    }
};

/// rho, u, v, w <- q. A pack must not be read past the end of q, so the cells are taken one by one.
struct WriteConserved : VectorKernel {
    StateView state;
    const double* q;
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t i = at(row, pack), from = cell(row, pack), cells = layout.cells();
        for (std::size_t l = 0; l < lanes<Pack> && pack * lanes<Pack> + l < layout.n[0]; ++l) {
            const double rho = q[from + l];
            state.q[0][i + l] = rho;
            for (std::size_t c = 1; c < 4; ++c) state.q[c][i + l] = q[c * cells + from + l] / rho;
        }
    }
};

template <class Kernel>
void each_row(const exchange::Layout& layout, const Kernel& kernel) {
    exchange::for_each_row(layout.n[1] * layout.n[2], packs_per_row(layout), kernel, exchange::Cost::cheap);
}

}  // namespace

void Solver::read_conserved(double* q) const {
    const exchange::Layout& layout = grid_.view().layout;
    each_row(layout, ReadConserved{{{layout}}, state_.view(), q});
}

void Solver::write_conserved(const double* q) {
    const exchange::Layout& layout = grid_.view().layout;
    each_row(layout, WriteConserved{{{layout}}, state_.view(), q});
}

void Solver::read_residual(double* r) const {
    const exchange::Layout& layout = grid_.view().layout;
    for (std::size_t c = 0; c < 4; ++c)
        each_row(layout, ReadField{{{layout}}, residual_.view().q[c], r + c * layout.cells()});
}

void Solver::read_local_steps(double* dt) const {
    if (local_dt_.size() == 0)
        throw std::logic_error("Solver::read_local_steps: set_local_steps() comes first");
    const exchange::Layout& layout = grid_.view().layout;
    each_row(layout, ReadField{{{layout}}, local_dt_.data(), dt});
}

}  // namespace hemoflux::fluid
