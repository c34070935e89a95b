/// Local state of a membrane, triangle by triangle and vertex by vertex, for output.
///
/// Triangles, against their reference lengths L_0 (strain_energy.hpp):
///   l_1,2^2 = [I +- (I^2 - 4 J^2)^{1/2}]/2,  I = l_1^2 + l_2^2,  J = l_1 l_2.
/// Tensions of the in-plane law: of a continuum law T_i = 2 dW/dI l_i^2/J + dW/dJ; of springs the virial
///   T = 1/A_k sum_edges 1/2 F_e L_e e e^T  (+ the hydrostatic law's dE/dA_k),  half of each edge's to each side.
/// Vertices: C_j = S_j/A_j of bending.hpp, whatever the bending scheme.
#pragma once

#include <vector>

#include "membrane/batch.hpp"

namespace hemoflux::membrane {

/// One value for each triangle of the topology.
struct TriangleFields {
    std::vector<double> area_strain;                   ///< A_k/A_k0 - 1
    std::vector<double> major_stretch, minor_stretch;  ///< l_1 >= l_2; 0 where L_0 make no triangle
    std::vector<double> major_tension, minor_tension;  ///< principal tensions of the law, 1e-5 N/m
    std::vector<double> area_tension;                  ///< isotropic, of K_A and K_A,k, 1e-5 N/m
};

/// One value for each vertex.
struct VertexFields {
    std::vector<double> curvature;    ///< C_j = c_1 + c_2, 1/um, positive where convex
    std::vector<double> area_strain;  ///< of its triangles together
};

/// Of one cell of the batch at its present positions.
TriangleFields triangle_fields(const Batch& batch, std::size_t cell);
VertexFields vertex_fields(const Batch& batch, std::size_t cell);

}  // namespace hemoflux::membrane
