#include "meshing/hex_cavity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "exchange/error.hpp"
#include "meshing/gmsh_session.hpp"
#include "meshing/plane_mesh.hpp"

namespace hemoflux::meshing {
namespace {

/// Width of cells in the unit square over that in the middle, at the distance d from the nearest wall.
double width(double wall, double d) {
    const double u = 1 - 2 * d;
    return wall + (1 - wall) * (1 - u * u);
}

double width(double wall, double x, double y) { return width(wall, std::min({x, 1 - x, y, 1 - y})); }

/// Number of widths h_c width(z) between 0 and 1, for h_c = 1.
double layers_per_unit(double wall) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps;
        sum += 1 / width(wall, std::min(z, 1 - z)) / steps;
    }
    return sum;
}

/// Number of squares of the width h_c width(x, y) in the unit square, for h_c = 1.
double cells_per_unit_area(double wall) {
    constexpr int steps = 500;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double h = width(wall, (i + 0.5) / steps, (j + 0.5) / steps);
            sum += 1 / (h * h * steps * steps);
        }
    }
    return sum;
}

/// Levels between 0 and 1 with spacings in the ratio of width(z).
std::vector<double> graded_levels(double wall, int layers) {
    constexpr int steps = 20000;
    const double per_layer = layers_per_unit(wall) / layers;
    std::vector<double> levels{0};
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps, add = 1 / width(wall, std::min(z, 1 - z)) / steps;
        const double next = per_layer * static_cast<double>(levels.size());
        if (sum + add >= next && static_cast<int>(levels.size()) < layers)
            levels.push_back((i + (next - sum) / add) / steps);
        sum += add;
    }
    levels.push_back(1);
    for (std::size_t i = 0; 2 * i < levels.size(); ++i) {  // symmetric to the last bit
        const double low = 0.5 * (levels[i] + 1 - levels[levels.size() - 1 - i]);
        levels[i] = low;
        levels[levels.size() - 1 - i] = 1 - low;
    }
    return levels;
}

/// The unit square meshed by gmsh for the width h_c width(x, y).
PlaneMesh paved_square(double wall, double middle) {
    namespace geo = gmsh::model::geo;
    namespace mesh = gmsh::model::mesh;
    gmsh::model::add("square");
    const int p[4] = {geo::addPoint(0, 0, 0), geo::addPoint(1, 0, 0), geo::addPoint(1, 1, 0),
                      geo::addPoint(0, 1, 0)};
    std::vector<int> lines;
    for (int k = 0; k < 4; ++k) lines.push_back(geo::addLine(p[k], p[(k + 1) % 4]));
    const int surface = geo::addPlaneSurface({geo::addCurveLoop(lines)});
    geo::synchronize();
    const auto set = [](const char* option, double value) { gmsh::option::setNumber(option, value); };
    set("Mesh.Algorithm", 6);  // frontal Delaunay; 8, meant for quadrilaterals, crashes in gmsh 4.8
    set("Mesh.RecombinationAlgorithm", 3);  // blossom full-quad, which leaves no triangles
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    set("Mesh.MeshSizeFromPoints", 0);
    mesh::setSizeCallback([=](int, int, double x, double y, double) { return middle * width(wall, x, y); });
    mesh::setRecombine(2, surface);
    mesh::generate(2);

    PlaneMesh plane;
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    mesh::getNodes(tags, x, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, std::uint32_t> number;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        number.emplace(tags[i], static_cast<std::uint32_t>(i));
        plane.nodes.push_back({x[3 * i], x[3 * i + 1]});
    }
    const auto elements = [&number](int type, int entity) {
        // always empty ones: gmsh takes others to be of the right size
        std::vector<std::size_t> names, nodes;
        mesh::getElementsByType(type, names, nodes, entity);
        std::vector<std::uint32_t> out;
        for (const std::size_t n : nodes) out.push_back(number.at(n));
        return out;
    };
    if (!elements(2, -1).empty()) throw FormatError("gmsh left triangles among the quadrilaterals");
    const std::vector<std::uint32_t> quads = elements(3, -1);
    for (std::size_t e = 0; e < quads.size(); e += 4)
        plane.quads.push_back({quads[e], quads[e + 1], quads[e + 2], quads[e + 3]});
    const char* names[4] = {"y-", "x+", "y+", "x-"};
    for (std::size_t k = 0; k < 4; ++k) {
        plane.sides.push_back({names[k], {}});
        const std::vector<std::uint32_t> edges = elements(1, lines[k]);
        for (std::size_t e = 0; e < edges.size(); e += 2)
            plane.sides[k].edges.push_back({edges[e], edges[e + 1]});
    }
    return plane;
}

/// The unit square paved with about `wanted` quadrilaterals. gmsh does not meet the width asked for to the last, so
/// that this is corrected a few times; the closest mesh is kept.
PlaneMesh paved_for(double wall, double middle, double wanted) {
    PlaneMesh best;
    double closest = 1e300;
    for (int attempt = 0; attempt < 6 && closest > 0.005; ++attempt) {
        PlaneMesh plane = with_gmsh([&] { return paved_square(wall, middle); });
        const double excess = static_cast<double>(plane.quads.size()) / wanted;
        middle *= std::sqrt(excess);
        if (std::abs(excess - 1) >= closest) continue;
        closest = std::abs(excess - 1);
        best = std::move(plane);
    }
    return best;
}

/// Moves every inner node to the mean of its neighbours, sweep by sweep.
void even_out(PlaneMesh& plane) {
    constexpr int sweeps = 60;
    std::vector<bool> fixed(plane.nodes.size(), false);
    for (const PlaneMesh::Side& side : plane.sides)
        for (const auto& edge : side.edges) fixed[edge[0]] = fixed[edge[1]] = true;
    std::vector<std::vector<std::uint32_t>> neighbours(plane.nodes.size());
    // inner edges are met from both sides: each neighbour is listed once
    for (const auto& quad : plane.quads)
        for (std::size_t k = 0; k < 4; ++k) neighbours[quad[k]].push_back(quad[(k + 1) % 4]);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
            if (fixed[i]) continue;
            double x = 0, y = 0;
            for (const std::uint32_t j : neighbours[i]) {
                x += plane.nodes[j][0];
                y += plane.nodes[j][1];
            }
            const auto count = static_cast<double>(neighbours[i].size());
            plane.nodes[i] = {x / count, y / count};
        }
    }
}

void check(const CavityShape& s) {
    const auto refuse = [](const std::string& what, const std::string& range) {
        throw InputError("cube with " + what, "it must be " + range, "Change this option");
    };
    if (!(s.edge > 0) || !std::isfinite(s.edge)) refuse(fmt::format("edge {}", s.edge), "above 0");
    if (s.cells < 64 || s.cells > 20000000) refuse(fmt::format("{} cells", s.cells), "from 64 to 20 million");
    if (!(s.wall >= 0.1 && s.wall <= 1)) refuse(fmt::format("wall {}", s.wall), "from 0.1 to 1");
}

}  // namespace

HexMesh cavity_mesh(const CavityShape& s) {
    check(s);
    const double h = std::cbrt(layers_per_unit(s.wall) * cells_per_unit_area(s.wall) / s.cells);
    const int layers = std::max(2, static_cast<int>(std::lround(layers_per_unit(s.wall) / h)));
    PlaneMesh plane;
    try {
        plane = paved_for(s.wall, h, static_cast<double>(s.cells) / layers);
    } catch (const FormatError& error) {
        throw InputError(fmt::format("cube of {} cells", s.cells), error.what(), "Ask for more cells");
    }
    even_out(plane);
    for (auto& [x, y] : plane.nodes) x = s.edge * (x - 0.5), y = s.edge * (y - 0.5);
    std::vector<double> levels = graded_levels(s.wall, layers);
    for (double& z : levels) z = s.edge * (z - 0.5);
    return extrude(plane, levels, "z-", "z+");
}

}  // namespace hemoflux::meshing
