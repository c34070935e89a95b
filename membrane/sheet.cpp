#include "membrane/sheet.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::membrane {

SheetModuli sheet_moduli(const Parameters& parameters) {
    parameters.check();
    const double shear = parameters.network.shear;
    double area = 2 * shear;
    if (parameters.network.law == InPlaneLaw::neo_hookean) area = 3 * shear;
    if (parameters.network.law == InPlaneLaw::skalak)
        area = (1 + 2 * parameters.network.skalak_ratio) * shear;
    area += parameters.constraint.local_area;
    const double sum = area + shear;
    return {.shear = shear,
            .area = area,
            .young = sum > 0 ? 4 * area * shear / sum : 0,
            .poisson = sum > 0 ? (area - shear) / sum : 0};
}

meshing::SurfaceMesh flat_pillow(int rings, double edge) {
    if (rings < 1)
        throw InputError("a flat sheet of " + std::to_string(rings) + " rings", "it needs one",
                         "Give 1 or more");
    meshing::SurfaceMesh mesh;
    std::map<std::array<int, 3>, int> numbers;  // lattice coordinates and side
    // Axial coordinates (a, b) of the triangular lattice; border vertices belong to both sides.
    const auto inside = [rings](int a, int b) {
        return std::abs(a) <= rings && std::abs(b) <= rings && std::abs(a + b) <= rings;
    };
    const auto vertex = [&](int a, int b, int side) {
        const bool border = std::abs(a) == rings || std::abs(b) == rings || std::abs(a + b) == rings;
        const auto [place, fresh] =
            numbers.try_emplace({a, b, border ? 0 : side}, static_cast<int>(mesh.vertices.size()));
        if (fresh) mesh.vertices.push_back({edge * (a + 0.5 * b), edge * 0.5 * std::sqrt(3.0) * b, 0});
        return place->second;
    };
    for (const int side : {0, 1})
        for (int a = -rings; a <= rings; ++a)
            for (int b = -rings; b <= rings; ++b) {
                const auto add = [&](std::array<std::pair<int, int>, 3> p) {
                    for (const auto& [x, y] : p)
                        if (!inside(x, y)) return;
                    if (side == 1) std::swap(p[1], p[2]);
                    meshing::Triangle t{};
                    for (std::size_t i = 0; i < 3; ++i) t[i] = vertex(p[i].first, p[i].second, side);
                    mesh.triangles.push_back(t);
                };
                add({{{a, b}, {a + 1, b}, {a, b + 1}}});
                add({{{a + 1, b}, {a + 1, b + 1}, {a, b + 1}}});
            }
    return mesh;
}

Batch flat_sheet(const Parameters& parameters, int rings, double edge, double stretch_ratio) {
    const meshing::SurfaceMesh mesh = flat_pillow(rings, edge);
    const auto topology = std::make_shared<const Topology>(mesh);
    Parameters in_plane = parameters;
    in_plane.constraint.volume = 0;
    in_plane.constraint.area = 0;
    in_plane.bending = {.local = 0, .area_difference = 0};
    Reference reference;
    reference.stretch_ratio = stretch_ratio;
    reference.triangle_areas = triangle_areas(*topology, mesh.vertices);
    reference.edge_lengths = edge_lengths(*topology, mesh.vertices);
    Batch batch(topology, in_plane, reference);
    batch.set_positions(0, mesh.vertices);
    return batch;
}

SheetModuli measured_moduli(const Parameters& parameters, int rings, double edge, double stretch_ratio) {
    Batch batch = flat_sheet(parameters, rings, edge, stretch_ratio);
    const auto rest = batch.positions(0);
    batch.compute_forces();
    const double area = batch.sums(0).area;
    /// Energy per area after stretching by (x, y) and shearing by gamma.
    const auto energy = [&](double x, double y, double gamma) {
        auto moved = rest;
        for (Vec3d& r : moved) r = {x * r.x + gamma * r.y, y * r.y, 0};
        batch.set_positions(0, moved);
        batch.compute_forces();
        return batch.energies(0).total() / area;
    };
    constexpr double h = 1e-3;
    const double zero = energy(1, 1, 0);
    const auto second = [&](double x, double y, double gamma) {
        const auto pair = [&](double s) {
            return energy(1 + s * x, 1 + s * y, s * gamma) + energy(1 - s * x, 1 - s * y, -s * gamma) -
                   2 * zero;
        };
        return (16 * pair(h) - pair(2 * h)) / (12 * h * h);  // fourth order
    };
    const double xx = second(1, 0, 0), yy = second(0, 1, 0), both = second(1, 1, 0);
    const double xy = 0.5 * (both - xx - yy);
    return {.shear = second(0, 0, 1), .area = 0.25 * both, .young = xx - xy * xy / yy, .poisson = xy / yy};
}

}  // namespace hemoflux::membrane
