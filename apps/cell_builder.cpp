#include "apps/cell_builder.hpp"

#include "apps/cell_file.hpp"
#include "apps/cell_surface.hpp"

namespace hemoflux::apps {
namespace {

/// Internal units of the membrane in SI.
constexpr double tension_unit = 1e-5;             // N/m
constexpr double pressure_unit = 10;              // Pa
constexpr double energy_unit = 1e-17;             // J
constexpr double surface_viscosity_unit = 1e-10;  // Pa s m

/// What "auto" means for this cell.
MembraneReference reference_of(const CellInput& cell) {
    if (cell.reference != MembraneReference::automatic) return cell.reference;
    if (cell.shape != CellShape::file) return MembraneReference::uniform;
    return has_reference(cell.file) ? MembraneReference::stored : MembraneReference::stress_free;
}

membrane::ReferenceKind kind_of(MembraneReference reference) {
    switch (reference) {
        case MembraneReference::uniform:
            return membrane::ReferenceKind::uniform_length;
        case MembraneReference::coarse_grained:
            return membrane::ReferenceKind::coarse_grained;
        case MembraneReference::spheroid:
            return membrane::ReferenceKind::spheroid;
        case MembraneReference::file:
            return membrane::ReferenceKind::given;
        default:
            return membrane::ReferenceKind::stress_free;
    }
}

/// The stored reference, but for what the input says otherwise.
membrane::Reference stored_reference(const CellInput& cell, const membrane::Topology& topology) {
    membrane::Reference r = read_reference(cell.file, topology);
    r.area = cell.area.value_or(r.area);
    r.volume = cell.volume.value_or(r.volume);
    r.stretch_ratio = cell.spring_ratio.value_or(r.stretch_ratio);
    const double radius = membrane::RestState{.area = r.area}.radius();
    if (cell.spontaneous_curvature) r.curvature = *cell.spontaneous_curvature / radius;
    if (cell.relaxed_area_difference)
        r.total_curvature = *cell.relaxed_area_difference * 8 * membrane::red_blood_cell::pi * radius;
    return r;
}

}  // namespace

membrane::Parameters membrane_parameters(const CellInput& cell) {
    membrane::Parameters p;
    p.constraint = {cell.volume_modulus / pressure_unit, cell.area_modulus / tension_unit,
                    cell.local_area_modulus / tension_unit};
    p.bending = {cell.bending_modulus / energy_unit, cell.ade_modulus / energy_unit, cell.bending_scheme};
    p.network = {cell.shear_modulus / tension_unit, cell.membrane_viscosity / surface_viscosity_unit,
                 cell.law, cell.skalak_ratio};
    return p;
}

bool takes_stored_reference(const CellInput& cell) { return reference_of(cell) == MembraneReference::stored; }

membrane::ShapeOptions shape_options(const CellInput& cell, const membrane::RelaxOptions& relaxation) {
    membrane::ShapeOptions options{.reference = kind_of(reference_of(cell)),
                                   .parameters = membrane_parameters(cell),
                                   .rest = rest_state(cell),
                                   .route = cell.route,
                                   .reduced_volume = cell.reference_reduced_volume,
                                   .spring_length = cell.spring_length.value_or(0),
                                   .camber = cell.camber,
                                   .relaxation = relaxation};
    if (options.reference == membrane::ReferenceKind::given) {
        CellInput file = cell;
        file.shape = CellShape::file;
        file.file = cell.reference_file;
        options.reference_shape = start_shape(file).vertices;
    }
    return options;
}

membrane::Cell build_cell(const CellInput& cell, const membrane::RelaxOptions& relaxation) {
    const membrane::ShapeOptions options = shape_options(cell, relaxation);
    if (cell.shape == CellShape::discocyte) return membrane::make_discocyte(sphere_mesh(cell), options);
    membrane::Cell result = membrane::make_cell(start_shape(cell), options);
    if (takes_stored_reference(cell)) result.reference = stored_reference(cell, *result.topology);
    return result;
}

}  // namespace hemoflux::apps
