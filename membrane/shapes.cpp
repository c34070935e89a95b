#include "membrane/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/symmetry.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::membrane {
namespace {

std::vector<Vec3d> spheroid_of(const meshing::SurfaceMesh& sphere, const ShapeOptions& options) {
    return meshing::spheroid(sphere, meshing::oblate_axes(options.rest.area, options.reduced_volume))
        .vertices;
}

/// The reference of options.reference for a cell whose disc is `disc`.
Reference reference_of(const Topology& topology, const meshing::SurfaceMesh& sphere,
                       const std::vector<Vec3d>& disc, const ShapeOptions& options) {
    switch (options.reference) {
        case ReferenceKind::spheroid:
            return reference_from_shape(topology, spheroid_of(sphere, options), options.rest);
        case ReferenceKind::uniform_length:
            return uniform_length_reference(topology, disc, options.spring_length, options.rest);
        case ReferenceKind::coarse_grained:
            return uniform_length_reference(
                topology, disc, coarse_grained_length(topology.vertices(), options.rest.area), options.rest);
        case ReferenceKind::given:
            return reference_from_shape(topology, options.reference_shape, options.rest);
        case ReferenceKind::stress_free:
            break;
    }
    return reference_from_shape(topology, disc, options.rest);
}

/// The shape bent upwards by z += camber (1 - rho^2 / rho_max^2).
std::vector<Vec3d> bent(std::vector<Vec3d> shape, double camber) {
    double greatest = 0;
    for (const Vec3d& r : shape) greatest = std::max(greatest, r.x * r.x + r.y * r.y);
    for (Vec3d& r : shape) r.z += camber * (1 - (r.x * r.x + r.y * r.y) / greatest);
    return shape;
}

void centre(Cell& cell) {
    const Vec3d centroid = shape_moments(cell.topology->triangles(), cell.positions).centroid;
    for (Vec3d& r : cell.positions) r -= centroid;
}

}  // namespace

Cell make_discocyte(const meshing::SurfaceMesh& sphere, const ShapeOptions& options) {
    Cell cell;
    cell.topology = std::make_shared<const Topology>(sphere);
    cell.parameters = options.parameters;
    const auto spheroid = spheroid_of(sphere, options);
    Batch batch(cell.topology, options.parameters,
                reference_from_shape(*cell.topology, spheroid, options.rest));
    if (options.route == Route::deflation) {
        batch.set_positions(0, bent(spheroid, options.camber));
        cell.relaxation = deflate(batch, options.rest.volume, options.relaxation);
    } else {
        const double size = std::sqrt(options.rest.area / meshing::evans_fung_area);
        batch.set_positions(0, bent(meshing::evans_fung(sphere, meshing::evans_fung_diameter * size).vertices,
                                    options.camber));
        cell.relaxation = relax(batch, options.relaxation);
    }
    if (options.reference != ReferenceKind::spheroid) {
        batch.set_reference(reference_of(*cell.topology, sphere, batch.positions(0), options));
        cell.relaxation = relax_symmetric(
            batch, options.camber == 0 ? symmetries(sphere) : std::vector<Symmetry>{}, options.relaxation);
    }
    cell.reference = batch.reference();
    cell.positions = batch.positions(0);
    centre(cell);
    return cell;
}

Cell make_discocyte(int level, const ShapeOptions& options) {
    return make_discocyte(meshing::icosphere(level, 1.0), options);
}

Cell make_cell(const meshing::SurfaceMesh& shape, const ShapeOptions& options) {
    Cell cell;
    cell.topology = std::make_shared<const Topology>(shape);
    cell.parameters = options.parameters;
    cell.reference = reference_of(*cell.topology, shape, shape.vertices, options);
    cell.positions = shape.vertices;
    centre(cell);
    return cell;
}

}  // namespace hemoflux::membrane
