#include "membrane/recovery.hpp"

#include <cmath>
#include <string>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::membrane {
namespace {

constexpr double time_unit = 1e-5;  // s

RecoveryPoint point(const Batch& batch, double time) {
    const auto positions = batch.positions(0);
    const Diameters d =
        stretch_diameters(positions, shape_moments(batch.topology().triangles(), positions).centroid);
    return {.time_s = time * time_unit, .axial_um = d.axial, .transverse_um = d.transverse};
}

}  // namespace

std::vector<RecoveryPoint> pull_in_time(Batch& batch, const PulledVertices& pulled, double force_pN,
                                        const DynamicsOptions& options, double rest) {
    std::vector<RecoveryPoint> points{point(batch, 0)};
    evolve(batch, options, pulling_loads(pulled, batch.vertices(), force_pN), [&](double time) {
        points.push_back(point(batch, time));
        return std::fabs(points.back().axial_um - points[points.size() - 2].axial_um) > rest;
    });
    return points;
}

std::vector<RecoveryPoint> relax_back(Batch& batch, const DynamicsOptions& options) {
    std::vector<RecoveryPoint> points{point(batch, 0)};
    evolve(batch, options, {}, [&](double time) {
        points.push_back(point(batch, time));
        return true;
    });
    return points;
}

double recovery_time(const std::vector<RecoveryPoint>& points, double rest_ratio) {
    double tt = 0, ty = 0;
    int used = 0;
    for (const RecoveryPoint& p : points) {
        const double w = p.axial_um / p.transverse_um,
                     w0 = points.front().axial_um / points.front().transverse_um;
        const double left = (w - rest_ratio) * (w0 + rest_ratio) / ((w + rest_ratio) * (w0 - rest_ratio));
        if (!(p.time_s > 0 && left > 0.1 && left < 1)) continue;
        tt += p.time_s * p.time_s;
        ty -= p.time_s * std::log(left);
        ++used;
    }
    if (used < 2)
        throw InputError("a recovery of " + std::to_string(used) + " usable points",
                         "its time constant needs two between the stretched and the resting shape",
                         "Follow the cell for longer, in shorter steps");
    return tt / ty;
}

}  // namespace hemoflux::membrane
