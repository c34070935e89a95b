#include "meshing/cell_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "meshing/hex_box.hpp"
#include "meshing/hex_quality.hpp"

namespace hemoflux::meshing {
namespace {

Graph path(const std::vector<std::uint32_t>& names) {
    std::vector<std::vector<std::uint32_t>> neighbours(names.size());
    for (std::size_t i = 1; i < names.size(); ++i) {
        neighbours[names[i]].push_back(names[i - 1]);
        neighbours[names[i - 1]].push_back(names[i]);
    }
    Graph graph{{0}, {}};
    for (const auto& list : neighbours) {
        graph.to.insert(graph.to.end(), list.begin(), list.end());
        graph.first.push_back(static_cast<std::uint32_t>(graph.to.size()));
    }
    return graph;
}

/// Largest difference of the numbers of two neighbours when numbered by `order`.
std::size_t bandwidth(const Graph& graph, const std::vector<std::uint32_t>& order) {
    std::vector<std::size_t> number(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = i;
    std::size_t widest = 0;
    for (std::uint32_t i = 0; i < graph.nodes(); ++i) {
        for (std::uint32_t e = graph.first[i]; e < graph.first[i + 1]; ++e) {
            const std::size_t a = number[i], b = number[graph.to[e]];
            widest = std::max(widest, a > b ? a - b : b - a);
        }
    }
    return widest;
}

TEST(CellOrder, PathIsNumberedFromEndToEnd) {
    const Graph graph = path({3, 0, 5, 1, 6, 2, 4});
    std::vector<std::uint32_t> order(7);
    std::iota(order.begin(), order.end(), 0U);
    EXPECT_EQ(bandwidth(graph, order), 5U);
    order = reverse_cuthill_mckee(graph);
    EXPECT_EQ(bandwidth(graph, order), 1U);
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < 7; ++i) EXPECT_EQ(order[i], i);
}

TEST(CellOrder, PartsAndLonelyNodesAreAllNumbered) {
    Graph graph = path({0, 1, 2});
    graph.first.push_back(graph.first.back());
    std::vector<std::uint32_t> order = reverse_cuthill_mckee(graph);
    EXPECT_EQ(bandwidth(graph, order), 1U);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(reverse_cuthill_mckee(Graph{}).empty());
}

TEST(CellOrder, ShuffledBoxGetsTheBandwidthOfItsLayers) {
    // levels of a breadth-first search through an n^3 box are diagonal planes of at most 3/4 n^2 cells
    const int n = 12;
    const HexMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {n, n, n}, {.shuffle = true, .seed = 3});
    const HexGrid grid = make_hex_grid(mesh);
    EXPECT_LE(quality(grid).bandwidth, 3U * n * n / 4 + n);
    std::size_t before = 0;
    for (std::size_t f = 0; f < grid.interior_faces(); ++f) {
        const std::size_t a = grid.original[grid.left[f]], b = grid.original[grid.right[f]];
        before = std::max(before, a > b ? a - b : b - a);
    }
    EXPECT_GT(before, 10U * n * n);
}

}  // namespace
}  // namespace hemoflux::meshing
