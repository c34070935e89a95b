#include "membrane/ring_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::membrane {
namespace {

template <class Ring>
std::vector<double> slot_rows(const Topology& topology, Ring ring, const std::vector<double>& values,
                              double factor, bool inverse) {
    const std::size_t stride = ring_stride(topology);
    std::vector<double> table(topology.max_degree() * stride, 1.0);
    for (std::size_t v = 0; v < topology.vertices(); ++v) {
        const auto items = ring(v);
        for (std::size_t i = 0; i < items.size(); ++i) {
            const double value = factor * values[static_cast<std::size_t>(items[i])];
            table[i * stride + v] = inverse ? 1 / value : value;
        }
    }
    return table;
}

/// The edge between two neighbours.
std::size_t edge_between(const Topology& topology, int a, int b) {
    const auto ring = topology.neighbours(static_cast<std::size_t>(a));
    const auto place = std::find(ring.begin(), ring.end(), b) - ring.begin();
    return static_cast<std::size_t>(
        topology.ring_edges(static_cast<std::size_t>(a))[static_cast<std::size_t>(place)]);
}

}  // namespace

std::size_t ring_stride(const Topology& topology) {
    return exchange::round_up(topology.vertices(), exchange::row_alignment);
}

std::vector<int> neighbour_rows(const Topology& topology) {
    const std::size_t stride = ring_stride(topology), rows = topology.max_degree() + 1;
    std::vector<int> table(rows * stride, 0);
    for (std::size_t v = 0; v < topology.vertices(); ++v) {
        const auto ring = topology.neighbours(v);
        for (std::size_t i = 0; i < rows; ++i) table[i * stride + v] = i < ring.size() ? ring[i] : ring[0];
    }
    return table;
}

std::vector<double> degree_row(const Topology& topology) {
    std::vector<double> table(ring_stride(topology), 0.0);
    for (std::size_t v = 0; v < topology.vertices(); ++v) table[v] = static_cast<double>(topology.degree(v));
    return table;
}

std::vector<int> group_degrees(const Topology& topology) {
    std::vector<int> table(ring_stride(topology) / exchange::row_alignment, 0);
    for (std::size_t v = 0; v < topology.vertices(); ++v) {
        int& group = table[v / exchange::row_alignment];
        group = std::max(group, static_cast<int>(topology.degree(v)));
    }
    return table;
}

std::vector<double> triangle_rows(const Topology& topology, const std::vector<double>& values, double factor,
                                  bool inverse) {
    return slot_rows(
        topology, [&](std::size_t v) { return topology.ring_triangles(v); }, values, factor, inverse);
}

std::vector<double> edge_rows(const Topology& topology, const std::vector<double>& values, double factor,
                              bool inverse) {
    return slot_rows(
        topology, [&](std::size_t v) { return topology.ring_edges(v); }, values, factor, inverse);
}

RestTriangles rest_triangles(const Topology& topology, const std::vector<double>& edge_lengths) {
    const std::size_t stride = ring_stride(topology), slots = topology.max_degree();
    RestTriangles rest{.areas = std::vector<double>(topology.triangles().size()),
                       .cot_here = std::vector<double>(slots * stride, 1.0),
                       .cot_first = std::vector<double>(slots * stride, 1.0),
                       .cot_second = std::vector<double>(slots * stride, 1.0)};
    for (std::size_t v = 0; v < topology.vertices(); ++v) {
        const auto n = topology.neighbours(v), triangles = topology.ring_triangles(v),
                   edges = topology.ring_edges(v);
        for (std::size_t i = 0; i < n.size(); ++i) {
            const std::size_t k = (i + 1) % n.size();
            const double first = edge_lengths[static_cast<std::size_t>(edges[i])],
                         second = edge_lengths[static_cast<std::size_t>(edges[k])],
                         rim = edge_lengths[edge_between(topology, n[i], n[k])];
            const double half = 0.5 * (first + second + rim);
            const double heron = half * (half - first) * (half - second) * (half - rim);
            if (!(heron > 0))
                throw InputError(
                    fmt::format("reference triangle {} of vertices {}, {}, {}", triangles[i], v, n[i], n[k]),
                    fmt::format("edges of {:.6g}, {:.6g} and {:.6g} um make no triangle", first, second, rim),
                    "Give reference lengths that a shape can have, or use a spring law");
            const double area = std::sqrt(heron), quarter = 0.25 / area;
            rest.areas[static_cast<std::size_t>(triangles[i])] = area;
            const std::size_t at = i * stride + v;
            rest.cot_here[at] = quarter * (first * first + second * second - rim * rim);
            rest.cot_first[at] = quarter * (first * first + rim * rim - second * second);
            rest.cot_second[at] = quarter * (second * second + rim * rim - first * first);
        }
    }
    return rest;
}

}  // namespace hemoflux::membrane
