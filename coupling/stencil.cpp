#include "coupling/stencil.hpp"

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Computes the stencil of marker m.
template <class WeightFunction>
struct BuildStencil {
    CellGridView grid;
    WeightFunction weights;
    const double* position[3];
    Stencil* stencils;

    HEMOFLUX_FN void operator()(std::size_t m) const {
        Stencil s;
        s.lost = false;
        s.wraps_x = false;
        for (int q = 0; q < 3; ++q) {
            const AxisView& axis = grid.axis[q];
            double X = position[q][m];
            if (!axis.contains(X)) {
                s.lost = true;
                X = X > axis.upper ? axis.upper : axis.lower;
            }
            int turns;
            const int first = axis.cell(weights(axis, axis.wrap(X, &turns), s.weight[q]));
            s.first[q] = first;
            if (q == 0) s.wraps_x = first + stencil_width > axis.n;
        }
        stencils[m] = s;
    }
};

struct Lost {
    const Stencil* stencils;
    HEMOFLUX_FN bool operator()(std::size_t m) const { return stencils[m].lost; }
};

}  // namespace

StencilSet::StencilSet(const CellGrid& grid, Kernel kernel, std::size_t markers)
    : grid_(grid), kernel_(kernel), stencils_(markers) {}

void StencilSet::update(const double* x, const double* y, const double* z) {
    const CellGridView g = grid_.view();
    Stencil* s = stencils_.data();
    const auto build = [&](auto weights) {
        exchange::for_each_index(size(), BuildStencil<decltype(weights)>{g, weights, {x, y, z}, s});
    };
    switch (kernel_) {
        case Kernel::phi2:
            return build(Phi2{});
        case Kernel::phi3:
            return build(Phi3{});
        case Kernel::phi4:
            return build(Phi4{});
        case Kernel::lagrange:
            return build(Lagrange{});
    }
}

std::size_t StencilSet::first_lost() const { return exchange::find_first(size(), Lost{stencils_.data()}); }

}  // namespace hemoflux::coupling
