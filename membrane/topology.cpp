#include "membrane/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::membrane {
namespace {

constexpr const char* remedy =
    "Give a closed surface of one piece, its triangles counter-clockwise from outside";

[[noreturn]] void refuse(const std::string& what, const std::string& why) {
    throw InputError(what, why, remedy);
}

std::string name(std::size_t triangle, const meshing::Triangle& corners) {
    return fmt::format("triangle {} ({}, {}, {})", triangle, corners[0], corners[1], corners[2]);
}

/// One triangle seen from one of its corners: the next two corners, counter-clockwise.
struct Wedge {
    int next, last, triangle;
};

/// Orders the wedges around vertex v so that each begins where the one before ended.
void order_ring(std::size_t v, std::vector<Wedge>& wedges) {
    const auto what = [v] { return fmt::format("surface at vertex {}", v); };
    if (wedges.size() < 3)
        refuse(what(), fmt::format("only {} triangles meet there, a surface needs 3", wedges.size()));
    for (std::size_t i = 0; i + 1 < wedges.size(); ++i)
        for (std::size_t k = i + 1; k < wedges.size(); ++k)
            if (wedges[k].next == wedges[i].next)
                refuse(fmt::format("edge {}-{}", v, wedges[i].next),
                       fmt::format("triangles {} and {} both run along it in the same direction",
                                   wedges[i].triangle, wedges[k].triangle));
    for (std::size_t i = 0; i + 1 < wedges.size(); ++i) {
        const auto begin = wedges.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        const auto follower = std::find_if(begin, wedges.end(),
                                           [end = wedges[i].last](const Wedge& w) { return w.next == end; });
        if (follower == wedges.end()) {
            const bool fan = wedges[i].last == wedges.front().next;
            refuse(fan ? what() : fmt::format("edge {}-{}", v, wedges[i].last),
                   fan ? "two separate fans of triangles touch there"
                       : fmt::format("triangle {} has no neighbour across it", wedges[i].triangle));
        }
        std::iter_swap(begin, follower);
    }
    if (wedges.back().last != wedges.front().next)
        refuse(fmt::format("edge {}-{}", v, wedges.back().last),
               fmt::format("triangle {} has no neighbour across it", wedges.back().triangle));
}

}  // namespace

Topology::Topology(std::size_t vertices, std::vector<meshing::Triangle> triangles)
    : triangles_(std::move(triangles)) {
    if (triangles_.size() < 4) refuse("surface", fmt::format("it has {} triangles only", triangles_.size()));
    build_rings(vertices);
    build_edges();
}

void Topology::build_rings(std::size_t vertices) {
    std::vector<std::vector<Wedge>> wedges(vertices);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto& corner = triangles_[t];
        for (int c : corner)
            if (c < 0 || static_cast<std::size_t>(c) >= vertices)
                refuse(name(t, corner), fmt::format("there is no vertex {} among {}", c, vertices));
        for (std::size_t c = 0; c < 3; ++c) {
            if (corner[c] == corner[(c + 1) % 3]) refuse(name(t, corner), "two of its corners are the same");
            wedges[static_cast<std::size_t>(corner[c])].push_back(
                {corner[(c + 1) % 3], corner[(c + 2) % 3], static_cast<int>(t)});
        }
    }
    ring_begin_.assign(1, 0);
    for (std::size_t v = 0; v < vertices; ++v) {
        order_ring(v, wedges[v]);
        for (const Wedge& w : wedges[v]) {
            ring_vertex_.push_back(w.next);
            ring_triangle_.push_back(w.triangle);
        }
        ring_begin_.push_back(ring_vertex_.size());
        max_degree_ = std::max(max_degree_, wedges[v].size());
    }
    std::vector<char> reached(vertices, 0);
    std::vector<int> front{0};
    reached[0] = 1;
    while (!front.empty()) {
        const int v = front.back();
        front.pop_back();
        for (int n : neighbours(static_cast<std::size_t>(v)))
            if (!std::exchange(reached[static_cast<std::size_t>(n)], char(1))) front.push_back(n);
    }
    const auto lost = std::find(reached.begin(), reached.end(), 0);
    if (lost != reached.end())
        refuse("surface", fmt::format("vertex {} is not connected to vertex 0", lost - reached.begin()));
}

void Topology::build_edges() {
    ring_edge_.assign(ring_vertex_.size(), -1);
    for (std::size_t v = 0; v < vertices(); ++v) {
        const auto n = neighbours(v), t = ring_triangles(v);
        for (std::size_t i = 0; i < n.size(); ++i) {
            const auto other = static_cast<std::size_t>(n[i]);
            const auto back = neighbours(other);
            const auto opposite = static_cast<std::size_t>(
                std::find(back.begin(), back.end(), static_cast<int>(v)) - back.begin());
            if (opposite == back.size())
                refuse(fmt::format("edge {}-{}", v, other),
                       fmt::format("triangle {} has no neighbour across it", t[i]));
            if (v < other) {
                const std::size_t before = (i + n.size() - 1) % n.size();
                ring_edge_[ring_begin_[v] + i] = static_cast<int>(edges_.size());
                ring_edge_[ring_begin_[other] + opposite] = static_cast<int>(edges_.size());
                edges_.push_back(
                    {static_cast<int>(v), n[i], n[(i + 1) % n.size()], n[before], t[i], t[before]});
            }
        }
    }
}

}  // namespace hemoflux::membrane
