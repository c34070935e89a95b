#include "fluid/grid.hpp"

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

constexpr std::size_t g = exchange::ghosts;
/// Arrays are shifted so that kernels may read a whole pack before the first and past the last cell.
constexpr std::size_t shift = exchange::row_alignment;

/// Cell widths with two ghost cells at either end.
std::vector<double> with_ghosts(const std::vector<double>& widths, bool periodic) {
    const auto n = static_cast<std::ptrdiff_t>(widths.size());
    std::vector<double> all;
    for (std::ptrdiff_t i = -static_cast<std::ptrdiff_t>(g); i < n + static_cast<std::ptrdiff_t>(g); ++i) {
        std::ptrdiff_t source = i;
        if (i < 0 || i >= n) {
            if (periodic)
                source = ((i % n) + n) % n;
            else
                source = std::clamp(i < 0 ? -1 - i : 2 * n - 1 - i, std::ptrdiff_t{0}, n - 1);
        }
        all.push_back(widths[static_cast<std::size_t>(source)]);
    }
    return all;
}

/// Half the width of the cells if they are cubes and delta_max leaves them their streaming distance, else 0.
/// An axis one cell thick may have any width if it is periodic: nothing changes along it.
double cubic_delta(const meshing::RectilinearGrid& grid, const std::array<bool, 3>& periodic,
                   double delta_max) {
    double width = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const meshing::Axis& axis = grid.axes[a];
        if (!axis.uniform()) return 0;
        if (axis.cells() == 1 && periodic[a]) continue;
        const double of_axis = axis.length() / static_cast<double>(axis.cells());
        if (width > 0 && std::abs(of_axis - width) > 1e-12 * width) return 0;
        if (axis.cells() == 1) return 0;
        width = of_axis;
    }
    return width / 2 <= delta_max ? width / 2 : 0;
}

}  // namespace

Grid::Grid(const meshing::RectilinearGrid& grid, std::array<bool, 3> periodic, double delta_max,
           GradientMethod gradient)
    : rectilinear_(grid), periodic_(periodic), uniform_(true) {
    if (gradient == GradientMethod::hybrid)
        throw InputError(
            "hybrid gradients on a rectilinear grid",
            "their weights depend on the shape of each cell, the differences here on one axis alone",
            "use least-squares or green-gauss");
    view_.layout = exchange::Layout(grid.axes[0].cells(), grid.axes[1].cells(), grid.axes[2].cells());
    constexpr double unlimited = 1e300;
    for (std::size_t a = 0; a < 3; ++a) {
        const meshing::Axis& axis = grid.axes[a];
        uniform_ = uniform_ && axis.uniform();
        std::vector<double> dx = with_ghosts(axis.widths(), periodic[a]);
        if (axis.uniform())
            std::fill(dx.begin(), dx.end(), axis.length() / static_cast<double>(axis.cells()));
        widths_[a] = dx;
        const bool thick = axis.cells() > 1;
        const std::size_t length = axis.cells() + 2 * g + 3 * shift;
        std::array<std::vector<double>, 9> arrays;
        arrays.fill(std::vector<double>(length, 1.0));
        auto& [plus, minus, half, inverse, weight_left, normal, inv_normal, lateral, inv_lateral] = arrays;
        for (std::size_t m = 0; m < dx.size(); ++m) {
            const std::size_t at = shift - g + m;
            half[at] = dx[m] / 2;
            inverse[at] = 1 / dx[m];
            lateral[at] = std::min(thick ? dx[m] / 2 : unlimited, delta_max);
            inv_lateral[at] = 1 / lateral[at];
            if (m + 1 == dx.size()) continue;
            const double s_plus = (dx[m] + dx[m + 1]) / 2;
            weight_left[at] = dx[m + 1] / (dx[m] + dx[m + 1]);
            normal[at] = std::min(thick ? std::min(dx[m], dx[m + 1]) : unlimited, delta_max);
            inv_normal[at] = 1 / normal[at];
            if (m == 0) continue;
            const double s_minus = (dx[m] + dx[m - 1]) / 2;
            const bool least_squares = gradient == GradientMethod::least_squares;
            plus[at] = least_squares ? s_minus / (s_plus * (s_plus + s_minus)) : 1 / (2 * s_plus);
            minus[at] = least_squares ? s_plus / (s_minus * (s_plus + s_minus)) : 1 / (2 * s_minus);
        }
        AxisView& v = view_.axis[a];
        const double** slots[9] = {&v.plus,   &v.minus,      &v.half,    &v.inverse,    &v.weight_left,
                                   &v.normal, &v.inv_normal, &v.lateral, &v.inv_lateral};
        for (std::size_t s = 0; s < 9; ++s) {
            buffers_.emplace_back(arrays[s]);
            *slots[s] = buffers_.back().data() + shift;
        }
    }
    view_.delta = cubic_delta(grid, periodic, delta_max);
    for (std::size_t a = 0; a < 3; ++a) {
        const auto limit = [&](std::size_t axis, double share) {
            return grid.axes[axis].cells() > 1 ? share * grid.axes[axis].smallest() : unlimited;
        };
        smallest_delta_[a] =
            std::min({limit(a, 1.0), limit((a + 1) % 3, 0.5), limit((a + 2) % 3, 0.5), delta_max});
    }
}

std::vector<double> ghosted_centres(const Grid& grid, std::size_t axis) {
    const auto& widths = grid.ghosted_widths(static_cast<int>(axis));
    double face = grid.rectilinear().axes[axis].lower();
    for (std::size_t i = 0; i < g; ++i) face -= widths[i];
    std::vector<double> centres;
    for (const double w : widths) centres.push_back(face + w / 2), face += w;
    return centres;
}

}  // namespace hemoflux::fluid
