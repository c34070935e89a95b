#include "membrane/stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::membrane {
namespace {

/// 1 pN in the internal unit of force.
constexpr double piconewton = 0.1;

/// Mirror images of one another differ in x by what the relaxation left; they count as tied, um.
constexpr double tie = 1e-4;

/// The vertices furthest along side * x, ascending.
std::vector<int> outermost(const std::vector<Vec3d>& rest, double side) {
    const auto count = std::max(1L, std::lround(pulled_fraction * static_cast<double>(rest.size())));
    std::vector<double> reach;
    for (const Vec3d& r : rest) reach.push_back(side * r.x);
    std::vector<double> sorted = reach;
    std::nth_element(sorted.begin(), sorted.begin() + count - 1, sorted.end(), std::greater<>());
    const double last = sorted[static_cast<std::size_t>(count) - 1];
    std::vector<int> chosen;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (reach[v] > last + tie) chosen.push_back(static_cast<int>(v));
    for (std::size_t v = 0; v < rest.size() && chosen.size() < static_cast<std::size_t>(count); ++v)
        if (std::fabs(reach[v] - last) <= tie) chosen.push_back(static_cast<int>(v));
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace

PulledVertices pulled_vertices(const std::vector<Vec3d>& rest) {
    if (rest.size() < 2)
        throw InputError(fmt::format("a cell of {} vertices", rest.size()),
                         "each end needs one to be pulled by", "Use a finer mesh");
    return {.left = outermost(rest, -1), .right = outermost(rest, 1)};
}

std::vector<Vec3d> pulling_loads(const PulledVertices& pulled, std::size_t vertices, double force_pN) {
    const double force = force_pN * piconewton;
    std::vector<Vec3d> load(vertices, Vec3d{0, 0, 0});
    for (int v : pulled.left)
        load[static_cast<std::size_t>(v)].x -= force / static_cast<double>(pulled.left.size());
    for (int v : pulled.right)
        load[static_cast<std::size_t>(v)].x += force / static_cast<double>(pulled.right.size());
    return load;
}

std::vector<StretchPoint> stretch(Batch& batch, const std::vector<double>& forces_pN,
                                  const RelaxOptions& options) {
    for (double f : forces_pN)
        if (!(f >= 0) || std::isinf(f))
            throw InputError(fmt::format("a stretching force of {} pN", f),
                             "it must be finite and not negative", "Correct the list of forces");
    relax(batch, options);
    const double area = batch.sums(0).area, volume = batch.sums(0).volume;
    const PulledVertices pulled = pulled_vertices(batch.positions(0));
    std::vector<StretchPoint> points;
    for (double force : forces_pN) {
        const RelaxResult result = relax(batch, options, pulling_loads(pulled, batch.vertices(), force));
        const auto positions = batch.positions(0);
        const ShapeMoments moments = shape_moments(batch.topology().triangles(), positions);
        const Diameters d = stretch_diameters(positions, moments.centroid);
        points.push_back({.force_pN = force,
                          .axial_um = d.axial,
                          .transverse_um = d.transverse,
                          .iterations = result.iterations,
                          .area_error = batch.sums(0).area / area - 1,
                          .volume_error = batch.sums(0).volume / volume - 1});
    }
    return points;
}

}  // namespace hemoflux::membrane
