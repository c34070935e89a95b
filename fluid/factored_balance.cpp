// The momentum that the implicit operator of the AF scheme passes through the sides:
//
//   dQ_3 = dQ,  dQ_2 = (I - dt nu Lz) dQ_3,  dQ_1 = (I - dt nu Ly) dQ_2,  (I - dt nu Lx) dQ_1 = dt R
//   sum V dQ = dt sum V R + W_z(dQ_3) + W_y(dQ_2) + W_x(dQ_1),
//
// W the sum of V dt nu L over the cells, of which only the exchange with the ghosts of the sides is left.
#include "fluid/factored.hpp"

namespace hemoflux::fluid {
namespace {

/// One component of all cells, x fastest.
struct Cells {
    std::array<std::size_t, 3> n;
    std::vector<double>& values;
    [[nodiscard]] double& at(const std::array<std::size_t, 3>& c) const {
        return values[(c[2] * n[1] + c[1]) * n[0] + c[0]];
    }
};

/// Replaces x by (I - dt nu L) x along one axis and returns W.
double apply(const Cells& x, std::size_t axis, const LineOperator& op,
             const std::array<std::vector<double>, 3>& widths) {
    const std::size_t n = x.n[axis], a = (axis + 1) % 3, b = (axis + 2) % 3;
    std::vector<double> line(n);
    double through = 0;
    std::array<std::size_t, 3> c{};
    for (c[a] = 0; c[a] < x.n[a]; ++c[a])
        for (c[b] = 0; c[b] < x.n[b]; ++c[b]) {
            for (c[axis] = 0; c[axis] < n; ++c[axis]) line[c[axis]] = x.at(c);
            const double below = op.periodic ? line[n - 1] : op.low * line[0];
            const double above = op.periodic ? line[0] : op.high * line[n - 1];
            for (c[axis] = 0; c[axis] < n; ++c[axis]) {
                const std::size_t i = c[axis];
                x.at(c) += op.down[i] * (line[i] - (i > 0 ? line[i - 1] : below)) +
                           op.up[i] * (line[i] - (i + 1 < n ? line[i + 1] : above));
            }
            if (!op.periodic)
                through -= widths[a][c[a]] * widths[b][c[b]] *
                           (widths[axis][0] * op.down[0] * (line[0] - below) +
                            widths[axis][n - 1] * op.up[n - 1] * (line[n - 1] - above));
        }
    return through;
}

}  // namespace

Vec3d Factored::side_impulse(std::array<std::vector<double>, 3> increments) const {
    double sum[3] = {0, 0, 0};
    for (std::size_t component = 0; component < 3; ++component) {
        const Cells cells{{layout_.n[0], layout_.n[1], layout_.n[2]}, increments[component]};
        for (const std::size_t axis : {2, 1, 0})
            sum[component] += apply(cells, axis, operators_[axis][component], widths_);
    }
    return {sum[0], sum[1], sum[2]};
}

}  // namespace hemoflux::fluid
