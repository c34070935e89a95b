#include "membrane/forces.hpp"

#include "exchange/buffer.hpp"
#include "membrane/curvature_task.hpp"
#include "membrane/force_task.hpp"

namespace hemoflux::membrane {
namespace {

/// Both passes of one whole cell, whose data then stay in one core's cache between them.
template <class Law>
struct CellTask {
    CurvatureTask<exchange::Pack, Law> first;
    ForceTask<exchange::Pack, Law::triangles> second;

    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const std::size_t chunks = chunks_of(first.w.stride);
        CellSums sums;
        for (std::size_t k = 0; k < chunks; ++k) {
            first(cell * chunks + k);
            sums += first.partial[cell * chunks + k];
        }
        first.w.sums[cell] = sums;
        if (sums.overstretched > 0) return;
        for (std::size_t k = 0; k < chunks; ++k) second(cell * chunks + k);
    }
};

/// Cells for each thread from which whole cells are shared out, so that all threads end together.
constexpr std::size_t cells_per_thread = 4;

bool whole_cells(const ForceView& view) {
    return !exchange::on_gpu &&
           view.cells >= cells_per_thread * static_cast<std::size_t>(exchange::threads());
}

template <class Law>
void run(const ForceView& view, const Law& law, CellSums* partial, exchange::Reduction<CellSums>& reduction) {
    const CurvatureTask<exchange::Pack, Law> first{view, law, partial};
    const ForceTask<exchange::Pack, Law::triangles> second{view};
    const std::size_t chunks = chunks_of(view.stride);
    if (whole_cells(view)) {
        exchange::for_each_index(view.cells, CellTask<Law>{first, second}, cost_of(view));
        return;
    }
    exchange::for_each_index(view.cells * chunks, first, cost_of(view));
    reduction.sum_segments(view.cells, chunks, PartialSum{partial, chunks}, view.sums);
    exchange::for_each_index(view.cells * chunks, second, cost_of(view));
}

}  // namespace

struct ForceScratch::Memory {
    exchange::Buffer<CellSums> partial;
    exchange::Reduction<CellSums> reduction;
};

ForceScratch::ForceScratch(std::size_t cells, std::size_t stride) : memory_(std::make_unique<Memory>()) {
    memory_->partial = exchange::Buffer<CellSums>(cells * chunks_of(stride));
}
ForceScratch::~ForceScratch() = default;
ForceScratch::ForceScratch(ForceScratch&&) noexcept = default;
ForceScratch& ForceScratch::operator=(ForceScratch&&) noexcept = default;

void compute_forces(const ForceView& view, ForceScratch& scratch) {
    CellSums* partial = scratch.memory_->partial.data();
    exchange::Reduction<CellSums>& reduction = scratch.memory_->reduction;
    const double shear = view.network.shear, r = view.stretch_ratio;
    switch (view.network.law) {
        case InPlaneLaw::wlc:
            run(view, SpringLaw<WormLikeChain>{WormLikeChain(shear, r)}, partial, reduction);
            break;
        case InPlaneLaw::wlc_power:
            run(view, SpringLaw<PowerChain>{PowerChain(shear, r)}, partial, reduction);
            break;
        case InPlaneLaw::wlc_hydrostatic:
            run(view, HydrostaticLaw{HydrostaticChain(shear, r)}, partial, reduction);
            break;
        case InPlaneLaw::neo_hookean:
            run(view, ContinuumLaw<NeoHookean>{{shear}}, partial, reduction);
            break;
        case InPlaneLaw::skalak:
            run(view, ContinuumLaw<Skalak>{{shear, view.network.skalak_ratio}}, partial, reduction);
            break;
    }
}

}  // namespace hemoflux::membrane
