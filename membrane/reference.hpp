/// The state a membrane strives for: explicit, stored data, never recomputed from the current shape.
#pragma once

#include <vector>

#include "exchange/vec3.hpp"
#include "membrane/parameters.hpp"
#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// Reference values of all energies of one cell.
struct Reference {
    double area = red_blood_cell::area;                    ///< A_0, um^2
    double volume = red_blood_cell::volume;                ///< V_0, um^3
    double curvature = 0;                                  ///< C_0, local c_1 + c_2, 1/um
    double total_curvature = 0;                            ///< M_0, of sum theta_s L_s, um
    double stretch_ratio = red_blood_cell::stretch_ratio;  ///< r = L_c / L_0
    std::vector<double> triangle_areas;                    ///< A_k0 of each triangle of the topology, um^2
    std::vector<double> edge_lengths;                      ///< L_0 of each edge of the topology, um

    /// Throws InputError unless all values are finite, areas, lengths and volume positive, r > 1, and the
    /// two lists match the topology.
    void check(const Topology& topology) const;
};

/// Area of each triangle, um^2.
std::vector<double> triangle_areas(const Topology& topology, const std::vector<Vec3d>& positions);

/// Length of each edge, um.
std::vector<double> edge_lengths(const Topology& topology, const std::vector<Vec3d>& positions);

/// Rest values of the whole cell, which no shape gives; those of a healthy red blood cell, Tables 6.1 and 6.2.
struct RestState {
    double area = red_blood_cell::area;                            ///< A_0, um^2
    double volume = red_blood_cell::volume;                        ///< V_0, um^3
    double reduced_curvature = red_blood_cell::reduced_curvature;  ///< c_0 = C_0 R_0
    double area_difference = 1;                                    ///< M_0 over 8 pi R_0
    double stretch_ratio = red_blood_cell::stretch_ratio;          ///< r

    /// R_0 = sqrt(A_0 / 4 pi), um (6.43).
    [[nodiscard]] double radius() const;
};

/// A_0, V_0, r, C_0 = c_0/R_0 and M_0 of `rest`; A_k0 and L_0 are those of `shape`, which shares the topology.
/// A spheroid of semi-axes 1.13360 R_0 (1, 1, 0.65214) gives the discocyte; the relaxed discocyte itself gives the
/// stress-free cell.
Reference reference_from_shape(const Topology& topology, const std::vector<Vec3d>& shape,
                               const RestState& rest = {});

/// Length of the pre-stressed springs over the mean edge, on any mesh: 0.285 um over 0.246 um at 2562
/// vertices.
inline constexpr double uniform_length_ratio = 1.16;

/// Edge of the equilateral triangle of the mean area, um: the mean edge of a shape however its triangles are
/// drawn out (a relaxed disc's arithmetic mean edge is 2 % longer).
double mean_edge(const Topology& topology, const std::vector<Vec3d>& positions);

/// As reference_from_shape of a relaxed disc, but with the same L_0 on every edge: `length` um, or 1.16 times
/// the disc's mean_edge() when length is 0 (Table 6.2), and the same A_k0 on every triangle, the disc's mean.
/// Table 6.2 gives no A_k0. Those of the disc would remember which part of the membrane was the rim, so that a
/// tank-treading cell swings; equal ones go with equal lengths and leave almost no shape memory.
Reference uniform_length_reference(const Topology& topology, const std::vector<Vec3d>& disc,
                                   double length = 0, const RestState& rest = {});

/// Spectrin network of one cell from which coarse_grained_length() starts: vertices and length of a link, um.
inline constexpr double spectrin_vertices = 27344, spectrin_length = 0.075;

/// Rest length of all springs, um, of a network of `vertices` in place of the spectrin's (Pivkin and
/// Karniadakis, Phys. Rev. Lett. 101, 118105, 2008), of a cell of A_0 = `area`:
///   L_0 = l_f [(N_f - 2)/(N - 2)]^{1/2} (A_0/134 um^2)^{1/2},  N_f = 27344, l_f = 75 nm,
/// 0.245 um at 2562 vertices (the thesis quotes 0.228 um without its N_f and l_f).
double coarse_grained_length(std::size_t vertices, double area = red_blood_cell::area);

/// Reduced volume of the spheroid of area A_0 from which the discocyte takes L_0 and A_k0.
inline constexpr double reference_reduced_volume = 0.95;

}  // namespace hemoflux::membrane
