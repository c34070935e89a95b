#include "membrane/stretch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::membrane {
namespace {

/// Mirror images of one another differ in x by what the relaxation left; they count as tied, um.
constexpr double tie = 1e-4;

/// The `count` vertices furthest along side * x, ascending.
std::vector<int> outermost(const std::vector<Vec3d>& rest, double side, long count) {
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

/// The vertices no further than `radius` from the outermost one along side * x, ascending.
std::vector<int> touched(const std::vector<Vec3d>& rest, double side, double radius) {
    const Vec3d end = rest[static_cast<std::size_t>(outermost(rest, side, 1).front())];
    std::vector<int> chosen;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (norm(rest[v] - end) <= radius) chosen.push_back(static_cast<int>(v));
    return chosen;
}

/// The error with the force at which it occurred.
NumericalError at_force(const NumericalError& error, double force_pN) {
    const std::string text = error.what();
    const std::size_t end = text.rfind(". ");
    return {fmt::format("pulled with {:g} pN", force_pN), text.substr(0, end),
            text.substr(end + 2, text.size() - end - 3)};
}

}  // namespace

PulledVertices pulled_vertices(const std::vector<Vec3d>& rest, const Grip& grip) {
    if (rest.size() < 2)
        throw InputError(fmt::format("a cell of {} vertices", rest.size()),
                         "each end needs one to be pulled by", "Use a finer mesh");
    PulledVertices pulled;
    if (grip.contact_diameter > 0) {
        pulled = {.left = touched(rest, -1, grip.contact_diameter / 2),
                  .right = touched(rest, 1, grip.contact_diameter / 2)};
    } else {
        const long count = std::max(1L, std::lround(grip.fraction * static_cast<double>(rest.size())));
        pulled = {.left = outermost(rest, -1, count), .right = outermost(rest, 1, count)};
    }
    for (const int v : pulled.left)
        if (std::binary_search(pulled.right.begin(), pulled.right.end(), v))
            throw InputError(
                fmt::format("{} and {} pulled vertices", pulled.left.size(), pulled.right.size()),
                fmt::format("both ends hold vertex {}", v), "Let the beads hold less of the cell");
    return pulled;
}

std::vector<Vec3d> pulling_loads(const PulledVertices& pulled, std::size_t vertices, double force_pN) {
    const double force = force_pN * piconewton;
    std::vector<Vec3d> load(vertices, Vec3d{0, 0, 0});
    for (const int v : pulled.left)
        load[static_cast<std::size_t>(v)].x -= force / static_cast<double>(pulled.left.size());
    for (const int v : pulled.right)
        load[static_cast<std::size_t>(v)].x += force / static_cast<double>(pulled.right.size());
    return load;
}

StretchPoint stretch_point(const Batch& batch, double force_pN, double rest_area, double rest_volume) {
    const auto positions = batch.positions(0);
    const ShapeMoments moments = shape_moments(batch.topology().triangles(), positions);
    const Diameters d = stretch_diameters(positions, moments.centroid);
    return {.force_pN = force_pN,
            .axial_um = d.axial,
            .transverse_um = d.transverse,
            .area_error = moments.area / rest_area - 1,
            .volume_error = moments.volume / rest_volume - 1};
}

std::vector<StretchPoint> stretch(Batch& batch, const std::vector<double>& forces_pN,
                                  const RelaxOptions& options, const Grip& grip,
                                  const std::function<void(const StretchPoint&)>& done) {
    for (const double f : forces_pN)
        if (!(f >= 0) || std::isinf(f))
            throw InputError(fmt::format("a stretching force of {} pN", f),
                             "it must be finite and not negative", "Correct the list of forces");
    relax(batch, options);
    const ShapeMoments rest = shape_moments(batch.topology().triangles(), batch.positions(0));
    const PulledVertices pulled = pulled_vertices(batch.positions(0), grip);
    std::vector<StretchPoint> points;
    for (const double force : forces_pN) {
        RelaxResult result;
        try {
            result = relax(batch, options, pulling_loads(pulled, batch.vertices(), force));
        } catch (const NumericalError& error) {
            throw at_force(error, force);
        }
        StretchPoint point = stretch_point(batch, force, rest.area, rest.volume);
        point.iterations = result.iterations;
        points.push_back(point);
        if (done) done(point);
    }
    return points;
}

}  // namespace hemoflux::membrane
