#include "apps/cell_builder.hpp"

#include <cmath>

#include "apps/cell_surface.hpp"
#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::apps {
namespace {

/// Internal units of the membrane in SI.
constexpr double tension_unit = 1e-5;             // N/m
constexpr double pressure_unit = 10;              // Pa
constexpr double energy_unit = 1e-17;             // J
constexpr double surface_viscosity_unit = 1e-10;  // Pa s m

/// Fills in what the input says about a reference whose rest lengths and areas are known: A0, V0, r, C_0 =
/// c0/R0 and M0 in units of 8 pi R0.
membrane::Reference completed(membrane::Reference reference, const CellInput& cell) {
    const double radius = std::sqrt(cell.area / (4 * M_PI));  // R0 (6.43)
    reference.area = cell.area;
    reference.volume = cell.volume;
    reference.stretch_ratio = cell.spring_ratio;
    reference.curvature = cell.spontaneous_curvature / radius;
    reference.total_curvature = cell.relaxed_area_difference * 8 * M_PI * radius;
    return reference;
}

/// The vertices of the spheroid of reference = "spheroid".
std::vector<Vec3d> reference_spheroid(const CellInput& cell) {
    const meshing::SpheroidAxes axes = meshing::oblate_axes(cell.area, cell.reference_reduced_volume);
    return meshing::spheroid(sphere_mesh(cell), axes).vertices;
}

std::vector<Vec3d> reference_file(const CellInput& cell) {
    CellInput file = cell;
    file.shape = CellShape::file;
    file.file = cell.reference_file;
    return start_shape(file).vertices;
}

}  // namespace

membrane::Parameters membrane_parameters(const CellInput& cell) {
    membrane::Parameters p;
    p.constraint = {cell.volume_modulus / pressure_unit, cell.area_modulus / tension_unit,
                    cell.local_area_modulus / tension_unit};
    p.bending = {cell.bending_modulus / energy_unit, cell.ade_modulus / energy_unit};
    p.network = {cell.shear_modulus / tension_unit, cell.membrane_viscosity / surface_viscosity_unit};
    return p;
}

membrane::Cell build_cell(const CellInput& cell, const membrane::RelaxOptions& options) {
    const meshing::SurfaceMesh start = start_shape(cell);
    membrane::Cell result;
    result.topology = std::make_shared<const membrane::Topology>(start);
    result.parameters = membrane_parameters(cell);
    const membrane::Topology& topology = *result.topology;
    const auto from_shape = [&](const std::vector<Vec3d>& shape) {
        return completed(membrane::reference_from_shape(topology, shape), cell);
    };

    std::vector<Vec3d> rest = start.vertices;
    if (cell.shape == CellShape::discocyte) {
        membrane::Batch batch(result.topology, result.parameters, from_shape(reference_spheroid(cell)));
        batch.set_positions(0, rest);
        result.relaxation = membrane::relax(batch, options);
        rest = batch.positions(0);
    }
    switch (cell.reference) {
        case MembraneReference::stress_free:
            result.reference = from_shape(rest);
            break;
        case MembraneReference::uniform:
            result.reference = completed(
                membrane::uniform_length_reference(topology, rest, cell.spring_length.value_or(0)), cell);
            break;
        case MembraneReference::spheroid:
            result.reference = from_shape(reference_spheroid(cell));
            break;
        case MembraneReference::file:
            result.reference = from_shape(reference_file(cell));
            break;
    }
    if (cell.shape == CellShape::discocyte) {
        membrane::Batch batch(result.topology, result.parameters, result.reference);
        batch.set_positions(0, rest);
        result.relaxation = membrane::relax(batch, options);
        rest = batch.positions(0);
    }
    const Vec3d centroid = membrane::shape_moments(topology.triangles(), rest).centroid;
    for (Vec3d& r : rest) {
        r -= centroid;
    }
    result.positions = std::move(rest);
    return result;
}

}  // namespace hemoflux::apps
