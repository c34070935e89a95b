/// Short-range forces between the membranes of different cells, and between cells and walls (contact_law.hpp).
///
/// Every node gathers from the nodes near it: no atomics, and for every pair the two forces are computed from the same
/// numbers with opposite signs, so that they cancel exactly. A cell that reaches round a periodic box meets its own image
/// as it meets another cell.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "coupling/contact_law.hpp"
#include "coupling/node_bins.hpp"
#include "exchange/buffer.hpp"

namespace hemoflux::coupling {

/// Area that each node stands for: a third of its triangles' areas. areas: of each triangle, um^2.
std::vector<double> node_areas(const std::vector<std::array<int, 3>>& triangles,
                               const std::vector<double>& areas, std::size_t vertices);

/// Adds the forces; keeps the memory it needs between steps.
class Contact {
  public:
    /// node_areas: of the vertices of one cell, um^2; the vertices of cell c begin at c * stride. InputError as
    /// ContactOptions::check and NodeBins.
    Contact(const NodeBox& box, const ContactOptions& options, const std::vector<double>& node_areas,
            std::size_t cells, std::size_t stride);
    ~Contact();

    /// Adds the forces (1e-11 N) on nodes at x, y, z (um) to fx, fy, fz; all on the device.
    void add_forces(const double* x, const double* y, const double* z, double* fx, double* fy, double* fz);
    /// Energy of all contacts, 1e-17 J, where forces were last computed.
    [[nodiscard]] double energy();
    /// Force of the cells on the walls, 1e-11 N, where forces were last computed.
    [[nodiscard]] Vec3d wall_force();

  private:
    struct Scratch;

    NodeBins bins_;
    ContactLaw law_;
    bool walls_;
    exchange::Buffer<double> area_;
    std::size_t stride_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace hemoflux::coupling
