#include "meshing/hex_geometry.hpp"

namespace hemoflux::meshing {
namespace {

Vec3d mean_point(const Quad& p) { return 0.25 * (p[0] + p[1] + (p[2] + p[3])); }

}  // namespace

Vec3d quad_area(const Quad& p) { return 0.5 * cross(p[2] - p[0], p[3] - p[1]); }

Vec3d quad_centre(const Quad& p) {
    const Vec3d middle = mean_point(p), area = quad_area(p);
    const double scale = dot(area, area);
    if (!(scale > 0)) return middle;
    Vec3d moment{0, 0, 0};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3d a = p[k] - middle, b = p[(k + 1) % 4] - middle;
        moment += (dot(cross(a, b), area) / (6 * scale)) * (a + b);
    }
    return middle + moment;
}

Solid hexahedron(const std::array<Quad, 6>& faces) {
    // coordinates from the mean of the corners keep the digits of small cells far from the origin
    const Vec3d origin = 0.5 * (mean_point(faces[4]) + mean_point(faces[5]));
    double volume = 0;
    Vec3d moment{0, 0, 0};
    for (const Quad& face : faces) {
        const Vec3d apex = mean_point(face) - origin;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3d a = face[k] - origin, b = face[(k + 1) % 4] - origin;
            const double tetrahedron = dot(cross(a, b), apex) / 6;
            volume += tetrahedron;
            moment += (0.25 * tetrahedron) * (a + b + apex);
        }
    }
    if (!(volume > 0)) return {volume, origin};
    return {volume, origin + (1 / volume) * moment};
}

}  // namespace hemoflux::meshing
