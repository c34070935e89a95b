#include "meshing/hex_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

using Index = std::array<std::size_t, 3>;

/// Uniform on [0, 1), the same on every machine (the standard's distributions are not).
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

template <class T>
void shuffle(std::vector<T>& items, std::mt19937_64& generator) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[generator() % i]);
}

class Box {
  public:
    Box(const RectilinearGrid& grid, const BoxDistortion& distortion) : grid_(grid), distortion_(distortion) {
        for (std::size_t a = 0; a < 3; ++a) n_[a] = grid.axes[a].cells();
    }

    HexMesh run() {
        if (!(std::abs(distortion_.skew) <= 0.1) || !(distortion_.random >= 0 && distortion_.random <= 0.45))
            throw InputError(
                fmt::format("box with skew {} and random {}", distortion_.skew, distortion_.random),
                "cells would be turned inside out", "Give a skew of at most 0.1 and random from 0 to 0.45");
        add_nodes();
        add_cells();
        add_patches();
        if (distortion_.shuffle) shuffle_all();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] std::uint32_t node(const Index& i) const {
        return static_cast<std::uint32_t>((i[2] * (n_[1] + 1) + i[1]) * (n_[0] + 1) + i[0]);
    }

    void add_nodes() {
        Index i;
        for (i[2] = 0; i[2] <= n_[2]; ++i[2])
            for (i[1] = 0; i[1] <= n_[1]; ++i[1])
                for (i[0] = 0; i[0] <= n_[0]; ++i[0]) mesh_.nodes.push_back(place(i));
    }

    Vec3d place(const Index& i) {
        std::array<double, 3> x{};
        double wave = distortion_.skew;
        bool inner = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const Axis& axis = grid_.axes[a];
            x[a] = axis.faces[i[a]];
            if (n_[a] == 1) continue;
            inner = inner && i[a] > 0 && i[a] < n_[a];
            wave *= std::sin(2 * std::numbers::pi * (x[a] - axis.lower()) / axis.length());
        }
        for (std::size_t a = 0; a < 3 && inner; ++a) {
            if (n_[a] == 1) continue;
            const std::vector<double>& faces = grid_.axes[a].faces;
            const double width = std::min(faces[i[a]] - faces[i[a] - 1], faces[i[a] + 1] - faces[i[a]]);
            x[a] += wave * grid_.axes[a].length();
            if (distortion_.random > 0) x[a] += distortion_.random * width * (2 * noise(i, a) - 1);
        }
        return {x[0], x[1], x[2]};
    }

    /// The same for the two ends of a direction of one cell, so that it stays straight.
    [[nodiscard]] double noise(Index i, std::size_t a) const {
        for (std::size_t b = 0; b < 3; ++b)
            if (n_[b] == 1) i[b] = 0;
        std::mt19937_64 generator(distortion_.seed * 0x9E3779B97F4A7C15U + 3 * node(i) + a);
        generator.discard(8);
        return uniform(generator);
    }

    void add_cells() {
        Index i;
        for (i[2] = 0; i[2] < n_[2]; ++i[2])
            for (i[1] = 0; i[1] < n_[1]; ++i[1])
                for (i[0] = 0; i[0] < n_[0]; ++i[0]) {
                    const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
                        return node({i[0] + x, i[1] + y, i[2] + z});
                    };
                    mesh_.cells.push_back({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1),
                                           at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
                }
    }

    void add_patches() {
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
            for (const std::size_t end : {std::size_t{0}, n_[a]}) {
                HexMesh::Patch patch{fmt::format("{}{}", "xyz"[a], end == 0 ? '-' : '+'), {}};
                Index i;
                i[a] = end;
                for (i[c] = 0; i[c] < n_[c]; ++i[c])
                    for (i[b] = 0; i[b] < n_[b]; ++i[b]) {
                        Index p1 = i, p2 = i, p3 = i;
                        ++p1[b], ++p2[b], ++p2[c], ++p3[c];
                        patch.faces.push_back({node(i), node(p1), node(p2), node(p3)});
                    }
                mesh_.patches.push_back(std::move(patch));
            }
        }
    }

    void shuffle_all() {
        std::mt19937_64 generator(distortion_.seed);
        std::vector<std::uint32_t> order(mesh_.nodes.size());
        std::iota(order.begin(), order.end(), 0U);
        shuffle(order, generator);
        std::vector<Vec3d> nodes(mesh_.nodes.size());
        for (std::size_t i = 0; i < order.size(); ++i) nodes[order[i]] = mesh_.nodes[i];
        mesh_.nodes = std::move(nodes);
        for (HexMesh::Patch& patch : mesh_.patches) {
            for (auto& face : patch.faces)
                for (std::uint32_t& n : face) n = order[n];
            shuffle(patch.faces, generator);
        }
        for (auto& cell : mesh_.cells) {
            for (std::uint32_t& n : cell) n = order[n];
            turn(cell, generator());
        }
        shuffle(mesh_.cells, generator);
    }

    /// A random sequence of quarter turns about z and of the cyclic exchange of the axes.
    static void turn(std::array<std::uint32_t, 8>& cell, std::uint64_t choice) {
        for (int step = 0; step < 8; ++step, choice >>= 8) {
            const auto c = cell;
            if (choice % 2 == 0) {
                cell = {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]};
            } else {
                cell = {c[0], c[3], c[7], c[4], c[1], c[2], c[6], c[5]};
            }
        }
    }

    const RectilinearGrid& grid_;
    const BoxDistortion& distortion_;
    Index n_{};
    HexMesh mesh_;
};

}  // namespace

HexMesh box_mesh(const RectilinearGrid& grid, const BoxDistortion& distortion) {
    return Box(grid, distortion).run();
}

HexMesh box_mesh(const Vec3d& lower, const Vec3d& upper, const std::array<int, 3>& cells,
                 const BoxDistortion& distortion) {
    RectilinearGrid grid;
    grid.axes = {uniform_axis(lower.x, upper.x, cells[0]), uniform_axis(lower.y, upper.y, cells[1]),
                 uniform_axis(lower.z, upper.z, cells[2])};
    return box_mesh(grid, distortion);
}

}  // namespace hemoflux::meshing
