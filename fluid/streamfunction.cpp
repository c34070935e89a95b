#include "fluid/streamfunction.hpp"

#include <Eigen/SparseCholesky>

#include "exchange/error.hpp"
#include "fluid/host_fields.hpp"

namespace hemoflux::fluid {
namespace {

/// Value on a side of the box: between border and ghost cell, of equal width.
template <class Cell>
double on_side(std::ptrdiff_t i, const Cell& cell) {
    return (cell(i) + cell(i + 1)) / 2;
}

/// Mean value between the centres of the cells i and i + 1 of n, or between a side and the centre beside it.
template <class Cell>
double between(std::ptrdiff_t i, std::ptrdiff_t n, const Cell& cell) {
    if (i == -1) return (on_side(i, cell) + cell(0)) / 2;
    if (i == n - 1) return (cell(i) + on_side(i, cell)) / 2;
    return (cell(i) + cell(i + 1)) / 2;
}

}  // namespace

std::vector<double> solve_poisson(const PlaneField& vorticity, const PlaneBorder& psi) {
    const std::vector<double> dx = vorticity.x.widths(), dy = vorticity.y.widths();
    const std::size_t nx = dx.size(), ny = dy.size();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(5 * nx * ny);
    Eigen::VectorXd right(static_cast<Eigen::Index>(nx * ny));
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const auto cell = static_cast<int>(j * nx + i);
            double sum = vorticity.at(i, j) * dx[i] * dy[j], diagonal = 0;
            const auto neighbour = [&](bool inside, int other, double distance, double length,
                                       double border) {
                const double weight = length / distance;
                diagonal += weight;
                if (inside)
                    entries.emplace_back(cell, other, -weight);
                else
                    sum += weight * border;
            };
            const int row = static_cast<int>(nx);
            neighbour(i > 0, cell - 1, i > 0 ? (dx[i] + dx[i - 1]) / 2 : dx[i] / 2, dy[j], psi.x_lower[j]);
            neighbour(i + 1 < nx, cell + 1, i + 1 < nx ? (dx[i] + dx[i + 1]) / 2 : dx[i] / 2, dy[j],
                      psi.x_upper[j]);
            neighbour(j > 0, cell - row, j > 0 ? (dy[j] + dy[j - 1]) / 2 : dy[j] / 2, dx[i], psi.y_lower[i]);
            neighbour(j + 1 < ny, cell + row, j + 1 < ny ? (dy[j] + dy[j + 1]) / 2 : dy[j] / 2, dx[i],
                      psi.y_upper[i]);
            entries.emplace_back(cell, cell, diagonal);
            right[cell] = sum;
        }
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    const Eigen::VectorXd solution = factors.solve(right);
    return {solution.begin(), solution.end()};
}

PlaneField streamfunction(const Solver& solver) {
    const Grid& grid = solver.grid();
    const auto& axes = grid.rectilinear().axes;
    if (axes[2].cells() != 1 || grid.periodic()[0] || grid.periodic()[1])
        throw InputError("the streamfunction", "it needs a grid one cell thick in z with sides in x and y",
                         "Leave it out, or choose such a grid");
    const HostFields fields = host_fields(solver);
    const auto nx = static_cast<std::ptrdiff_t>(axes[0].cells()),
               ny = static_cast<std::ptrdiff_t>(axes[1].cells());
    const auto in_row = [&](std::size_t c, std::ptrdiff_t j) {
        return [&fields, c, j](std::ptrdiff_t i) { return fields.at(c, i, j, 0); };
    };
    const auto in_column = [&](std::size_t c, std::ptrdiff_t i) {
        return [&fields, c, i](std::ptrdiff_t j) { return fields.at(c, i, j, 0); };
    };
    PlaneField field{axes[0], axes[1], {}};
    const std::vector<double> dx = axes[0].widths(), dy = axes[1].widths();
    for (std::ptrdiff_t j = 0; j < ny; ++j)
        for (std::ptrdiff_t i = 0; i < nx; ++i) {
            const auto v = in_row(2, j);
            const auto u = in_column(1, i);
            field.values.push_back(
                (between(i, nx, v) - between(i - 1, nx, v)) / dx[static_cast<std::size_t>(i)] -
                (between(j, ny, u) - between(j - 1, ny, u)) / dy[static_cast<std::size_t>(j)]);
        }
    // dpsi = u dy - v dx along the sides
    PlaneBorder psi;
    const auto along = [](std::vector<double>& values, double start, double slope, double width) {
        values.push_back(start + slope * width / 2);
        return start + slope * width;
    };
    double lower = 0;
    for (std::ptrdiff_t i = 0; i < nx; ++i)
        lower = along(psi.y_lower, lower, -on_side(-1, in_column(2, i)), dx[static_cast<std::size_t>(i)]);
    double upper = 0;
    for (std::ptrdiff_t j = 0; j < ny; ++j)
        upper = along(psi.x_lower, upper, on_side(-1, in_row(1, j)), dy[static_cast<std::size_t>(j)]);
    for (std::ptrdiff_t i = 0; i < nx; ++i)
        upper = along(psi.y_upper, upper, -on_side(ny - 1, in_column(2, i)), dx[static_cast<std::size_t>(i)]);
    for (std::ptrdiff_t j = 0; j < ny; ++j)
        lower = along(psi.x_upper, lower, on_side(nx - 1, in_row(1, j)), dy[static_cast<std::size_t>(j)]);
    field.values = solve_poisson(field, psi);
    return field;
}

}  // namespace hemoflux::fluid
