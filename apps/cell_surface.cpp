#include "apps/cell_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/packing.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"
#include "meshing/surface_check.hpp"
#include "meshing/surface_io.hpp"

namespace hemoflux::apps {
namespace {

meshing::SurfaceMesh checked_file(const std::string& file) {
    meshing::SurfaceMesh mesh = meshing::read_surface(file);
    meshing::check_surface(mesh, file);
    meshing::translate(mesh, -meshing::centroid(mesh));
    return mesh;
}

/// Distance from `origin` along `direction` to the triangle a, b, c (Moeller and Trumbore 1997); infinite if
/// missed.
double hit_distance(const Vec3d& origin, const Vec3d& direction, const Vec3d& a, const Vec3d& b,
                    const Vec3d& c) {
    constexpr double missed = std::numeric_limits<double>::infinity();
    const Vec3d ab = b - a;
    const Vec3d ac = c - a;
    const Vec3d p = cross(direction, ac);
    const double determinant = dot(ab, p);
    if (std::abs(determinant) < 1e-14) {
        return missed;
    }
    const Vec3d from_a = origin - a;
    const double u = dot(from_a, p) / determinant;
    const Vec3d q = cross(from_a, ab);
    const double v = dot(direction, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1) {
        return missed;
    }
    const double distance = dot(ac, q) / determinant;
    return distance > 0 ? distance : missed;
}

/// Width of the grid cell that holds coordinate x; of the nearest one outside the axis.
double local_width(const meshing::Axis& axis, double x) {
    const auto upper = std::upper_bound(axis.faces.begin() + 1, axis.faces.end() - 1, x);
    return *upper - *(upper - 1);
}

}  // namespace

meshing::SurfaceMesh sphere_mesh(const CellInput& cell) {
    if (cell.shape != CellShape::file && cell.mesh == "icosphere") {
        return meshing::icosphere(meshing::icosphere_level(cell.nodes), 1.0);
    }
    meshing::SurfaceMesh mesh = checked_file(cell.shape == CellShape::file ? cell.file : cell.mesh);
    mesh.vertices = meshing::directions(mesh);
    return mesh;
}

membrane::RestState rest_state(const CellInput& cell) {
    membrane::RestState rest;
    if (cell.shape == CellShape::file && !(cell.area && cell.volume)) {
        const meshing::SurfaceMesh mesh = checked_file(cell.file);
        rest.area = cell.area.value_or(meshing::area(mesh));
        rest.volume = cell.volume.value_or(meshing::volume(mesh));
    } else {
        const double area = cell.area.value_or(rest.area);
        rest.volume = cell.volume.value_or(rest.volume * std::pow(area / rest.area, 1.5));
        rest.area = area;
    }
    rest.reduced_curvature = cell.spontaneous_curvature.value_or(rest.reduced_curvature);
    rest.area_difference = cell.relaxed_area_difference.value_or(rest.area_difference);
    rest.stretch_ratio = cell.spring_ratio.value_or(rest.stretch_ratio);
    return rest;
}

meshing::SurfaceMesh start_shape(const CellInput& cell) {
    if (cell.shape == CellShape::file) {
        return checked_file(cell.file);
    }
    const meshing::SurfaceMesh sphere = sphere_mesh(cell);
    const membrane::RestState rest = rest_state(cell);
    switch (cell.shape) {
        case CellShape::sphere:
            return meshing::spheroid(sphere, rest.radius(), rest.radius(), rest.radius());
        case CellShape::spheroid:
            return meshing::spheroid(sphere, meshing::oblate_axes(rest.area, cell.reduced_volume));
        default:
            break;
    }
    return meshing::evans_fung(
        sphere, meshing::evans_fung_diameter * std::sqrt(rest.area / meshing::evans_fung_area));
}

void place(meshing::SurfaceMesh& mesh, const Triple& axis, const Triple& position) {
    const coupling::AxisTurn turn{{axis[0], axis[1], axis[2]}};
    for (Vec3d& v : mesh.vertices) v = turn(v);
    meshing::translate(mesh, {position[0], position[1], position[2]});
}

ThinnestPart thinnest_part(const meshing::SurfaceMesh& surface, const meshing::RectilinearGrid& grid) {
    std::vector<Vec3d> normals(surface.vertices.size(), Vec3d{0, 0, 0});
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        for (const int vertex : surface.triangles[t]) {
            normals[static_cast<std::size_t>(vertex)] += meshing::area_vector(surface, t);
        }
    }
    ThinnestPart thinnest;
    thinnest.grid_cells = std::numeric_limits<double>::infinity();
    const std::size_t stride = surface.vertices.size() / 600 + 1;
    for (std::size_t i = 0; i < surface.vertices.size(); i += stride) {
        const Vec3d& origin = surface.vertices[i];
        const Vec3d inward = (-1 / norm(normals[i])) * normals[i];
        double thickness = std::numeric_limits<double>::infinity();
        for (const meshing::Triangle& triangle : surface.triangles) {
            if (std::find(triangle.begin(), triangle.end(), static_cast<int>(i)) == triangle.end()) {
                const auto corner = [&](int n) {
                    return surface.vertices[static_cast<std::size_t>(triangle[n])];
                };
                thickness =
                    std::min(thickness, hit_distance(origin, inward, corner(0), corner(1), corner(2)));
            }
        }
        const double width = std::abs(inward.x) * local_width(grid.axes[0], origin.x) +
                             std::abs(inward.y) * local_width(grid.axes[1], origin.y) +
                             std::abs(inward.z) * local_width(grid.axes[2], origin.z);
        if (thickness / width < thinnest.grid_cells) {
            thinnest = {thickness, thickness / width, origin};
        }
    }
    return thinnest;
}

}  // namespace hemoflux::apps
