/// A cell in a file: positions and everything its energies refer to, so that a run that starts from it never
/// recomputes a reference.
///
/// .vtp, besides the surface in um:
///   triangles  rest_area_um2 (A_k0)
///   fields     edge_vertices (two per edge), rest_length_um (L_0), rest_surface_um2 (A_0), rest_volume_um3
///              (V_0), rest_curvature_per_um (C_0), rest_total_curvature_um (M_0), stretch_ratio (r)
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "apps/output/vtk_writer.hpp"
#include "membrane/reference.hpp"

namespace hemoflux::apps {

/// Writes the cell as a .vtp with all its references, further point and triangle arrays, and the time (or
/// force, or whatever orders the frames). FileError.
void write_cell(const std::filesystem::path& path, const membrane::Topology& topology,
                const membrane::Reference& reference, const std::vector<Vec3d>& positions, double time = 0,
                std::vector<output::DataArray> point_data = {},
                std::vector<output::DataArray> triangle_data = {});

/// Whether a file carries references.
bool has_reference(const std::filesystem::path& path);

/// The references in a file. InputError that names the file when it has none, lacks an array, or holds them
/// for other triangles than those of the topology; FileError when it cannot be read.
membrane::Reference read_reference(const std::filesystem::path& path, const membrane::Topology& topology);

}  // namespace hemoflux::apps
