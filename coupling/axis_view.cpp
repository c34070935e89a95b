#include "coupling/axis_view.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// Bins are no wider than the smallest centre distance, so that a look-up steps at most once, up to this many
/// bins per cell; beyond it (ratios of widths above 64) it steps more often.
constexpr double most_bins_per_cell = 64;

/// Value of unwrapped cell k: periodic continuation, or the mirror image beyond a wall.
int source_cell(int k, int n, bool periodic) {
    if (periodic) return ((k % n) + n) % n;
    return k < 0 ? -1 - k : (k >= n ? 2 * n - 1 - k : k);
}

double continued_centre(const std::vector<double>& centres, const meshing::Axis& axis, int k, bool periodic) {
    const int n = static_cast<int>(centres.size());
    const int source = source_cell(k, n, periodic);
    const double c = centres[static_cast<std::size_t>(source)];
    if (periodic) return c + (k - source) / n * axis.length();
    return k < 0 ? 2 * axis.lower() - c : (k >= n ? 2 * axis.upper() - c : c);
}

}  // namespace

AxisData::AxisData(const meshing::Axis& axis, bool periodic, const char* name) {
    const auto centres = axis.centres(), widths = axis.widths();
    const int n = static_cast<int>(axis.cells());
    if (n < 1 || (!periodic && n < stencil_width))
        throw InputError(std::string("axis ") + name + " has " + std::to_string(n) + " cells",
                         "a stencil of the immersed boundary needs four cells between walls",
                         "give it at least four cells, or make it periodic");
    shape_.n = n;
    shape_.periodic = periodic;
    shape_.lower = axis.lower();
    shape_.upper = axis.upper();
    shape_.length = axis.length();

    std::vector<double> centre, width, inverse, lagrange;
    for (int k = -axis_ghosts; k < n + axis_ghosts; ++k) {
        centre.push_back(continued_centre(centres, axis, k, periodic));
        width.push_back(widths[static_cast<std::size_t>(source_cell(k, n, periodic))]);
    }
    for (const double w : widths) inverse.push_back(1 / w);
    for (std::size_t f = 0; f + stencil_width <= centre.size(); ++f)
        for (std::size_t a = 0; a < stencil_width; ++a) {
            double product = 1;
            for (std::size_t b = 0; b < stencil_width; ++b)
                if (b != a) product *= centre[f + a] - centre[f + b];
            lagrange.push_back(1 / product);
        }

    double smallest = shape_.length;
    for (std::size_t k = 0; k + 1 < centre.size(); ++k)
        smallest = std::min(smallest, centre[k + 1] - centre[k]);
    shape_.bins = static_cast<int>(std::ceil(std::min(shape_.length / smallest, most_bins_per_cell * n)));
    shape_.bins_per_length = shape_.bins / shape_.length;
    std::vector<int> bin;
    for (int t = 0, k = -1; t < shape_.bins; ++t) {
        const double start = shape_.lower + t / shape_.bins_per_length;
        while (k < n - 1 && centres[static_cast<std::size_t>(k + 1)] <= start) ++k;
        bin.push_back(k);
    }
    centre.insert(centre.end(), exchange::row_alignment, shape_.upper + shape_.length);
    centre_ = exchange::Buffer<double>(centre);
    width_ = exchange::Buffer<double>(width);
    inverse_width_ = exchange::Buffer<double>(inverse);
    lagrange_ = exchange::Buffer<double>(lagrange);
    bin_ = exchange::Buffer<int>(bin);
}

AxisView AxisData::view() const {
    AxisView v = shape_;
    v.centre = centre_.data() + axis_ghosts;
    v.width = width_.data() + axis_ghosts;
    v.inverse_width = inverse_width_.data();
    v.lagrange = lagrange_.data();
    v.bin = bin_.data();
    return v;
}

}  // namespace hemoflux::coupling
