/// Connectivity of a closed triangulated surface: built once, immutable, shared by all cells of one mesh.
///
/// An edge runs from vertex 1 to vertex 2 as its triangle a = (1, 2, 3) does, which is counter-clockwise seen
/// from outside; the triangle on its other side is b = (2, 1, 4). The ring of a vertex lists its neighbours
/// counter-clockwise, so that ring triangle i is (vertex, n_i, n_{i+1}) and ring edge i joins vertex and n_i.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "meshing/surface_mesh.hpp"

namespace hemoflux::membrane {

/// One edge: its end vertices v1, v2, the vertices v3, v4 opposite to it, and its triangles a (left), b
/// (right).
struct Edge {
    int v1, v2, v3, v4, a, b;
};

/// Immutable connectivity of one closed, connected, oriented 2-manifold of triangles.
class Topology {
  public:
    /// Builds the connectivity of `vertices` vertices from counter-clockwise triangles. Throws InputError
    /// that names the offending triangle or vertex when the surface is not closed, not consistently oriented,
    /// not a 2-manifold or not in one piece.
    Topology(std::size_t vertices, std::vector<meshing::Triangle> triangles);
    /// The connectivity of a mesh, as above.
    explicit Topology(const meshing::SurfaceMesh& mesh) : Topology(mesh.vertices.size(), mesh.triangles) {}

    /// Number of vertices.
    [[nodiscard]] std::size_t vertices() const { return ring_begin_.size() - 1; }
    /// All triangles, as given.
    [[nodiscard]] const std::vector<meshing::Triangle>& triangles() const { return triangles_; }
    /// All edges, ordered by (v1, v2) with v1 < v2.
    [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
    /// Greatest number of neighbours of a vertex.
    [[nodiscard]] std::size_t max_degree() const { return max_degree_; }
    /// Number of neighbours of vertex v.
    [[nodiscard]] std::size_t degree(std::size_t v) const { return ring_begin_[v + 1] - ring_begin_[v]; }

    /// Neighbours n_0 .. n_{d-1} of vertex v, counter-clockwise seen from outside.
    [[nodiscard]] std::span<const int> neighbours(std::size_t v) const { return ring(ring_vertex_, v); }
    /// Triangles (v, n_i, n_{i+1}) around vertex v.
    [[nodiscard]] std::span<const int> ring_triangles(std::size_t v) const { return ring(ring_triangle_, v); }
    /// Edges between v and n_i.
    [[nodiscard]] std::span<const int> ring_edges(std::size_t v) const { return ring(ring_edge_, v); }

  private:
    [[nodiscard]] std::span<const int> ring(const std::vector<int>& values, std::size_t v) const {
        return {values.data() + ring_begin_[v], degree(v)};
    }
    void build_rings(std::size_t vertices);
    void build_edges();

    std::vector<meshing::Triangle> triangles_;
    std::vector<Edge> edges_;
    std::vector<std::size_t> ring_begin_;
    std::vector<int> ring_vertex_, ring_triangle_, ring_edge_;
    std::size_t max_degree_ = 0;
};

}  // namespace hemoflux::membrane
