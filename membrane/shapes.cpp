#include "membrane/shapes.hpp"

#include <utility>

#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::membrane {

Cell make_discocyte(int level, const ShapeOptions& options) {
    const double radius = red_blood_cell::radius();
    const meshing::SurfaceMesh sphere = meshing::icosphere(level, radius);
    const meshing::SurfaceMesh spheroid = meshing::spheroid(
        sphere,
        {.equatorial = reference_spheroid_equator * radius, .polar = reference_spheroid_pole * radius});
    Cell cell;
    cell.topology = std::make_shared<const Topology>(sphere);
    cell.parameters = options.parameters;

    Batch batch(cell.topology, options.parameters, reference_from_shape(*cell.topology, spheroid.vertices));
    if (options.route == Route::deflation) {
        batch.set_positions(0, spheroid.vertices);
        cell.relaxation = deflate(batch, red_blood_cell::volume, options.relaxation);
    } else {
        batch.set_positions(0, meshing::evans_fung(sphere).vertices);
        cell.relaxation = relax(batch, options.relaxation);
    }
    if (options.reference != ReferenceKind::spheroid) {
        const auto disc = batch.positions(0);
        batch.set_reference(options.reference == ReferenceKind::stress_free
                                ? reference_from_shape(*cell.topology, disc)
                                : uniform_length_reference(*cell.topology, disc, options.spring_length));
        cell.relaxation = relax(batch, options.relaxation);
    }
    cell.reference = batch.reference();
    cell.positions = batch.positions(0);
    const Vec3d centroid = shape_moments(cell.topology->triangles(), cell.positions).centroid;
    for (Vec3d& r : cell.positions) r -= centroid;
    return cell;
}

}  // namespace hemoflux::membrane
