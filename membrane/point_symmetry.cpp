#include "membrane/point_symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::membrane {
namespace {

/// Of a length in its own size, up to which two values count as the same.
constexpr double same = 1e-9;

std::size_t index(int v) { return static_cast<std::size_t>(v); }

/// For each vertex the one within `reach` of its image; empty when one has none. The vertices are sorted along
/// x: few share a slab of 2 reach.
std::vector<int> opposite_vertices(const std::vector<Vec3d>& r, double reach) {
    std::vector<int> by_x(r.size());
    for (std::size_t v = 0; v < r.size(); ++v) by_x[v] = static_cast<int>(v);
    std::sort(by_x.begin(), by_x.end(), [&r](int a, int b) { return r[index(a)].x < r[index(b)].x; });
    std::vector<int> antipode;
    for (const Vec3d& here : r) {
        const Vec3d image = -here;
        auto other = std::lower_bound(by_x.begin(), by_x.end(), image.x - reach,
                                      [&r](int v, double x) { return r[index(v)].x < x; });
        while (other != by_x.end() && r[index(*other)].x <= image.x + reach &&
               norm(r[index(*other)] - image) > reach)
            ++other;
        if (other == by_x.end() || r[index(*other)].x > image.x + reach) return {};
        antipode.push_back(*other);
    }
    return antipode;
}

/// The corners of a triangle in ascending order.
std::array<int, 3> corners(const meshing::Triangle& t) {
    std::array<int, 3> c{t[0], t[1], t[2]};
    std::sort(c.begin(), c.end());
    return c;
}

std::array<int, 3> opposite(const meshing::Triangle& t, const std::vector<int>& antipode) {
    return corners({antipode[index(t[0])], antipode[index(t[1])], antipode[index(t[2])]});
}

bool equal(double a, double b) { return std::fabs(a - b) <= same * std::fabs(a); }

/// g -> (g - P g)/2 with P the exchange of opposite vertices: what of the gradient keeps the symmetry.
Potential holding(const std::vector<int>& antipode) {
    return [antipode](std::span<const double>, std::span<double> gradient) {
        const std::size_t n = antipode.size();
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t v = 0; v < n; ++v)
                if (const std::size_t w = index(antipode[v]); v <= w) {
                    double &g = gradient[axis * n + v], &h = gradient[axis * n + w];
                    g = 0.5 * (g - h);
                    h = -g;
                }
        return 0.0;
    };
}

}  // namespace

std::vector<int> antipodes(const meshing::SurfaceMesh& mesh) {
    Vec3d centre{0, 0, 0};
    for (const Vec3d& r : mesh.vertices) centre += (1 / static_cast<double>(mesh.vertices.size())) * r;
    std::vector<Vec3d> r = mesh.vertices;
    double size = 0;
    for (Vec3d& p : r) {
        p -= centre;
        size = std::max(size, norm(p));
    }
    std::vector<int> antipode = opposite_vertices(r, same * size);
    if (antipode.empty()) return {};
    std::vector<std::array<int, 3>> triangles;
    for (const meshing::Triangle& t : mesh.triangles) triangles.push_back(corners(t));
    std::sort(triangles.begin(), triangles.end());
    for (const meshing::Triangle& t : mesh.triangles)
        if (!std::binary_search(triangles.begin(), triangles.end(), opposite(t, antipode))) return {};
    return antipode;
}

bool point_symmetric(const Topology& topology, const std::vector<int>& antipode, const Reference& reference) {
    std::map<std::array<int, 3>, double> area;
    for (std::size_t k = 0; k < topology.triangles().size(); ++k)
        area[corners(topology.triangles()[k])] = reference.triangle_areas[k];
    for (const meshing::Triangle& t : topology.triangles())
        if (!equal(area.at(corners(t)), area.at(opposite(t, antipode)))) return false;
    const std::vector<Edge>& edges = topology.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const int p = antipode[index(edges[e].v1)], q = antipode[index(edges[e].v2)];
        const std::pair ends{std::min(p, q), std::max(p, q)};
        const auto other =
            std::lower_bound(edges.begin(), edges.end(), ends, [](const Edge& a, const auto& b) {
                return std::pair{a.v1, a.v2} < b;
            });
        if (!equal(reference.edge_lengths[e],
                   reference.edge_lengths[static_cast<std::size_t>(other - edges.begin())]))
            return false;
    }
    return true;
}

RelaxResult relax_symmetric(Batch& batch, const std::vector<int>& antipode, const RelaxOptions& options) {
    if (antipode.size() != batch.vertices())
        throw InputError(fmt::format("{} antipodes", antipode.size()),
                         fmt::format("the cell has {} vertices", batch.vertices()),
                         "Take those of the cell's own mesh");
    std::vector<Vec3d> r = batch.positions(0);
    for (std::size_t v = 0; v < r.size(); ++v)
        if (const std::size_t w = index(antipode[v]); v <= w) {
            r[v] = 0.5 * (r[v] - r[w]);
            r[w] = -r[v];
        }
    batch.set_positions(0, r);
    RelaxResult result = minimise(batch, options, holding(antipode));
    result.largest_force = 0;
    for (const Vec3d& f : batch.forces(0)) result.largest_force = std::max(result.largest_force, norm(f));
    return result;
}

}  // namespace hemoflux::membrane
