/// Any number of cells of one kind: one topology, one set of moduli, one reference, many shapes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/vec3.hpp"
#include "membrane/forces.hpp"
#include "membrane/gompper_kroll.hpp"
#include "membrane/parameters.hpp"
#include "membrane/reference.hpp"
#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// Energies of one cell by term, 1e-17 J, (6.1).
struct Energies {
    double volume, area, local_area, bending, area_difference, shear;
    /// E, their sum.
    [[nodiscard]] double total() const {
        return volume + area + local_area + bending + area_difference + shear;
    }
};

/// Owns the positions and forces of its cells on the device and evaluates the forces of all of them at once.
/// Vertex v of cell c is element c * stride() + v of every buffer; the padding behind the last vertex of a
/// cell has zero force and may hold anything.
class Batch {
  public:
    /// Cells at the origin (set their positions before computing). Throws InputError when the parameters or
    /// the reference are wrong or do not fit the topology, or when cells = 0.
    Batch(std::shared_ptr<const Topology> topology, const Parameters& parameters, const Reference& reference,
          std::size_t cells = 1);

    /// Number of cells.
    [[nodiscard]] std::size_t cells() const { return cells_; }
    /// Vertices of one cell.
    [[nodiscard]] std::size_t vertices() const { return topology_->vertices(); }
    /// Elements from one cell to the next; vertices() rounded up to exchange::row_alignment.
    [[nodiscard]] std::size_t stride() const { return stride_; }
    /// Of every cell, as are the moduli and the reference.
    [[nodiscard]] const Topology& topology() const { return *topology_; }
    [[nodiscard]] std::shared_ptr<const Topology> shared_topology() const { return topology_; }
    [[nodiscard]] const Parameters& parameters() const { return parameters_; }
    [[nodiscard]] const Reference& reference() const { return reference_; }

    /// Replaces the moduli of all cells. InputError when they are wrong.
    void set_parameters(const Parameters& parameters);
    /// Replaces the reference of all cells. InputError when it is wrong or does not fit.
    void set_reference(const Reference& reference);

    /// Positions of all vertices of all cells on the device, um.
    exchange::Buffer<double>& x() { return x_; }
    exchange::Buffer<double>& y() { return y_; }
    exchange::Buffer<double>& z() { return z_; }
    [[nodiscard]] const exchange::Buffer<double>& x() const { return x_; }
    [[nodiscard]] const exchange::Buffer<double>& y() const { return y_; }
    [[nodiscard]] const exchange::Buffer<double>& z() const { return z_; }
    /// Forces on all vertices of all cells on the device, 1e-11 N, as of the last compute_forces().
    [[nodiscard]] const exchange::Buffer<double>& fx() const { return fx_; }
    [[nodiscard]] const exchange::Buffer<double>& fy() const { return fy_; }
    [[nodiscard]] const exchange::Buffer<double>& fz() const { return fz_; }

    /// Copies the vertices of one cell from the host. std::length_error unless there are vertices() of them.
    void set_positions(std::size_t cell, const std::vector<Vec3d>& positions);
    /// Copies of one cell's vertices and forces on the host.
    [[nodiscard]] std::vector<Vec3d> positions(std::size_t cell) const;
    [[nodiscard]] std::vector<Vec3d> forces(std::size_t cell) const;

    /// Forces -grad E of all terms at the current positions. Throws NumericalError that names cell, edge,
    /// vertices and length when a spring has reached its contour length, a position is not a number, or a Voronoi area
    /// is not positive.
    void compute_forces();
    /// As compute_forces(), but returns false, with the forces undefined, where that one throws.
    [[nodiscard]] bool try_compute_forces();

    /// Volume, area, total curvature and energies of one cell, as of the last compute_forces().
    [[nodiscard]] const CellSums& sums(std::size_t cell) const { return sums_[cell]; }
    /// Energies of one cell by term, likewise.
    [[nodiscard]] Energies energies(std::size_t cell) const;

    /// Device pointers and scalars, for the kernels of this room.
    [[nodiscard]] ForceView view();

  private:
    LaplacianView laplacian();
    void prepare_law();
    void prepare_bending();
    [[noreturn]] void report_failure() const;
    [[nodiscard]] double linear_curvature() const;
    [[nodiscard]] double linear_area() const;
    [[nodiscard]] bool laplacian_bending() const {
        return parameters_.bending.scheme == BendingScheme::gompper_kroll;
    }

    std::shared_ptr<const Topology> topology_;
    Parameters parameters_;
    Reference reference_;
    std::size_t cells_, stride_;
    exchange::Buffer<double> x_, y_, z_, fx_, fy_, fz_;
    exchange::Buffer<int> neighbour_, group_degree_;
    exchange::Buffer<double> degree_, area0_, inverse_area0_, contour_, inverse_contour_;
    exchange::Buffer<double> rest_area_, inverse_rest_area_, cot_here_, cot_first_, cot_second_;
    exchange::Buffer<double> triangle_tension_;
    exchange::Buffer<double> by_curvature_, by_area_, bend_, spring_, inverse_normal_;
    exchange::Buffer<CellSums> device_sums_;
    std::vector<CellSums> sums_;
    ForceScratch scratch_;
    exchange::Buffer<double> hx_, hy_, hz_;  // for gompper_kroll.hpp only
    exchange::Buffer<CellSums> laplacian_sums_;
    std::unique_ptr<LaplacianScratch> laplacian_scratch_;
};

}  // namespace hemoflux::membrane
