/// Per-slot tables of a topology for the force kernels: element i * stride + v is slot i of vertex v's ring,
/// stride = vertices() rounded up to exchange::row_alignment.
#pragma once

#include <cstddef>
#include <vector>

#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// Elements of one row: vertices, padded.
std::size_t ring_stride(const Topology& topology);

/// Ring neighbours, max_degree() + 1 rows: row i holds n_i of every vertex, and n_0 from its degree on.
std::vector<int> neighbour_rows(const Topology& topology);

/// Degree of every vertex, 0 in the padding.
std::vector<double> degree_row(const Topology& topology);

/// Greatest degree in each group of row_alignment vertices.
std::vector<int> group_degrees(const Topology& topology);

/// factor * value of the ring's triangles, or its inverse; 1 where a ring has ended.
std::vector<double> triangle_rows(const Topology& topology, const std::vector<double>& values, double factor,
                                  bool inverse);

/// As triangle_rows, for the ring's edges.
std::vector<double> edge_rows(const Topology& topology, const std::vector<double>& values, double factor,
                              bool inverse);

/// Rest state of the continuum laws, from the edge lengths alone (strain_energy.hpp).
struct RestTriangles {
    std::vector<double> areas;  ///< of each triangle of the topology, um^2
    /// Cotangents of the rest triangle (v, n_i, n_{i+1}) at v, n_i and n_{i+1}, by slot.
    std::vector<double> cot_here, cot_first, cot_second;
};

/// Throws InputError that names the triangle whose three lengths (um) make none.
RestTriangles rest_triangles(const Topology& topology, const std::vector<double>& edge_lengths);

}  // namespace hemoflux::membrane
