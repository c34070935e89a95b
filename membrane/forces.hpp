/// The membrane's energies and forces in two passes over the rings of all vertices of all cells.
///
/// Pass 1 reduces volume, area and total curvature of each cell, and leaves at each vertex dE/dS_j and
/// dE/dA_j; pass 2 gathers the force -grad E of each vertex from its own ring (volume.hpp, area.hpp,
/// bending.hpp, wlc.hpp,
/// strain_energy.hpp). Every vertex is written by one task alone: no atomics, and the same bits for any
/// number of threads. Of many cells each is taken through both passes by one task, with the same bits.
#pragma once

#include <cstddef>
#include <memory>

#include "exchange/macros.hpp"
#include "membrane/parameters.hpp"

namespace hemoflux::membrane {

/// Sums over one cell.
struct CellSums {
    double volume = 0;             ///< V, um^3
    double area = 0;               ///< A, um^2
    double total_curvature = 0;    ///< M = sum theta_s L_s, um
    double local_area_energy = 0;  ///< 1e-17 J
    double helfrich_energy = 0;    ///< 1e-17 J
    double shear_energy = 0;       ///< of springs and, hydrostatic and continuum laws, triangles, 1e-17 J
    double overstretched = 0;      ///< positive when a spring has reached its contour length, or on NaN
    double degenerate = 0;         ///< positive when a Voronoi area is not (gompper_kroll.hpp)

    HEMOFLUX_FN CellSums& operator+=(const CellSums& b) {
        volume += b.volume, area += b.area, total_curvature += b.total_curvature;
        local_area_energy += b.local_area_energy, helfrich_energy += b.helfrich_energy;
        shear_energy += b.shear_energy, overstretched += b.overstretched;
        degenerate += b.degenerate;
        return *this;
    }
};

/// Device pointers and scalars of one evaluation. Vertex v of cell c is at c * stride + v; ring slot i of
/// vertex v at i * stride + v, in per-cell data after c * slots * stride.
struct ForceView {
    std::size_t cells, stride, slots;         ///< slots: the greatest degree
    const double *x, *y, *z;                  ///< positions, um
    double *fx, *fy, *fz;                     ///< forces, 1e-11 N
    const int* neighbour;                     ///< slots + 1 rows; from the degree on, neighbour 0 again
    const double* degree;                     ///< of each vertex, 0 in the padding
    const int* group_degree;                  ///< greatest degree in each group of row_alignment vertices
    const double *area0, *inverse_area0;      ///< A_k0 of ring triangles and 1/A_k0, slots rows
    const double *contour, *inverse_contour;  ///< L_c of ring edges and 1/L_c, slots rows
    /// Continuum laws: areas of the rest triangles, their inverses, and their cotangents at the vertex, at n_i
    /// and at n_{i+1}, slots rows.
    const double *rest_area, *inverse_rest_area, *cot_here, *cot_first, *cot_second;
    double* triangle_tension;                ///< hydrostatic and continuum laws: dE_S/dA_k, of each slot
    double *by_curvature, *by_area;          ///< dE/dS_j and dE/dA_j of each vertex of each cell
    double *bend, *spring, *inverse_normal;  ///< theta/L, (dE_S/dL)/L and 1/|xi| of each slot of each cell
    CellSums* sums;                          ///< of each cell
    /// The moduli of ConstraintModuli and BendingModuli.
    double k_volume, k_area, k_local_area, k_bending, k_area_difference;
    /// Added to dE/dM and dE/dA of the cell: -K_B C_0 and K_B C_0^2 / 2 where k_bending is left to
    /// gompper_kroll.hpp, else 0.
    double linear_curvature, linear_area;
    /// V_0, A_0, C_0 and M_0 of one cell.
    double volume0, total_area0, curvature0, total_curvature0;
    NetworkModuli network;
    double stretch_ratio;
};

/// True for the laws of strain_energy.hpp, which need the rest triangles.
constexpr bool is_continuum(InPlaneLaw law) {
    return law == InPlaneLaw::neo_hookean || law == InPlaneLaw::skalak;
}
/// True for the laws that pull on the triangles' areas.
constexpr bool stores_triangle_tension(InPlaneLaw law) {
    return is_continuum(law) || law == InPlaneLaw::wlc_hydrostatic;
}

/// Scratch memory of the sums; one per batch.
class ForceScratch {
  public:
    /// For a batch of so many cells, `stride` elements each.
    ForceScratch(std::size_t cells, std::size_t stride);
    ~ForceScratch();
    ForceScratch(ForceScratch&&) noexcept;
    ForceScratch& operator=(ForceScratch&&) noexcept;

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
    friend void compute_forces(const ForceView& view, ForceScratch& scratch);
};

/// Both passes: fills view.sums and the forces from the positions. The forces of a cell with overstretched > 0
/// are undefined.
void compute_forces(const ForceView& view, ForceScratch& scratch);

}  // namespace hemoflux::membrane
