/// Which corners of which triangles meet at each vertex of a surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hemoflux::coupling {

/// Vertex v has the entries begin[v] .. begin[v + 1] - 1 of `corner`: 3 t + c for corner c of triangle t.
struct TriangleRings {
    std::vector<int> begin, corner;
    /// vertices: of the arrays, padding included; padding has no entries.
    TriangleRings(const std::vector<std::array<int, 3>>& triangles, std::size_t vertices)
        : begin(vertices + 1, 0), corner(3 * triangles.size()) {
        for (const auto& t : triangles)
            for (const int v : t) ++begin[static_cast<std::size_t>(v) + 1];
        for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
        std::vector<int> next(begin.begin(), begin.end() - 1);
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c)
                corner[static_cast<std::size_t>(next[static_cast<std::size_t>(triangles[t][c])]++)] =
                    static_cast<int>(3 * t + c);
    }
};

}  // namespace hemoflux::coupling
