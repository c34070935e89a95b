/// Numbering of cells that keeps neighbours near each other in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace hemoflux::meshing {

/// A graph in compressed rows: the neighbours of node i are to[first[i] .. first[i + 1]).
struct Graph {
    std::vector<std::uint32_t> first, to;

    /// Number of nodes.
    [[nodiscard]] std::size_t nodes() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Reverse Cuthill-McKee: order[new number] = old number. Each connected part starts from a node far from all
/// others (George and Liu 1979); ties go to the lower old number, so the result is determined.
std::vector<std::uint32_t> reverse_cuthill_mckee(const Graph& graph);

}  // namespace hemoflux::meshing
