#include "meshing/rectilinear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

void check_extent(double lower, double upper, int cells) {
    if (cells < 1)
        throw InputError(fmt::format("grid axis with {} cells", cells), "an axis needs at least one cell",
                         "Give a number of cells of 1 or more");
    if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower < upper))
        throw InputError(fmt::format("grid axis from {} to {} um", lower, upper),
                         "the lower end must be finite and below the upper end",
                         "Exchange the ends or give a positive length");
}

// Faces that are too close for floating point collapse; every constructor ends here.
Axis checked(std::vector<double> faces) {
    if (faces.size() < 2)
        throw InputError(fmt::format("grid axis with {} faces", faces.size()),
                         "an axis of N cells needs N + 1 faces", "List at least two coordinates");
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (!std::isfinite(faces[i]))
            throw InputError(fmt::format("grid axis with face {} at {} um", i, faces[i]),
                             "face coordinates must be finite", "Correct this coordinate");
        if (i > 0 && !(faces[i - 1] < faces[i]))
            throw InputError(
                fmt::format("grid axis with face {} at {} um after {} um", i, faces[i], faces[i - 1]),
                "face coordinates must ascend strictly", "Sort the list and remove repeated coordinates");
    }
    return Axis{std::move(faces)};
}

}  // namespace

std::vector<double> Axis::widths() const {
    std::vector<double> out(cells());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = faces[i + 1] - faces[i];
    return out;
}

std::vector<double> Axis::centres() const {
    std::vector<double> out(cells());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = 0.5 * (faces[i] + faces[i + 1]);
    return out;
}

bool Axis::uniform() const {
    const double rounding =
        4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(lower()), std::abs(upper()));
    return largest() - smallest() <= std::max(1e-12 * largest(), rounding);
}

double Axis::smallest() const {
    const std::vector<double> dx = widths();
    return *std::min_element(dx.begin(), dx.end());
}

double Axis::largest() const {
    const std::vector<double> dx = widths();
    return *std::max_element(dx.begin(), dx.end());
}

double Axis::growth() const {
    const std::vector<double> dx = widths();
    double greatest = 1;
    for (std::size_t i = 1; i < dx.size(); ++i)
        greatest = std::max({greatest, dx[i] / dx[i - 1], dx[i - 1] / dx[i]});
    return greatest;
}

Axis uniform_axis(double lower, double upper, int cells) {
    check_extent(lower, upper, cells);
    std::vector<double> faces(static_cast<std::size_t>(cells) + 1);
    for (int i = 0; i <= cells; ++i)
        faces[static_cast<std::size_t>(i)] = lower + (upper - lower) * (static_cast<double>(i) / cells);
    faces.back() = upper;
    return checked(std::move(faces));
}

Axis plateau_axis(double lower, double upper, int cells, double a, double b) {
    check_extent(lower, upper, cells);
    if (!std::isfinite(a) || !std::isfinite(b) || b < 0)
        throw InputError(fmt::format("plateau axis with a = {}, b = {}", a, b),
                         "a must be finite and b finite and not negative",
                         "Choose a as the half width of the plateau in cells and b near 0.2");
    std::vector<double> f(static_cast<std::size_t>(cells));
    double total = 0;
    for (int i = 1; i <= cells; ++i) {
        const double x = i - 0.5 * cells - 0.5;
        const double value = (std::exp(b * (x - a)) + 1) * (std::exp(b * (-x - a)) + 1);
        f[static_cast<std::size_t>(i) - 1] = value;
        total += value;
    }
    if (!std::isfinite(total))
        throw InputError(fmt::format("plateau axis with {} cells, a = {}, b = {}", cells, a, b),
                         "the widths of (5.31) overflow", "Choose a smaller b or a larger a");
    std::vector<double> faces(f.size() + 1);
    faces.front() = lower;
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        sum += f[i];
        faces[i + 1] = lower + (upper - lower) * (sum / total);
    }
    faces.back() = upper;
    return checked(std::move(faces));
}

Axis chebyshev_axis(double lower, double upper, int cells) {
    check_extent(lower, upper, cells);
    std::vector<double> faces(static_cast<std::size_t>(cells) + 1);
    for (int i = 0; i <= cells; ++i)
        faces[static_cast<std::size_t>(i)] =
            lower + 0.5 * (upper - lower) * (1 - std::cos(std::numbers::pi * i / cells));
    faces.back() = upper;
    return checked(std::move(faces));
}

Axis explicit_axis(std::vector<double> faces) { return checked(std::move(faces)); }

std::size_t RectilinearGrid::cells() const { return axes[0].cells() * axes[1].cells() * axes[2].cells(); }

double RectilinearGrid::smallest() const {
    return std::min({axes[0].smallest(), axes[1].smallest(), axes[2].smallest()});
}

double RectilinearGrid::volume() const { return axes[0].length() * axes[1].length() * axes[2].length(); }

GridQuality quality(const RectilinearGrid& grid) {
    GridQuality q;
    q.smallest = grid.smallest();
    // every combination of one width per axis occurs in some cell
    for (std::size_t d = 0; d < 3; ++d) {
        const double largest = grid.axes[d].largest();
        q.largest = std::max(q.largest, largest);
        q.growth = std::max(q.growth, grid.axes[d].growth());
        for (std::size_t e = 0; e < 3; ++e)
            if (e != d) q.aspect = std::max(q.aspect, largest / grid.axes[e].smallest());
    }
    return q;
}

}  // namespace hemoflux::meshing
