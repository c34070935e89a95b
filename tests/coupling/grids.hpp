/// Grids and helpers shared by the tests of this room.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "coupling/cell_grid.hpp"
#include "exchange/buffer.hpp"
#include "exchange/field.hpp"
#include "exchange/vec3.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::coupling::test {

/// An axis of n cells over [lower, upper] whose neighbouring widths differ by up to a factor of two, at
/// random.
inline meshing::Axis random_axis(double lower, double upper, int n, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> width(1, 2);
    std::vector<double> faces{0};
    for (int i = 0; i < n; ++i) faces.push_back(faces.back() + width(engine));
    const double scale = (upper - lower) / faces.back();
    for (double& f : faces) f = lower + f * scale;
    return meshing::explicit_axis(faces);
}

struct NamedAxis {
    std::string name;
    meshing::Axis axis;
};
/// The axes every kernel is tested on.
inline std::vector<NamedAxis> axes() {
    return {{"uniform", meshing::uniform_axis(-6, 6, 30)},
            {"plateau", meshing::plateau_axis(-6, 6, 30, 10, 0.2)},
            {"random", random_axis(-6, 6, 17, 7)}};
}

/// The tank-treading grid: box 12 um, 30^3 cells, plateau a = 10, b = 0.2.
inline meshing::RectilinearGrid tank_treading_grid() {
    const auto axis = meshing::plateau_axis(-6, 6, 30, 10, 0.2);
    return {{axis, axis, axis}};
}
/// Three different axes, to tell x from y from z.
inline meshing::RectilinearGrid mixed_grid() {
    return {{random_axis(-3, 5, 19, 3), meshing::plateau_axis(-4, 4, 16, 5, 0.4),
             meshing::uniform_axis(0, 6, 11)}};
}

/// A vector field with its memory.
struct Field {
    explicit Field(const exchange::Layout& layout) : size(layout.size) {
        for (auto& b : component) b = exchange::Buffer<double>(size);
    }
    exchange::FieldView view() {
        return {{component[0].data(), component[1].data(), component[2].data()}, size};
    }
    std::size_t size;
    exchange::Buffer<double> component[3];
};

/// Marker positions with their memory.
struct Points {
    explicit Points(const std::vector<Vec3d>& p) {
        std::vector<double> c[3];
        for (const Vec3d& a : p) c[0].push_back(a.x), c[1].push_back(a.y), c[2].push_back(a.z);
        for (int q = 0; q < 3; ++q) component[q] = exchange::Buffer<double>(c[q]);
    }
    const double* operator[](int q) const { return component[q].data(); }
    exchange::Buffer<double> component[3];
};

}  // namespace hemoflux::coupling::test
