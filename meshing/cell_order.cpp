#include "meshing/cell_order.hpp"

#include <algorithm>

namespace hemoflux::meshing {
namespace {

std::uint32_t degree(const Graph& graph, std::uint32_t i) { return graph.first[i + 1] - graph.first[i]; }

/// Breadth-first search that can be repeated without clearing its marks.
class Search {
  public:
    explicit Search(const Graph& graph) : graph_(graph), seen_(graph.nodes(), 0) {}

    /// Visits the part of `start`; the distance of the farthest nodes. `visited` holds the part in order of
    /// distance, then of the parent, then of degree: the order of Cuthill and McKee.
    std::uint32_t run(std::uint32_t start, std::vector<std::uint32_t>& visited) {
        ++mark_;
        visited.assign(1, start);
        seen_[start] = mark_;
        std::uint32_t depth = 0;
        last_level_ = 0;
        for (std::size_t begin = 0, end = 1; begin < end; begin = end, end = visited.size()) {
            last_level_ = begin;
            for (std::size_t k = begin; k < end; ++k) add_neighbours(visited[k], visited);
            if (visited.size() > end) ++depth;
        }
        return depth;
    }

    /// Among the farthest nodes of the last search, the one with fewest neighbours.
    [[nodiscard]] std::uint32_t farthest(const std::vector<std::uint32_t>& visited) const {
        return *std::min_element(visited.begin() + static_cast<std::ptrdiff_t>(last_level_), visited.end(),
                                 [this](std::uint32_t a, std::uint32_t b) { return before(a, b); });
    }

  private:
    [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b) const {
        const std::uint32_t da = degree(graph_, a), db = degree(graph_, b);
        return da != db ? da < db : a < b;
    }

    void add_neighbours(std::uint32_t node, std::vector<std::uint32_t>& visited) {
        const auto begin = static_cast<std::ptrdiff_t>(visited.size());
        for (std::uint32_t e = graph_.first[node]; e < graph_.first[node + 1]; ++e) {
            if (seen_[graph_.to[e]] == mark_) continue;
            seen_[graph_.to[e]] = mark_;
            visited.push_back(graph_.to[e]);
        }
        std::sort(visited.begin() + begin, visited.end(),
                  [this](std::uint32_t a, std::uint32_t b) { return before(a, b); });
    }

    const Graph& graph_;
    std::vector<std::uint32_t> seen_;
    std::uint32_t mark_ = 0;
    std::size_t last_level_ = 0;
};

}  // namespace

std::vector<std::uint32_t> reverse_cuthill_mckee(const Graph& graph) {
    std::vector<std::uint32_t> order, part;
    std::vector<bool> done(graph.nodes(), false);
    Search search(graph);
    for (std::uint32_t seed = 0; seed < graph.nodes(); ++seed) {
        if (done[seed]) continue;
        std::uint32_t start = seed, depth = search.run(start, part);
        while (true) {
            const std::uint32_t end = search.farthest(part), deeper = search.run(end, part);
            if (deeper <= depth) break;
            start = end;
            depth = deeper;
        }
        search.run(start, part);
        for (const std::uint32_t node : part) done[node] = true;
        order.insert(order.end(), part.begin(), part.end());
    }
    std::reverse(order.begin(), order.end());
    return order;
}

}  // namespace hemoflux::meshing
