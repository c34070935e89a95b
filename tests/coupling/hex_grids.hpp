/// Hexahedral grids for the tests of this room.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "coupling/hex_link.hpp"
#include "exchange/buffer.hpp"
#include "grids.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_grid.hpp"
#include "meshing/hex_pipe.hpp"

namespace hemoflux::coupling::test {

/// A box of n^3 cells over [0, 6]^3, its nodes moved at random by up to `random` of a cell, cells and nodes shuffled. With
/// `periodic`, x- and x+ are glued.
inline meshing::HexGrid skewed_box(int n, double random, bool periodic = false) {
    meshing::BoxDistortion d;
    d.skew = random > 0 ? 0.02 : 0;
    d.random = random;
    d.shuffle = true;
    d.seed = 5;
    const meshing::HexMesh mesh = meshing::box_mesh(Vec3d{0, 0, 0}, {6, 6, 6}, {n, n, n}, d);
    return meshing::make_hex_grid(mesh, periodic ? std::vector<meshing::PeriodicPair>{{"x-", "x+"}}
                                                 : std::vector<meshing::PeriodicPair>{});
}

/// A round pipe along x, 10 um wide and 12 um long, that repeats.
inline meshing::HexGrid pipe(int cells = 3000) {
    meshing::PipeShape shape;
    shape.diameter = 10;
    shape.length = 1.2;
    shape.cells = cells;
    return meshing::make_hex_grid(meshing::pipe_mesh(shape), {{"inlet", "outlet"}});
}

/// Points anywhere in [low, high]^3.
inline std::vector<Vec3d> anywhere(std::size_t n, double low, double high, unsigned seed = 3) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> on(low, high);
    std::vector<Vec3d> points(n);
    for (Vec3d& p : points) p = {on(engine), on(engine), on(engine)};
    return points;
}

inline exchange::FieldView view(const Points& p, std::size_t n) {
    // links only read positions; the view is shared with fields, so it carries no const
    return {{const_cast<double*>(p[0]), const_cast<double*>(p[1]), const_cast<double*>(p[2])}, n};
}

/// A vector field of n values per component, as records of four like those of HexSolver.
struct Records {
    explicit Records(std::size_t n) : size(n), data(4 * n) {}
    exchange::FieldView view() { return {{data.data(), data.data() + 1, data.data() + 2}, size, 4}; }
    void set(const std::vector<Vec3d>& v) {
        std::vector<double> host(4 * size);
        for (std::size_t i = 0; i < size; ++i)
            host[4 * i] = v[i].x, host[4 * i + 1] = v[i].y, host[4 * i + 2] = v[i].z;
        data.assign(host);
    }
    [[nodiscard]] std::vector<Vec3d> get() const {
        const auto host = data.to_host();
        std::vector<Vec3d> v;
        for (std::size_t i = 0; i < size; ++i) v.push_back({host[4 * i], host[4 * i + 1], host[4 * i + 2]});
        return v;
    }
    std::size_t size;
    exchange::Buffer<double> data;
};

}  // namespace hemoflux::coupling::test
