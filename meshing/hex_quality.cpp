#include "meshing/hex_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemoflux::meshing {
namespace {

/// Keeps the largest value and where it was.
void raise(double value, std::size_t cell, double& largest, std::size_t& where) {
    if (!(value > largest)) return;
    largest = value;
    where = cell;
}

void add_faces(const HexGrid& grid, HexQuality& q) {
    const std::size_t interior = grid.interior_faces();
    for (std::size_t f = 0; f < interior; ++f) {
        const std::size_t a = grid.left[f], b = grid.right[f];
        Vec3d d = grid.centre[b] - grid.centre[a];
        if (!grid.shift.empty()) d += grid.shift[f];
        const double distance = norm(d), area = norm(grid.area[f]), along = dot(d, grid.area[f]);
        const double cosine = std::clamp(along / (distance * area), -1.0, 1.0);
        const double angle = std::acos(cosine) * 180 / std::numbers::pi;
        const Vec3d to_face = grid.face_centre[f] - grid.centre[a];
        const Vec3d miss = to_face - (dot(to_face, grid.area[f]) / along) * d;
        const double skewness = norm(miss) / distance;
        const double va = grid.volume[a], vb = grid.volume[b];
        raise(angle, grid.original[a], q.nonorthogonality, q.nonorthogonal_cell);
        raise(skewness, grid.original[a], q.skewness, q.skew_cell);
        raise(std::max(va, vb) / std::min(va, vb), grid.original[a], q.growth, q.growth_cell);
        q.mean_nonorthogonality += angle / static_cast<double>(interior);
        q.mean_skewness += skewness / static_cast<double>(interior);
        q.bandwidth = std::max(q.bandwidth, b - a);
    }
}

}  // namespace

HexQuality quality(const HexGrid& grid) {
    HexQuality q;
    q.cells = grid.cells();
    q.faces = grid.faces();
    q.smallest_volume = *std::min_element(grid.volume.begin(), grid.volume.end());
    q.largest_volume = *std::max_element(grid.volume.begin(), grid.volume.end());
    q.smallest_delta = *std::min_element(grid.delta.begin(), grid.delta.end());
    q.largest_delta = *std::max_element(grid.delta.begin(), grid.delta.end());
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        q.volume += grid.volume[c];
        raise(grid.aspect[c], grid.original[c], q.aspect, q.aspect_cell);
    }
    add_faces(grid, q);
    return q;
}

std::string report(const HexQuality& q, const std::string& unit) {
    std::string text = fmt::format("cells                {}\nfaces                {}\n", q.cells, q.faces);
    text += fmt::format("volume               {:.8g} {}^3, cells {:.4g} .. {:.4g}\n", q.volume, unit,
                        q.smallest_volume, q.largest_volume);
    text += fmt::format("non-orthogonality    {:.2f} degrees at most (cell {}), {:.2f} in the mean\n",
                        q.nonorthogonality, q.nonorthogonal_cell, q.mean_nonorthogonality);
    text += fmt::format("skewness             {:.3f} at most (cell {}), {:.4f} in the mean\n", q.skewness,
                        q.skew_cell, q.mean_skewness);
    text += fmt::format("aspect ratio         {:.4g} at most (cell {})\n", q.aspect, q.aspect_cell);
    text += fmt::format("growth of volumes    {:.4g} at most (cell {})\n", q.growth, q.growth_cell);
    text +=
        fmt::format("streaming distance   {:.4g} .. {:.4g} {}\n", q.smallest_delta, q.largest_delta, unit);
    text += fmt::format("bandwidth            {}\n", q.bandwidth);
    return text;
}

}  // namespace hemoflux::meshing
