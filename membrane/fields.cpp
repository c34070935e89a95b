#include "membrane/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "membrane/area.hpp"
#include "membrane/bending.hpp"
#include "membrane/in_plane.hpp"

namespace hemoflux::membrane {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// The three edges of every triangle, edge i opposite to its corner i.
std::vector<std::array<std::size_t, 3>> edges_of_triangles(const Topology& topology) {
    std::vector<std::array<std::size_t, 3>> result(topology.triangles().size());
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
        const Edge& edge = topology.edges()[e];
        for (const auto& [triangle, opposite] : {std::pair{edge.a, edge.v3}, std::pair{edge.b, edge.v4}}) {
            const auto& corner = topology.triangles()[index(triangle)];
            const auto place = std::find(corner.begin(), corner.end(), opposite) - corner.begin();
            result[index(triangle)][static_cast<std::size_t>(place)] = e;
        }
    }
    return result;
}

/// Tension dE/dL of every spring; zero for continuum laws.
std::vector<double> spring_tensions(const Batch& batch, const std::vector<double>& lengths) {
    const NetworkModuli& network = batch.parameters().network;
    const Reference& reference = batch.reference();
    std::vector<double> result(lengths.size(), 0.0);
    const auto fill = [&](const auto& chain) {
        for (std::size_t e = 0; e < lengths.size(); ++e) {
            const double contour = reference.stretch_ratio * reference.edge_lengths[e],
                         l = lengths[e] / contour;
            result[e] = chain.tension(l, 1 / (1 - l), contour);
        }
    };
    const double shear = network.shear, r = reference.stretch_ratio;
    if (network.law == InPlaneLaw::wlc) fill(WormLikeChain(shear, r));
    if (network.law == InPlaneLaw::wlc_power) fill(PowerChain(shear, r));
    if (network.law == InPlaneLaw::wlc_hydrostatic) fill(HydrostaticChain(shear, r).chain);
    return result;
}

/// I and J of a triangle from its edges' present and rest lengths; J = 0 where the latter make no triangle.
struct Strain {
    double i = 0, j = 0;
};
Strain strain_of(const std::array<double, 3>& now, const std::array<double, 3>& rest) {
    const auto area16 = [](const std::array<double, 3>& l) {  // (4 A)^2
        const double a = l[0] * l[0], b = l[1] * l[1], c = l[2] * l[2];
        return 2 * (a * b + b * c + c * a) - a * a - b * b - c * c;
    };
    const double rest16 = area16(rest);
    if (!(rest16 > 0)) return {};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double p = rest[(k + 1) % 3], q = rest[(k + 2) % 3];
        sum += (p * p + q * q - rest[k] * rest[k]) * now[k] * now[k];  // 4 A_0 cot_k L_k^2
    }
    return {.i = 2 * sum / rest16, .j = std::sqrt(std::max(0.0, area16(now) / rest16))};
}

StrainEnergy<double> continuum_law(const NetworkModuli& network, const Strain& s) {
    if (network.law == InPlaneLaw::neo_hookean) return NeoHookean{network.shear}(s.i, s.j);
    return Skalak{network.shear, network.skalak_ratio}(s.i, s.j);
}

}  // namespace

TriangleFields triangle_fields(const Batch& batch, std::size_t cell) {
    const Topology& topology = batch.topology();
    const Reference& reference = batch.reference();
    const NetworkModuli& network = batch.parameters().network;
    const auto positions = batch.positions(cell);
    const auto areas = triangle_areas(topology, positions), lengths = edge_lengths(topology, positions);
    const auto pulls = spring_tensions(batch, lengths);
    const auto edges = edges_of_triangles(topology);
    double total = 0;
    for (const double a : areas) total += a;
    const double common = area_tension(batch.parameters().constraint.area, total, reference.area);
    TriangleFields f;
    for (std::size_t k = 0; k < areas.size(); ++k) {
        std::array<double, 3> now{}, rest{};
        double trace = 0, difference_x = 0, difference_y = 0;  // of the virial, in the triangle's plane
        const auto& corner = topology.triangles()[k];
        // Angles of the edges with the first, counter-clockwise: the third edge points back below it.
        const Vec3d x = positions[index(corner[2])] - positions[index(corner[1])];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t e = edges[k][i];
            now[i] = lengths[e];
            rest[i] = reference.edge_lengths[e];
            const Vec3d d = positions[index(corner[(i + 2) % 3])] - positions[index(corner[(i + 1) % 3])];
            // both from products: sqrt(1 - c^2) would leave half the digits along the first edge
            const double lengths2 = norm(d) * norm(x), c = dot(d, x) / lengths2;
            const double s = (i == 2 ? -1 : 1) * norm(cross(x, d)) / lengths2;
            const double share = 0.5 * pulls[e] * lengths[e] / areas[k];
            trace += share;
            difference_x += share * (c * c - s * s);
            difference_y += share * 2 * c * s;
        }
        const Strain strain = strain_of(now, rest);
        const double root = std::sqrt(std::max(0.0, strain.i * strain.i - 4 * strain.j * strain.j));
        const double major2 = 0.5 * (strain.i + root), minor2 = std::max(0.0, 0.5 * (strain.i - root));
        f.major_stretch.push_back(std::sqrt(major2));
        f.minor_stretch.push_back(std::sqrt(minor2));
        const double ratio = areas[k] / reference.triangle_areas[k];
        if (is_continuum(network.law)) {
            const auto w = continuum_law(network, strain);
            f.major_tension.push_back(2 * w.by_i * major2 / strain.j + w.by_j);
            f.minor_tension.push_back(2 * w.by_i * minor2 / strain.j + w.by_j);
        } else {
            double mean = 0.5 * trace;
            if (network.law == InPlaneLaw::wlc_hydrostatic)
                mean += HydrostaticChain(network.shear, reference.stretch_ratio).area_tension(ratio);
            const double deviation = 0.5 * std::hypot(difference_x, difference_y);
            f.major_tension.push_back(mean + deviation);
            f.minor_tension.push_back(mean - deviation);
        }
        f.area_strain.push_back(ratio - 1);
        f.area_tension.push_back(common +
                                 local_area_tension(batch.parameters().constraint.local_area, ratio - 1));
    }
    return f;
}

VertexFields vertex_fields(const Batch& batch, std::size_t cell) {
    const Topology& topology = batch.topology();
    const auto positions = batch.positions(cell);
    const auto areas = triangle_areas(topology, positions);
    const std::size_t n = topology.vertices();
    std::vector<double> area(n, 0.0), rest(n, 0.0), curvature(n, 0.0);
    for (std::size_t k = 0; k < areas.size(); ++k)
        for (const int v : topology.triangles()[k]) {
            area[index(v)] += areas[k] / 3;
            rest[index(v)] += batch.reference().triangle_areas[k] / 3;
        }
    const auto at = [&positions](int v) { return positions[index(v)]; };
    for (const Edge& e : topology.edges()) {
        const Vec3d along = at(e.v2) - at(e.v1), left = at(e.v3) - at(e.v1), right = at(e.v4) - at(e.v1);
        const double length = norm(along);
        const double theta = edge_angle(length, left, cross(along, left), cross(right, along));
        for (const int v : {e.v1, e.v2}) curvature[index(v)] += 0.5 * theta * length;
    }
    VertexFields f;
    for (std::size_t v = 0; v < n; ++v) {
        f.curvature.push_back(curvature[v] / area[v]);
        f.area_strain.push_back(area[v] / rest[v] - 1);
    }
    return f;
}

}  // namespace hemoflux::membrane
