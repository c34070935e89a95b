#include "membrane/shape_kind.hpp"

#include <cmath>

#include "membrane/diagnostics.hpp"
#include "membrane/parameters.hpp"

namespace hemoflux::membrane {
namespace {

const Vec3d& at(const std::vector<Vec3d>& positions, int v) { return positions[static_cast<std::size_t>(v)]; }

/// Twice the area times the outward normal.
Vec3d normal(const std::vector<Vec3d>& positions, const meshing::Triangle& t) {
    return cross(at(positions, t[1]) - at(positions, t[0]), at(positions, t[2]) - at(positions, t[0]));
}

/// Whether no vertex within two edges is more curved.
bool is_peak(const Topology& topology, const std::vector<double>& curvature, std::size_t v) {
    for (const int n : topology.neighbours(v)) {
        const auto near = static_cast<std::size_t>(n);
        if (curvature[near] > curvature[v]) return false;
        for (const int m : topology.neighbours(near))
            if (curvature[static_cast<std::size_t>(m)] > curvature[v]) return false;
    }
    return true;
}

}  // namespace

ShapeSigns shape_signs(const Topology& topology, const std::vector<Vec3d>& positions,
                       const std::vector<double>& curvature) {
    const ShapeMoments m = shape_moments(topology.triangles(), positions);
    const DiscMeasures disc = disc_measures(topology.triangles(), positions);
    const double radius = std::sqrt(m.area / (4 * red_blood_cell::pi));
    ShapeSigns s;
    for (std::size_t v = 0; v < topology.vertices(); ++v)
        if (curvature[v] * radius > 8 && is_peak(topology, curvature, v)) ++s.spicules;
    Vec3d middle{0, 0, 0};
    for (const auto& t : topology.triangles())
        middle += (norm(normal(positions, t)) / (6 * m.area)) *
                  (at(positions, t[0]) + at(positions, t[1]) + at(positions, t[2]));
    s.asymmetry = std::fabs(dot(middle - m.centroid, m.axes[2])) / radius;
    s.dimple = 1 - disc.centre_thickness / disc.greatest_thickness;
    s.kind = s.spicules >= 6       ? ShapeKind::echinocyte
             : s.asymmetry >= 0.02 ? ShapeKind::stomatocyte
             : s.dimple >= 0.1     ? ShapeKind::discocyte
                                   : ShapeKind::other;
    return s;
}

}  // namespace hemoflux::membrane
