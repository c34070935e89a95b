#include "membrane/reference.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <string>

#include "exchange/error.hpp"

namespace hemoflux::membrane {
namespace {

const Vec3d& at(const std::vector<Vec3d>& positions, int v) { return positions[static_cast<std::size_t>(v)]; }

void check_size(const Topology& topology, const std::vector<Vec3d>& positions) {
    if (positions.size() != topology.vertices())
        throw InputError(fmt::format("a shape of {} vertices", positions.size()),
                         fmt::format("the cell's mesh has {}", topology.vertices()),
                         "Use a reference shape with the same mesh as the cell");
}

void positive(const std::string& name, double value) {
    if (!(value > 0) || std::isinf(value))
        throw InputError(fmt::format("reference {} = {}", name, value), "it must be positive and finite",
                         "Correct the reference data");
}

void finite(const std::string& name, double value) {
    if (!std::isfinite(value))
        throw InputError(fmt::format("reference {} = {}", name, value), "it must be finite",
                         "Correct the reference data");
}

void positive_each(const char* name, const std::vector<double>& values, std::size_t expected) {
    if (values.size() != expected)
        throw InputError(fmt::format("{} reference {}s", values.size(), name),
                         fmt::format("the cell's mesh has {}", expected),
                         "Use reference data made with the same mesh");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] > 0) || std::isinf(values[i])) positive(fmt::format("{} {}", name, i), values[i]);
}

}  // namespace

void Reference::check(const Topology& topology) const {
    positive("area", area);
    positive("volume", volume);
    finite("curvature", curvature);
    finite("total curvature", total_curvature);
    if (!(stretch_ratio > 1) || std::isinf(stretch_ratio))
        throw InputError(fmt::format("stretch ratio {}", stretch_ratio),
                         "a spring's contour length must exceed its rest length",
                         "Give a ratio above 1, e.g. 2.6");
    positive_each("triangle area", triangle_areas, topology.triangles().size());
    positive_each("edge length", edge_lengths, topology.edges().size());
}

std::vector<double> triangle_areas(const Topology& topology, const std::vector<Vec3d>& positions) {
    check_size(topology, positions);
    std::vector<double> areas;
    areas.reserve(topology.triangles().size());
    for (const auto& t : topology.triangles()) {
        const Vec3d& r = at(positions, t[0]);
        areas.push_back(0.5 * norm(cross(at(positions, t[1]) - r, at(positions, t[2]) - r)));
    }
    return areas;
}

std::vector<double> edge_lengths(const Topology& topology, const std::vector<Vec3d>& positions) {
    check_size(topology, positions);
    std::vector<double> lengths;
    lengths.reserve(topology.edges().size());
    for (const Edge& e : topology.edges()) lengths.push_back(norm(at(positions, e.v2) - at(positions, e.v1)));
    return lengths;
}

double RestState::radius() const { return std::sqrt(area / (4 * red_blood_cell::pi)); }

Reference reference_from_shape(const Topology& topology, const std::vector<Vec3d>& shape,
                               const RestState& rest) {
    Reference r;
    r.area = rest.area;
    r.volume = rest.volume;
    r.curvature = rest.reduced_curvature / rest.radius();
    r.total_curvature = rest.area_difference * 8 * red_blood_cell::pi * rest.radius();
    r.stretch_ratio = rest.stretch_ratio;
    r.triangle_areas = triangle_areas(topology, shape);
    r.edge_lengths = edge_lengths(topology, shape);
    return r;
}

double mean_edge(const Topology& topology, const std::vector<Vec3d>& positions) {
    const std::vector<double> areas = triangle_areas(topology, positions);
    const double mean = std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
    return std::sqrt(4 * mean / std::sqrt(3.0));
}

Reference uniform_length_reference(const Topology& topology, const std::vector<Vec3d>& disc, double length,
                                   const RestState& rest) {
    Reference r = reference_from_shape(topology, disc, rest);
    r.edge_lengths.assign(r.edge_lengths.size(),
                          length == 0 ? uniform_length_ratio * mean_edge(topology, disc) : length);
    double total = 0;
    for (const double a : r.triangle_areas) total += a;
    r.triangle_areas.assign(r.triangle_areas.size(), total / static_cast<double>(r.triangle_areas.size()));
    return r;
}

double coarse_grained_length(std::size_t vertices, double area) {
    return spectrin_length * std::sqrt((spectrin_vertices - 2) / (static_cast<double>(vertices) - 2) * area /
                                       red_blood_cell::area);
}

}  // namespace hemoflux::membrane
