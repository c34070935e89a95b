#include "membrane/symmetry.hpp"

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

/// Relative difference up to which two values count as the same.
constexpr double same = 1e-9;

std::size_t index(int v) { return static_cast<std::size_t>(v); }

/// The vertex within `reach` of each vertex's image; empty when one has none. `by_x` are the vertices sorted
/// along x: few share a slab of 2 reach.
std::vector<int> images(const std::vector<Vec3d>& r, const std::vector<int>& by_x, const Symmetry& symmetry,
                        double reach) {
    std::vector<int> image;
    for (const Vec3d& here : r) {
        const Vec3d there = symmetry(here);
        auto v = std::lower_bound(by_x.begin(), by_x.end(), there.x - reach,
                                  [&r](int a, double x) { return r[index(a)].x < x; });
        while (v != by_x.end() && r[index(*v)].x <= there.x + reach && norm(r[index(*v)] - there) > reach)
            ++v;
        if (v == by_x.end() || r[index(*v)].x > there.x + reach) return {};
        image.push_back(*v);
    }
    return image;
}

using Corners = std::array<int, 3>;

/// The corners of a triangle in ascending order.
Corners corners(const meshing::Triangle& t) {
    Corners c{t[0], t[1], t[2]};
    std::sort(c.begin(), c.end());
    return c;
}

Corners corners(const meshing::Triangle& t, const Symmetry& s) {
    return corners({s.image[index(t[0])], s.image[index(t[1])], s.image[index(t[2])]});
}

bool equal(double a, double b) { return std::fabs(a - b) <= same * std::fabs(a); }

/// Replaces the values of vertices that are exchanged, along one axis, by their mean.
void average(double* value, double sign, const std::vector<int>& image) {
    for (std::size_t v = 0; v < image.size(); ++v)
        if (const std::size_t w = index(image[v]); v <= w) {
            value[v] = 0.5 * (value[v] + sign * value[w]);
            value[w] = sign * value[v];
        }
}

/// Takes from the gradient all that would break a symmetry.
Potential holding(const std::vector<Symmetry>& symmetries) {
    return [symmetries](std::span<const double>, std::span<double> gradient) {
        for (const Symmetry& s : symmetries) {
            const std::size_t n = s.image.size();
            average(gradient.data(), s.sign.x, s.image);
            average(gradient.data() + n, s.sign.y, s.image);
            average(gradient.data() + 2 * n, s.sign.z, s.image);
        }
        return 0.0;
    };
}

void symmetrise(std::vector<Vec3d>& r, const Symmetry& s) {
    for (std::size_t v = 0; v < r.size(); ++v)
        if (const std::size_t w = index(s.image[v]); v <= w) {
            r[v] = 0.5 * (r[v] + s(r[w]));
            r[w] = s(r[v]);
        }
}

}  // namespace

std::vector<Symmetry> symmetries(const meshing::SurfaceMesh& mesh) {
    const std::vector<Vec3d>& r = mesh.vertices;
    std::vector<int> by_x;
    double size = 0;
    for (const Vec3d& p : r) {
        by_x.push_back(static_cast<int>(by_x.size()));
        size = std::max(size, norm(p));
    }
    std::sort(by_x.begin(), by_x.end(), [&r](int a, int b) { return r[index(a)].x < r[index(b)].x; });
    std::vector<Corners> triangles;
    for (const meshing::Triangle& t : mesh.triangles) triangles.push_back(corners(t));
    std::sort(triangles.begin(), triangles.end());

    std::vector<Symmetry> found;
    for (int k = 1; k < 8; ++k) {
        const auto sign = [k](int bit) { return k & bit ? -1.0 : 1.0; };
        Symmetry s{.sign = {sign(1), sign(2), sign(4)}, .image = {}};
        s.image = images(r, by_x, s, same * size);
        const auto goes_to_a_triangle = [&](const meshing::Triangle& t) {
            return std::binary_search(triangles.begin(), triangles.end(), corners(t, s));
        };
        if (!s.image.empty() && std::all_of(mesh.triangles.begin(), mesh.triangles.end(), goes_to_a_triangle))
            found.push_back(std::move(s));
    }
    return found;
}

bool is_symmetric(const Topology& topology, const Reference& reference, const Symmetry& symmetry) {
    std::map<Corners, double> area;
    for (std::size_t k = 0; k < topology.triangles().size(); ++k)
        area[corners(topology.triangles()[k])] = reference.triangle_areas[k];
    for (const meshing::Triangle& t : topology.triangles())
        if (!equal(area.at(corners(t)), area.at(corners(t, symmetry)))) return false;
    std::map<std::pair<int, int>, double> length;
    const std::vector<Edge>& edges = topology.edges();
    for (std::size_t e = 0; e < edges.size(); ++e)
        length[{edges[e].v1, edges[e].v2}] = reference.edge_lengths[e];
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto [low, high] =
            std::minmax(symmetry.image[index(edges[e].v1)], symmetry.image[index(edges[e].v2)]);
        if (!equal(reference.edge_lengths[e], length.at({low, high}))) return false;
    }
    return true;
}

RelaxResult relax_symmetric(Batch& batch, const std::vector<Symmetry>& symmetries,
                            const RelaxOptions& options) {
    std::vector<Symmetry> held;
    for (const Symmetry& s : symmetries) {
        if (s.image.size() != batch.vertices())
            throw InputError(fmt::format("a symmetry of {} vertices", s.image.size()),
                             fmt::format("the cell has {}", batch.vertices()),
                             "Take those of the cell's own mesh");
        if (is_symmetric(batch.topology(), batch.reference(), s)) held.push_back(s);
    }
    if (held.empty()) return relax(batch, options);
    std::vector<Vec3d> r = batch.positions(0);
    for (const Symmetry& s : held) symmetrise(r, s);
    batch.set_positions(0, r);
    RelaxResult result = minimise(batch, options, holding(held));
    result.largest_force = 0;
    for (const Vec3d& f : batch.forces(0)) result.largest_force = std::max(result.largest_force, norm(f));
    return result;
}

}  // namespace hemoflux::membrane
