#include "fluid/grid_interpolant.hpp"

#include <algorithm>

#include "fluid/host_fields.hpp"

namespace hemoflux::fluid {
namespace {

/// A node's value is the mean of the cells first and second (the same cell, or the two at a side).
struct Node {
    double at;
    std::ptrdiff_t first, second;
};

std::vector<Node> nodes_of(const Grid& grid, std::size_t axis, Border lower, Border upper) {
    const meshing::Axis& faces = grid.rectilinear().axes[axis];
    const std::vector<double> centres = ghosted_centres(grid, axis);
    constexpr auto g = static_cast<std::ptrdiff_t>(exchange::ghosts);
    const auto n = static_cast<std::ptrdiff_t>(faces.cells());
    std::vector<Node> nodes;
    if (lower == Border::face) nodes.push_back({faces.lower(), -1, 0});
    const std::ptrdiff_t first = lower == Border::periodic ? -g : 0,
                         last = upper == Border::periodic ? n + g : n;
    for (std::ptrdiff_t i = first; i < last; ++i)
        nodes.push_back({centres[static_cast<std::size_t>(i + g)], i, i});
    if (upper == Border::face) nodes.push_back({faces.upper(), n - 1, n});
    return nodes;
}

/// Up to four nodes around a coordinate and their Lagrange weights.
struct Stencil {
    std::size_t first = 0, count = 0;
    double weight[4] = {0, 0, 0, 0};
};

Stencil stencil_at(const std::vector<double>& nodes, double x) {
    Stencil s;
    s.count = std::min<std::size_t>(4, nodes.size());
    const auto above =
        static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
    s.first = std::min(above < 2 ? 0 : above - 2, nodes.size() - s.count);
    for (std::size_t a = 0; a < s.count; ++a) {
        s.weight[a] = 1;
        for (std::size_t b = 0; b < s.count; ++b)
            if (b != a) s.weight[a] *= (x - nodes[s.first + b]) / (nodes[s.first + a] - nodes[s.first + b]);
    }
    return s;
}

}  // namespace

GridInterpolant::GridInterpolant(const Grid& grid, const std::vector<double>& padded,
                                 const std::array<Border, 6>& borders) {
    std::array<std::vector<Node>, 3> nodes;
    for (std::size_t a = 0; a < 3; ++a) {
        nodes[a] = nodes_of(grid, a, borders[2 * a], borders[2 * a + 1]);
        for (const Node& node : nodes[a]) nodes_[a].push_back(node.at);
    }
    const exchange::Layout& layout = grid.view().layout;
    values_.reserve(nodes[0].size() * nodes[1].size() * nodes[2].size());
    for (const Node& z : nodes[2])
        for (const Node& y : nodes[1])
            for (const Node& x : nodes[0]) {
                double sum = 0;
                for (const std::ptrdiff_t k : {z.first, z.second})
                    for (const std::ptrdiff_t j : {y.first, y.second})
                        for (const std::ptrdiff_t i : {x.first, x.second}) sum += padded[layout.at(i, j, k)];
                values_.push_back(sum / 8);
            }
}

double GridInterpolant::operator()(const Vec3d& at) const {
    const Stencil x = stencil_at(nodes_[0], at.x), y = stencil_at(nodes_[1], at.y),
                  z = stencil_at(nodes_[2], at.z);
    double sum = 0;
    for (std::size_t k = 0; k < z.count; ++k)
        for (std::size_t j = 0; j < y.count; ++j) {
            const double* row =
                values_.data() + ((z.first + k) * nodes_[1].size() + y.first + j) * nodes_[0].size();
            double along = 0;
            for (std::size_t i = 0; i < x.count; ++i) along += x.weight[i] * row[x.first + i];
            sum += y.weight[j] * z.weight[k] * along;
        }
    return sum;
}

std::vector<double> padded_field(const Grid& grid, const std::vector<double>& interior, double sign) {
    const exchange::Layout& layout = grid.view().layout;
    std::vector<double> padded(layout.size);
    const auto mirror = [](std::ptrdiff_t i, std::ptrdiff_t n) {
        const std::ptrdiff_t m = i < 0 ? -1 - i : (i >= n ? 2 * n - 1 - i : i);
        return std::clamp<std::ptrdiff_t>(m, 0, n - 1);
    };
    constexpr auto g = static_cast<std::ptrdiff_t>(exchange::ghosts);
    const auto n = [&](int a) { return static_cast<std::ptrdiff_t>(layout.n[a]); };
    for (std::ptrdiff_t k = -g; k < n(2) + g; ++k)
        for (std::ptrdiff_t j = -g; j < n(1) + g; ++j)
            for (std::ptrdiff_t i = -g; i < n(0) + g; ++i) {
                const std::ptrdiff_t a = mirror(i, n(0)), b = mirror(j, n(1)), c = mirror(k, n(2));
                const int outside = (a != i) + (b != j) + (c != k);
                const double value = interior[static_cast<std::size_t>(a + n(0) * (b + n(1) * c))];
                padded[layout.at(i, j, k)] = outside % 2 == 1 ? sign * value : value;
            }
    return padded;
}

}  // namespace hemoflux::fluid
