#include "fluid/hex_gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

/// Symmetric or not, three rows.
using Matrix = std::array<Vec3d, 3>;

void add_outer(Matrix& m, const Vec3d& a, const Vec3d& b) {
    m[0] += a.x * b;
    m[1] += a.y * b;
    m[2] += a.z * b;
}

/// Rows of the inverse; false where the matrix is singular to rounding.
bool invert(const Matrix& m, Matrix& inverse) {
    const Vec3d c[3] = {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};  // columns, times det
    const double det = dot(m[0], c[0]);
    if (!(std::abs(det) > 1e-13 * norm(m[0]) * norm(m[1]) * norm(m[2]))) return false;
    const double s = 1 / det;
    inverse = {Vec3d{s * c[0].x, s * c[1].x, s * c[2].x}, Vec3d{s * c[0].y, s * c[1].y, s * c[2].y},
               Vec3d{s * c[0].z, s * c[1].z, s * c[2].z}};
    return true;
}

[[noreturn]] void refuse(const meshing::HexGrid& grid, std::size_t cell) {
    throw InputError(
        fmt::format("cell {} of the mesh", grid.original[cell]),
        "it is so distorted that a neighbour's centre does not lie beyond their common face, or that its "
        "gradient is not defined",
        "improve the mesh there");
}

/// Switch between least squares (1) and Green-Gauss (0), (A.30).
double hybrid_switch(const meshing::HexGrid& grid, std::size_t cell, const HexNeighbour* sides) {
    double distance = 0, area = 0;
    for (std::size_t j = 0; j < hex_sides; ++j) {
        distance = std::max(distance, norm(sides[j].offset));
        area = std::max(area, norm(grid.area[sides[j].face]));
    }
    return std::min(1.0, grid.volume[cell] / (distance * area));
}

}  // namespace

std::vector<Vec3d> ghost_centres(const meshing::HexGrid& grid) {
    std::vector<Vec3d> centres;
    for (std::size_t f = grid.interior_faces(); f < grid.faces(); ++f) {
        const Vec3d n = (1 / norm(grid.area[f])) * grid.area[f], r = grid.centre[grid.left[f]];
        centres.push_back(r + (2 * dot(grid.face_centre[f] - r, n)) * n);
    }
    return centres;
}

std::vector<HexNeighbour> hex_neighbours(const meshing::HexGrid& grid) {
    const std::vector<Vec3d> ghosts = ghost_centres(grid);
    std::vector<HexNeighbour> all;
    all.reserve(hex_sides * grid.cells());
    for (std::size_t cell = 0; cell < grid.cells(); ++cell)
        for (std::size_t s = grid.first_face[cell]; s < grid.first_face[cell + 1]; ++s) {
            const std::uint32_t f = grid.face[s];
            const bool own = grid.outward[s] > 0;
            const std::uint32_t other = own ? grid.right[f] : grid.left[f];
            const Vec3d shift = grid.shift.empty() ? Vec3d{0, 0, 0} : grid.shift[f];
            const Vec3d far = other < grid.cells() ? grid.centre[other] : ghosts[other - grid.cells()];
            Vec3d offset = far - grid.centre[cell], reach = grid.face_centre[f] - grid.centre[cell];
            if (own)
                offset += shift;
            else
                offset -= shift, reach -= shift;
            all.push_back({other, f, own ? 1.0 : -1.0, offset, reach});
        }
    return all;
}

std::vector<double> gradient_weights(const meshing::HexGrid& grid,
                                     const std::vector<HexNeighbour>& neighbours, GradientMethod method) {
    std::vector<double> weights;
    weights.reserve(3 * neighbours.size());
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
        const HexNeighbour* sides = &neighbours[hex_sides * cell];
        const double volume = grid.volume[cell];
        double beta = 1;
        if (method == GradientMethod::green_gauss) beta = 0;
        if (method == GradientMethod::hybrid) beta = hybrid_switch(grid, cell, sides);
        Matrix a{Vec3d{0, 0, 0}, Vec3d{0, 0, 0}, Vec3d{0, 0, 0}}, inverse;
        std::array<Vec3d, hex_sides> right;
        for (std::size_t j = 0; j < hex_sides; ++j) {
            const Vec3d area = sides[j].outward * grid.area[sides[j].face];
            const double surface = norm(area), distance = norm(sides[j].offset);
            const double share = dot(sides[j].reach, area) / dot(sides[j].offset, area);
            if (!(share > 0 && share < 1)) refuse(grid, cell);
            if (method == GradientMethod::green_gauss) {
                right[j] = (share / volume) * area;
                continue;
            }
            right[j] = (beta * 4 * share * share * surface / distance) * sides[j].offset + (1 - beta) * area;
            add_outer(a, right[j], sides[j].offset);
        }
        if (method == GradientMethod::green_gauss)
            inverse = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
        else if (!invert(a, inverse))
            refuse(grid, cell);
        for (const Vec3d& r : right)
            for (const Vec3d& row : inverse) weights.push_back(dot(row, r));
    }
    return weights;
}

}  // namespace hemoflux::fluid
