#include "meshing/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hemoflux::meshing {
namespace {

struct Corners {
    Vec3d a, b, c;
};

Corners corners(const SurfaceMesh& mesh, std::size_t t) {
    const auto at = [&](int corner) { return mesh.vertices[static_cast<std::size_t>(corner)]; };
    const Triangle& triangle = mesh.triangles[t];
    return {at(triangle[0]), at(triangle[1]), at(triangle[2])};
}

double angle(const Vec3d& p, const Vec3d& q) { return std::atan2(norm(cross(p, q)), dot(p, q)); }

// Origin near the mesh, so that volumes of meshes far from zero do not suffer from cancellation.
Vec3d origin(const SurfaceMesh& mesh) {
    return mesh.vertices.empty() ? Vec3d{0, 0, 0} : mesh.vertices.front();
}

}  // namespace

Vec3d area_vector(const SurfaceMesh& mesh, std::size_t t) {
    const auto [a, b, c] = corners(mesh, t);
    return 0.5 * cross(b - a, c - a);
}

double area(const SurfaceMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += norm(area_vector(mesh, t));
    return sum;
}

double volume(const SurfaceMesh& mesh) {
    const Vec3d o = origin(mesh);
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        sum += dot(a - o, cross(b - o, c - o));
    }
    return sum / 6;
}

Vec3d centroid(const SurfaceMesh& mesh) {
    const Vec3d o = origin(mesh);
    Vec3d moment{0, 0, 0};
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        const double six_volumes = dot(a - o, cross(b - o, c - o));
        sum += six_volumes;
        moment += six_volumes * ((a - o) + (b - o) + (c - o));
    }
    return o + (0.25 / sum) * moment;
}

double reduced_volume(const SurfaceMesh& mesh) {
    return 6 * std::sqrt(std::numbers::pi) * volume(mesh) / std::pow(area(mesh), 1.5);
}

std::vector<Edge> edges(const SurfaceMesh& mesh) {
    std::vector<Edge> all;
    all.reserve(3 * mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const int p = t[i], q = t[(i + 1) % 3];
            all.push_back({std::min(p, q), std::max(p, q)});
        }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void translate(SurfaceMesh& mesh, const Vec3d& by) {
    for (Vec3d& vertex : mesh.vertices) vertex += by;
}

SurfaceQuality quality(const SurfaceMesh& mesh) {
    SurfaceQuality q;
    const std::vector<Edge> all = edges(mesh);
    q.edges = all.size();
    q.euler_characteristic = static_cast<int>(mesh.vertices.size()) - static_cast<int>(all.size()) +
                             static_cast<int>(mesh.triangles.size());
    std::vector<int> valence(mesh.vertices.size(), 0);
    double sum = 0;
    for (const Edge& edge : all) {
        const auto p = static_cast<std::size_t>(edge[0]), r = static_cast<std::size_t>(edge[1]);
        const double length = norm(mesh.vertices[p] - mesh.vertices[r]);
        q.shortest_edge = sum == 0 ? length : std::min(q.shortest_edge, length);
        q.longest_edge = std::max(q.longest_edge, length);
        sum += length;
        ++valence[p], ++valence[r];
    }
    q.mean_edge = sum / static_cast<double>(all.size());
    for (const int n : valence) ++q.valences[n];
    double smallest = std::numbers::pi;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        smallest = std::min({smallest, angle(b - a, c - a), angle(a - b, c - b), angle(a - c, b - c)});
    }
    q.smallest_angle = smallest * 180 / std::numbers::pi;
    return q;
}

}  // namespace hemoflux::meshing
