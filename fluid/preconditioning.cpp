#include "fluid/preconditioning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"
#include "fluid/time_step.hpp"

namespace hemoflux::fluid {
namespace {

const double sound = 1 / std::sqrt(3.0);

/// Bin edges are powers of this factor times the smallest size.
const double bin_factor = std::pow(2.0, 0.25);

double sum(const Vec3d& s) { return s.x + s.y + s.z; }

std::vector<SizeBin> histogram_of(const std::vector<double>& sorted) {
    std::vector<SizeBin> bins;
    // The first edge lies half a bin below the smallest size, so that rounding does not part equal cells.
    double low = sorted.front() / std::sqrt(bin_factor);
    std::size_t i = 0;
    while (i < sorted.size()) {
        SizeBin bin{low, low * bin_factor, 0};
        for (; i < sorted.size() && sorted[i] < bin.high; ++i) ++bin.count;
        bins.push_back(bin);
        low = bin.high;
    }
    return bins;
}

std::string reasons(const PreconditioningChoice& c, const PreconditioningInput& in, double first,
                    std::size_t cells) {
    std::string text;
    if (in.gamma > 0)
        text += fmt::format("gamma = {:.4g} as given; Table 4.1 starts from 2 Ma = {:.4g}\n", c.gamma, first);
    else if (c.gamma <= first)
        text += fmt::format("gamma = 2 Ma = {:.4g}: Gamma_vc is at most 1 at the most common cell size\n",
                            c.gamma);
    else
        text += fmt::format(
            "gamma = {:.4g}: raised from 2 Ma = {:.4g} until Gamma_vc is {:.3g} at the most common cell "
            "size\n",
            c.gamma, first, c.common_ratio);
    text += fmt::format(
        "Ma = {:.4g}, condition number 1 + gamma/Ma = {:.2f} (by the corrected eigenvalues {:.2f}; without "
        "preconditioning {:.2f})\n",
        c.mach, c.condition, c.corrected_condition, condition_number(1, c.mach));
    text += fmt::format(
        "Gamma_vc: {:.3g} at the most common size {:.4g}, {:.3g} in the finest cell, above 1 in {:.1f} % of "
        "the cells\n",
        c.common_ratio, c.common_size, c.largest_ratio, 100 * c.viscous_share);
    if (c.delta_max > 0)
        text += fmt::format("streaming distance at most {:.4g} (tau - 1/2 >= {:.3g})\n", c.delta_max,
                            in.tau_floor);
    std::size_t most = 0;
    for (const SizeBin& b : c.histogram) most = std::max(most, b.count);
    for (const SizeBin& b : c.histogram)
        text += fmt::format("  cell size {:>9.3g} to {:>9.3g}  {:>9} {:>5.1f} %  {:#<{}}\n", b.low, b.high,
                            b.count, 100.0 * static_cast<double>(b.count) / static_cast<double>(cells), "",
                            (30 * b.count + most - 1) / most);
    return text;
}

}  // namespace

std::vector<CellShape> cell_shapes(const meshing::RectilinearGrid& grid) {
    const std::vector<double> w[3] = {grid.axes[0].widths(), grid.axes[1].widths(), grid.axes[2].widths()};
    std::vector<CellShape> shapes;
    shapes.reserve(w[0].size() * w[1].size() * w[2].size());
    for (const double z : w[2])
        for (const double y : w[1])
            for (const double x : w[0])
                shapes.push_back({x * y * z,
                                  {w[0].size() > 1 ? y * z : 0, w[1].size() > 1 ? x * z : 0,
                                   w[2].size() > 1 ? x * y : 0}});
    return shapes;
}

std::vector<CellShape> cell_shapes(const meshing::HexGrid& grid) {
    std::vector<CellShape> shapes(grid.cells());
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        Vec3d s{0, 0, 0};
        for (std::uint32_t f = grid.first_face[c]; f < grid.first_face[c + 1]; ++f) {
            const Vec3d& a = grid.area[grid.face[f]];
            s += Vec3d{std::abs(a.x) / 2, std::abs(a.y) / 2, std::abs(a.z) / 2};
        }
        shapes[c] = {grid.volume[c], s};
    }
    return shapes;
}

double equivalent_edge(const CellShape& cell) {
    return cell.volume * sum(cell.projection) / dot(cell.projection, cell.projection);
}

double condition_number(double gamma, double mach) { return 1 + gamma / mach; }

double corrected_condition_number(double gamma, double mach) {
    const double u = mach * sound, root = preconditioned_sound(u, gamma);
    return (u + root) / std::min(u, std::abs(u - root));
}

PreconditioningChoice choose_preconditioning(const std::vector<CellShape>& cells,
                                             const PreconditioningInput& in) {
    if (!(in.speed > 0))
        throw InputError(fmt::format("reference speed {}", in.speed), "gamma is chosen from the Mach number",
                         "give a positive speed, or gamma itself");
    if (!(in.nu > 0))
        throw InputError(fmt::format("viscosity {}", in.nu), "it must be positive",
                         "give a positive viscosity");
    if (in.gamma < 0 || in.gamma > 1)
        throw InputError(fmt::format("gamma {}", in.gamma), "the preconditioning parameter lies in (0, 1]",
                         "use 1 for no preconditioning, or leave it out to have it chosen");
    std::vector<double> sizes;
    sizes.reserve(cells.size());
    for (const CellShape& c : cells)
        if (sum(c.projection) > 0) sizes.push_back(equivalent_edge(c));
    if (sizes.empty())
        throw InputError("the grid", "no direction is more than one cell thick", "give it more cells");
    std::sort(sizes.begin(), sizes.end());

    PreconditioningChoice choice;
    choice.histogram = histogram_of(sizes);
    std::size_t before = 0, fullest = 0, first_of_fullest = 0;
    for (const SizeBin& b : choice.histogram) {
        if (b.count > fullest) fullest = b.count, first_of_fullest = before;
        before += b.count;
    }
    choice.common_size = sizes[first_of_fullest + fullest / 2];
    choice.mach = in.speed / sound;
    // Gamma_vc at gamma = 1 of the cube of this edge, with the weight C = 4 of local_step.hpp
    const auto ratio_at_one = [&](double edge) { return 8 * in.nu / (sound * edge); };
    const double first = std::min(1.0, 2 * choice.mach);
    choice.gamma = in.gamma > 0 ? in.gamma : std::min(1.0, std::max(first, ratio_at_one(choice.common_size)));
    choice.condition = condition_number(choice.gamma, choice.mach);
    choice.corrected_condition = corrected_condition_number(choice.gamma, choice.mach);
    choice.common_ratio = ratio_at_one(choice.common_size) / choice.gamma;
    choice.largest_ratio = ratio_at_one(sizes.front()) / choice.gamma;
    const auto viscous = std::partition_point(sizes.begin(), sizes.end(),
                                              [&](double edge) { return ratio_at_one(edge) > choice.gamma; });
    choice.viscous_share = static_cast<double>(viscous - sizes.begin()) / static_cast<double>(sizes.size());
    choice.delta_max = in.tau_floor > 0 ? 3 * in.nu / (choice.gamma * in.tau_floor) : 0;
    choice.reasoning = reasons(choice, in, first, sizes.size());
    return choice;
}

}  // namespace hemoflux::fluid
