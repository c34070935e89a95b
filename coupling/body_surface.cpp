#include "coupling/body_surface.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// s a b^T added to m.
void add_product(Matrix3& m, double s, const Vec3d& a, const Vec3d& b) {
    m.row[0] += (s * a.x) * b;
    m.row[1] += (s * a.y) * b;
    m.row[2] += (s * a.z) * b;
}

Matrix3 inertia_of(const Matrix3& second) {
    const double trace = second.row[0].x + second.row[1].y + second.row[2].z;
    Matrix3 inertia;
    for (int i = 0; i < 3; ++i) inertia.row[i] = -second.row[i];
    inertia.row[0].x += trace;
    inertia.row[1].y += trace;
    inertia.row[2].z += trace;
    return inertia;
}

Matrix3 second_moments(const meshing::SurfaceMesh& mesh) {
    Matrix3 second;
    for (const auto& t : mesh.triangles) {
        const Vec3d &a = mesh.vertices[static_cast<std::size_t>(t[0])],
                    &b = mesh.vertices[static_cast<std::size_t>(t[1])],
                    &c = mesh.vertices[static_cast<std::size_t>(t[2])];
        const double share = dot(a, cross(b, c)) / 120;
        for (const Vec3d& p : {a + b + c, a, b, c}) add_product(second, share, p, p);
    }
    return second;
}

/// Two unit vectors that form a right-handed frame with `axis`.
std::array<Vec3d, 2> across(const Vec3d& axis) {
    const Vec3d helper = std::abs(axis.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d e = cross(axis, helper), first = (1 / norm(e)) * e;
    return {first, cross(axis, first)};
}

}  // namespace

Matrix3 Matrix3::transposed() const {
    return {{{row[0].x, row[1].x, row[2].x}, {row[0].y, row[1].y, row[2].y}, {row[0].z, row[1].z, row[2].z}}};
}

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    const Matrix3 t = b.transposed();
    return {{t * a.row[0], t * a.row[1], t * a.row[2]}};
}

double BodySurface::area() const { return std::accumulate(areas.begin(), areas.end(), 0.0); }

double BodySurface::nodes_per_square(double h) const {
    return static_cast<double>(areas.size()) * h * h / area();
}

BodySurface closed_surface(meshing::SurfaceMesh mesh) {
    BodySurface s;
    s.volume = meshing::volume(mesh);
    if (!(s.volume > 0))
        throw InputError(fmt::format("the surface of a body encloses {:.3g} um^3", s.volume),
                         "its triangles must be counter-clockwise seen from outside and leave no hole",
                         "Repair or reverse the surface");
    meshing::translate(mesh, -meshing::centroid(mesh));
    std::vector<Vec3d> vectors(mesh.vertices.size(), Vec3d{0, 0, 0});
    s.areas.assign(mesh.vertices.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3d share = (1.0 / 3) * meshing::area_vector(mesh, t);
        for (const int v : mesh.triangles[t]) {
            vectors[static_cast<std::size_t>(v)] += share;
            s.areas[static_cast<std::size_t>(v)] += norm(share);
        }
    }
    for (std::size_t v = 0; v < vectors.size(); ++v) {
        if (!(norm(vectors[v]) > 0))
            throw InputError(fmt::format("vertex {} of a body's surface", v), "it stands for no area",
                             "Remove vertices without triangles");
        s.normals.push_back((1 / norm(vectors[v])) * vectors[v]);
    }
    s.inertia = inertia_of(second_moments(mesh));
    s.nodes = mesh.vertices;
    s.mesh = std::move(mesh);
    return s;
}

BodySurface cylinder_mantle(double diameter, double length, const Vec3d& axis, int n_around, int n_along) {
    if (!(diameter > 0 && length > 0 && n_around >= 8 && n_along >= 1))
        throw InputError(fmt::format("cylinder of diameter {} um and length {} um with {} x {} nodes",
                                     diameter, length, n_around, n_along),
                         "lengths are positive, and a circle has at least 8 nodes", "Change these numbers");
    BodySurface s;
    s.closed = false;
    const double radius = diameter / 2;
    const auto [e1, e2] = across(axis);
    for (int k = 0; k < n_along; ++k)
        for (int i = 0; i < n_around; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5 * (k % 2)) / n_around;
            const Vec3d normal = std::cos(angle) * e1 + std::sin(angle) * e2;
            s.mesh.vertices.push_back(radius * normal + (length * ((k + 0.5) / n_along - 0.5)) * axis);
            s.normals.push_back(normal);
            s.areas.push_back(std::numbers::pi * diameter / n_around * length / n_along);
        }
    for (int k = 0; k + 1 < n_along; ++k)
        for (int i = 0; i < n_around; ++i) {
            const int next = (i + 1) % n_around, a = k * n_around + i, b = k * n_around + next,
                      c = a + n_around, d = b + n_around;
            // rows with an odd number are half a spacing ahead
            if (k % 2 == 0) {
                s.mesh.triangles.push_back({a, b, c});
                s.mesh.triangles.push_back({b, d, c});
            } else {
                s.mesh.triangles.push_back({a, b, d});
                s.mesh.triangles.push_back({a, d, c});
            }
        }
    s.nodes = s.mesh.vertices;
    s.volume = std::numbers::pi * radius * radius * length;
    Matrix3 second;
    for (const Vec3d& e : {e1, e2}) add_product(second, s.volume * radius * radius / 4, e, e);
    add_product(second, s.volume * length * length / 12, axis, axis);
    s.inertia = inertia_of(second);
    return s;
}

void retract(BodySurface& surface, const FluidGrid& grid, const Vec3d& centre, double share) {
    for (std::size_t j = 0; j < surface.nodes.size(); ++j) {
        const Vec3d n = surface.normals[j];
        surface.nodes[j] -= (share * grid.width(centre + surface.nodes[j], n)) * n;
    }
}

}  // namespace hemoflux::coupling
