// The faces of a rectilinear grid for implicit methods.
#include <algorithm>

#include "exchange/error.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

/// Numbers of the cells along the axes, x fastest.
struct Numbering {
    std::size_t n[3];
    [[nodiscard]] std::uint32_t operator()(const std::size_t (&i)[3]) const {
        return static_cast<std::uint32_t>(i[0] + n[0] * (i[1] + n[1] * i[2]));
    }
};

/// Offsets of the ghost values next to one patch, per face: rows of n1 along the first lateral axis.
std::vector<double> ghost_offsets(const GhostRule& rule, std::size_t n1, std::size_t n2) {
    std::vector<double> offsets(n1 * n2, 0.0);
    if (!rule.value) return offsets;
    std::vector<double> rows(rule.pitch * (n2 - 1) + n1);
    exchange::copy_to_host(rows.data(), rule.value, rows.size() * sizeof(double));
    for (std::size_t b = 0; b < n2; ++b)
        for (std::size_t a = 0; a < n1; ++a) offsets[b * n1 + a] = rule.offset[0] * rows[b * rule.pitch + a];
    return offsets;
}

}  // namespace

CompactModel Solver::compact_model() const {
    if (options_.single_precision)
        throw InputError(
            "implicit steps in single precision",
            "products with the Jacobian are differences of residuals, which need double precision",
            "use double precision, or local time steps");
    const auto& n = grid_.view().layout.n;
    const Numbering number{{n[0], n[1], n[2]}};
    const auto& axes = grid_.rectilinear().axes;
    const std::vector<double> nu =
        state_.view().nu ? state_.interior(state_.view().nu) : std::vector<double>{};
    const double limit = largest_delta(options_);
    CompactModel model{options_.gamma, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t t1 = axis == 0 ? 1 : 0, t2 = axis == 2 ? 1 : 2;
        const auto width = [&](std::size_t a, std::size_t i) {
            return axes[a].faces[i + 1] - axes[a].faces[i];
        };
        for (std::size_t face = 0; face <= n[axis]; ++face) {
            const bool low = face == 0, high = face == n[axis], periodic = grid_.periodic()[axis];
            if (periodic && (high || n[axis] == 1)) continue;  // the face at the low end is the same
            const bool border = (low || high) && !periodic;
            const std::size_t patch = 2 * axis + (high ? 1 : 0);
            std::array<std::vector<double>, 4> offsets;
            if (border)
                for (std::size_t c = 0; c < 4; ++c)
                    offsets[c] = ghost_offsets(boundary_.view().rule[patch][c], n[t1], n[t2]);
            for (std::size_t b = 0; b < n[t2]; ++b)
                for (std::size_t a = 0; a < n[t1]; ++a) {
                    std::size_t left[3], right[3];
                    left[t1] = right[t1] = a, left[t2] = right[t2] = b;
                    left[axis] = low ? (periodic ? n[axis] - 1 : 0) : face - 1;
                    right[axis] = border ? left[axis] : face;
                    CompactFace f;
                    f.left = number(left), f.right = number(right);
                    const double sign = border && low ? -1 : 1;
                    f.normal = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
                    f.area = width(t1, a) * width(t2, b);
                    const double w_left = width(axis, left[axis]), w_right = width(axis, right[axis]);
                    f.weight_left = w_right / (w_left + w_right);
                    f.delta = limit;
                    if (n[axis] > 1) f.delta = std::min({f.delta, w_left, w_right});
                    if (n[t1] > 1) f.delta = std::min(f.delta, width(t1, a) / 2);
                    if (n[t2] > 1) f.delta = std::min(f.delta, width(t2, b) / 2);
                    f.nu = nu.empty() ? options_.nu : (nu[f.left] + nu[f.right]) / 2;
                    f.border = border;
                    if (border) {
                        f.velocity = boundary_.patches()[patch].velocity;
                        f.density = boundary_.patches()[patch].density;
                        for (std::size_t c = 0; c < 4; ++c) f.offset[c] = offsets[c][b * n[t1] + a];
                    }
                    model.faces.push_back(f);
                }
        }
    }
    return model;
}

}  // namespace hemoflux::fluid
