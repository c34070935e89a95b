#include "meshing/surface_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "exchange/error.hpp"
#include "meshing/self_intersection.hpp"

namespace hemoflux::meshing {
namespace {

std::string text(int id) { return std::to_string(id); }
std::string text(const std::array<int, 2>& pair) { return fmt::format("{}-{}", pair[0], pair[1]); }

// "triangles 3, 8, 11, 12, 13 and 20 more"
template <class Id>
std::string listed(const char* one, const char* many, const std::vector<Id>& ids) {
    constexpr std::size_t shown = 5;
    std::vector<std::string> first;
    for (std::size_t i = 0; i < std::min(shown, ids.size()); ++i) first.push_back(text(ids[i]));
    const std::string rest = ids.size() > shown ? fmt::format(" and {} more", ids.size() - shown) : "";
    return fmt::format("{} {}{}", ids.size() == 1 ? one : many, fmt::join(first, ", "), rest);
}

struct Checker {
    const SurfaceMesh& mesh;
    const std::string& name;

    [[noreturn]] void refuse(const std::string& why, const std::string& remedy) const {
        throw InputError("surface mesh " + name, why, remedy);
    }

    void numbers() const {
        if (mesh.triangles.empty()) refuse("it has no triangles", "Give a closed triangulated surface");
        const int n = static_cast<int>(mesh.vertices.size());
        std::vector<int> bad, unused;
        std::vector<char> used(mesh.vertices.size(), 0);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            const auto inside = [n](int v) { return v >= 0 && v < n; };
            if (!inside(a) || !inside(b) || !inside(c) || a == b || b == c || c == a)
                bad.push_back(static_cast<int>(t));
            else
                for (const int v : mesh.triangles[t]) used[static_cast<std::size_t>(v)] = 1;
        }
        if (!bad.empty())
            refuse(fmt::format("a vertex is repeated or unknown in {}", listed("triangle", "triangles", bad)),
                   fmt::format("Use three different vertices from 0 to {}", n - 1));
        bad.clear();
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            const Vec3d& p = mesh.vertices[v];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                bad.push_back(static_cast<int>(v));
            if (!used[v]) unused.push_back(static_cast<int>(v));
        }
        if (!bad.empty())
            refuse(fmt::format("coordinates that are not finite at {}", listed("vertex", "vertices", bad)),
                   "Correct the coordinates");
        if (!unused.empty())
            refuse(fmt::format("no triangle uses {}", listed("vertex", "vertices", unused)),
                   "Remove isolated vertices");
    }

    void count(std::size_t fewest) const {
        if (mesh.vertices.size() < fewest)
            refuse(fmt::format("it has {} vertices, but its curvature needs at least {}",
                               mesh.vertices.size(), fewest),
                   "Refine the mesh");
    }

    // The triangles on both sides of every edge, for `connected`.
    std::vector<std::array<int, 2>> edges_with_two_sides() const {
        struct Side {
            Edge edge;
            int triangle;
            bool forward;
        };
        std::vector<Side> sides;
        sides.reserve(3 * mesh.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const int p = mesh.triangles[t][i], q = mesh.triangles[t][(i + 1) % 3];
                sides.push_back({{std::min(p, q), std::max(p, q)}, static_cast<int>(t), p < q});
            }
        std::stable_sort(sides.begin(), sides.end(),
                         [](const Side& a, const Side& b) { return a.edge < b.edge; });
        std::vector<Edge> open, crowded, clashing;
        std::vector<int> beside_open, beside_crowded;
        std::vector<std::array<int, 2>> neighbours;
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i + 1;
            while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
            if (end - i == 1) {
                open.push_back(sides[i].edge);
                beside_open.push_back(sides[i].triangle);
            } else if (end - i > 2) {
                crowded.push_back(sides[i].edge);
                for (std::size_t k = i; k < end; ++k) beside_crowded.push_back(sides[k].triangle);
            } else {
                neighbours.push_back({sides[i].triangle, sides[i + 1].triangle});
                if (sides[i].forward == sides[i + 1].forward) clashing.push_back(neighbours.back());
            }
            i = end;
        }
        if (!crowded.empty())
            refuse(fmt::format("it is not 2-manifold, more than two triangles meet at {} ({})",
                               listed("edge", "edges", crowded),
                               listed("triangle", "triangles", beside_crowded)),
                   "Remove inner walls and doubled triangles");
        if (!open.empty())
            refuse(fmt::format("it is open, a triangle on one side only at {} ({})",
                               listed("edge", "edges", open), listed("triangle", "triangles", beside_open)),
                   "Close the holes, or merge coincident vertices");
        if (!clashing.empty())
            refuse(fmt::format("neighbouring triangles are oriented against each other: {}",
                               listed("pair", "pairs", clashing)),
                   "Orient all triangles counter-clockwise seen from outside");
        return neighbours;
    }

    // Around a vertex the triangles form one closed fan; two surfaces that touch in a vertex form two.
    void one_fan_per_vertex() const {
        std::vector<std::map<int, int>> next(mesh.vertices.size());
        for (const Triangle& t : mesh.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                next[static_cast<std::size_t>(t[i])][t[(i + 1) % 3]] = t[(i + 2) % 3];
        std::vector<int> touching;
        for (std::size_t v = 0; v < next.size(); ++v) {
            const int start = next[v].begin()->first;
            std::size_t steps = 1;
            for (int at = next[v][start]; at != start; at = next[v][at]) ++steps;
            if (steps < next[v].size()) touching.push_back(static_cast<int>(v));
        }
        if (!touching.empty())
            refuse(fmt::format("it is not 2-manifold, it touches itself in {}",
                               listed("vertex", "vertices", touching)),
                   "Split these vertices");
    }

    void connected(const std::vector<std::array<int, 2>>& neighbours) const {
        std::vector<int> parent(mesh.triangles.size());
        std::iota(parent.begin(), parent.end(), 0);
        const auto root = [&](int t) {
            while (parent[static_cast<std::size_t>(t)] != t) {
                int& up = parent[static_cast<std::size_t>(t)];
                t = up = parent[static_cast<std::size_t>(up)];
            }
            return t;
        };
        for (const auto& [f, g] : neighbours) parent[static_cast<std::size_t>(root(f))] = root(g);
        std::vector<int> firsts;
        std::vector<char> seen(parent.size(), 0);
        for (int t = 0; t < static_cast<int>(parent.size()); ++t)
            if (!std::exchange(seen[static_cast<std::size_t>(root(t))], 1)) firsts.push_back(t);
        if (firsts.size() > 1)
            refuse(fmt::format("it has {} separate parts, which begin with {}", firsts.size(),
                               listed("triangle", "triangles", firsts)),
                   "Keep one part to a file");
    }

    void shape() const {
        std::vector<int> flat;
        const double mean = area(mesh) / static_cast<double>(mesh.triangles.size());
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (!(norm(area_vector(mesh, t)) > 1e-12 * mean)) flat.push_back(static_cast<int>(t));
        if (!flat.empty())
            refuse(fmt::format("no area in {}", listed("triangle", "triangles", flat)),
                   "Remove degenerate triangles");
        const double v = volume(mesh);
        if (!(v > 0))
            refuse(fmt::format("it is inverted, its {} triangles enclose a volume of {:.6g} um^3",
                               mesh.triangles.size(), v),
                   "Orient the triangles counter-clockwise seen from outside");
        const auto pairs = self_intersections(mesh);
        if (!pairs.empty())
            refuse(fmt::format("it intersects itself: triangle {}", listed("pair", "pairs", pairs)),
                   "Move the two sheets apart");
    }
};

}  // namespace

void check_surface(const SurfaceMesh& mesh, const std::string& name, std::size_t fewest_vertices) {
    const Checker check{mesh, name};
    check.numbers();
    check.count(fewest_vertices);
    const auto neighbours = check.edges_with_two_sides();
    check.one_fan_per_vertex();
    check.connected(neighbours);
    check.shape();
}

}  // namespace hemoflux::meshing
