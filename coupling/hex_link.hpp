/// Nodes joined to hexahedra: places found by walking, weights by moving least squares, forces gathered cell by cell.
///
/// Spreading is a sum per fluid cell over the nodes of the cells around it, in the order of (cell, node): no atomics, the
/// same for any number of threads. Which cells are around which is listed for the cells that hold nodes and their
/// neighbours, anew only when a node leaves these.
#pragma once

#include <vector>

#include "coupling/hex_cells.hpp"

namespace hemoflux::coupling {

/// Where a node is; its weights stand in an array beside.
struct HexStencil {
    HexPlace place;
    /// Whether the node lies outside the domain or is not a number; its weights are then zero.
    bool lost = false;
};

/// Nodes on an unstructured grid.
class HexLink final : public NodeLink {
  public:
    /// `cells` must outlive the link. InputError as window_shape(), or where a cell has too few others around it for
    /// the first moments.
    HexLink(const HexCells& cells, Kernel kernel, std::size_t nodes);

    [[nodiscard]] std::size_t size() const override { return stencils_.size(); }
    void locate(const exchange::FieldView& positions) override;
    [[nodiscard]] std::size_t first_lost() const override;
    void interpolate(const exchange::FieldView& field, const exchange::FieldView& values) const override;
    [[nodiscard]] std::unique_ptr<ForceSpreader> spreader(ForceSpreader* first) const override;

    /// The cells that hold the nodes; on the host.
    [[nodiscard]] std::vector<HexStencil> stencils() const { return stencils_.to_host(); }
    /// The weights of their candidates, width() to a node; on the host.
    [[nodiscard]] std::vector<double> weights() const { return weights_.to_host(); }
    /// Weights kept for a node.
    [[nodiscard]] std::size_t width() const { return around_.width(); }

  private:
    friend class HexSpreader;

    /// Looks for lost nodes again from the cells nearest to them.
    void seek(const exchange::FieldView& positions);
    void build(const exchange::FieldView& positions, int most_steps);
    void list_sources();
    void refuse_thin_cells() const;

    const HexCells& cells_;
    const HexNeighbourhood& around_;
    Kernel kernel_;
    bool located_ = false;
    exchange::Buffer<HexStencil> stencils_;
    exchange::Buffer<double> weights_;
    /// The positions located last; bodies at rest are not located again.
    exchange::Buffer<double> last_[3];
    /// Sources: cells that hold nodes or may soon. slot_: number of each cell among them, or -1; nodes sorted by it; where
    /// the nodes of each source begin.
    std::vector<std::uint32_t> sources_;
    exchange::Buffer<int> slot_, key_, order_, start_;
    /// Cells that the sources reach; for each, from begin_ on, the sources and the place of the cell in their lists.
    exchange::Buffer<std::uint32_t> target_, begin_, source_, place_;
};

}  // namespace hemoflux::coupling
