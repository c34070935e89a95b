/// A fluid grid of either kind, rows of cells or hexahedra, as the time loop sees it, and what joins the nodes of one
/// partner to it. Outermost level only: a step makes a few virtual calls per partner, and the loops behind them know
/// their own grid.
#pragma once

#include <cstddef>
#include <memory>

#include "coupling/delta_kernel.hpp"
#include "coupling/membrane_band.hpp"
#include "coupling/node_box.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// The fluid's fields at the cells, device.
struct FluidFields {
    exchange::FieldView density, velocity;
};

/// Forces of nodes spread to the cells: f_c = sum_m F_m w_mc / V_c  (5.5).
class ForceSpreader {
  public:
    virtual ~ForceSpreader() = default;

    /// Sets `density` (force per volume in the unit of factor * force / um^3) to the spread of factor * force, or adds
    /// it; see Spreader. Always the same field.
    virtual void spread(const exchange::FieldView& force, double factor,
                        const exchange::FieldView& density) = 0;
    /// u += dt f / rho in the cells that the last spread has reached, f the field it was given.
    virtual void accelerate(double dt, const exchange::FieldView& density,
                            const FluidFields& fluid) const = 0;
    /// Makes the next spread clear the whole field, after somebody else wrote to it.
    virtual void forget() {}

  protected:
    ForceSpreader() = default;
    ForceSpreader(const ForceSpreader&) = default;
    ForceSpreader& operator=(const ForceSpreader&) = default;
};

/// Cells and weights of a fixed number of nodes.
class NodeLink {
  public:
    virtual ~NodeLink() = default;

    /// Number of nodes.
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Recomputes the weights for nodes at these positions (device, um).
    virtual void locate(const exchange::FieldView& positions) = 0;
    /// First node that was outside the domain or not a number when last located; size() if there is none.
    [[nodiscard]] virtual std::size_t first_lost() const = 0;
    /// V_m = sum_c w_mc u_c  (5.4), for all nodes.
    virtual void interpolate(const exchange::FieldView& field, const exchange::FieldView& values) const = 0;
    /// A spreader with the same weights. With `first`, it adds to what that one has spread in the same step. The link
    /// and `first` must outlive it.
    [[nodiscard]] virtual std::unique_ptr<ForceSpreader> spreader(ForceSpreader* first) const = 0;

  protected:
    NodeLink() = default;
    NodeLink(const NodeLink&) = default;
    NodeLink& operator=(const NodeLink&) = default;
};

/// A grid of cells of either kind, for what does not run over all of them.
class FluidGrid {
  public:
    virtual ~FluidGrid() = default;

    /// Values per component of a field on this grid.
    [[nodiscard]] virtual std::size_t field_size() const = 0;
    /// Smallest width of a cell, um.
    [[nodiscard]] virtual double smallest() const = 0;
    /// The box around the grid.
    [[nodiscard]] virtual NodeBox box() const = 0;
    /// Whether a point lies in the domain; on periodic axes it may lie anywhere along them.
    [[nodiscard]] virtual bool contains(const Vec3d& at) const = 0;
    /// Volume of the cell that holds a point, or of the nearest one, um^3.
    [[nodiscard]] virtual double cell_volume(const Vec3d& at) const = 0;
    /// sqrt(sum_a (n . a)^2) over the three sides of that cell, n a unit vector: its width along n, um.
    [[nodiscard]] virtual double width(const Vec3d& at, const Vec3d& n) const = 0;

    /// Joins nodes to the grid, which must outlive the link. InputError where a grid cannot serve the kernel.
    [[nodiscard]] virtual std::unique_ptr<NodeLink> link(Kernel kernel, std::size_t nodes) const = 0;
    /// The band around closed surfaces; the grid must outlive it.
    [[nodiscard]] virtual std::unique_ptr<MembraneBand> band(const BandSurfaces& surfaces,
                                                             HalfWidth half_width) const = 0;

  protected:
    FluidGrid() = default;
    FluidGrid(const FluidGrid&) = default;
    FluidGrid(FluidGrid&&) = default;
    FluidGrid& operator=(const FluidGrid&) = default;
    FluidGrid& operator=(FluidGrid&&) = default;
};

}  // namespace hemoflux::coupling
