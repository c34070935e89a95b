/// Nodes of many membranes sorted into bins, so that those near a point are found at a cost that does not depend on
/// their number.
///
/// The bins are boxes of at least `reach` along every axis, so all nodes within `reach` of a node lie in its bin or the
/// 26 around it. Sorting is by (bin, node): the order, and with it every sum over neighbours, depends on the positions
/// only, not on the number of threads. On periodic axes positions stay unwrapped and distances are those of the nearest
/// image.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "coupling/cell_grid.hpp"
#include "coupling/node_box.hpp"
#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// The box of a fluid grid.
NodeBox node_box(const CellGridView& grid);

/// One number for the periods along x, y and z that an image is away: those up to seven periods apart differ, and crossing
/// a side adds a constant.
HEMOFLUX_INLINE std::int64_t image_number(std::int64_t x, std::int64_t y, std::int64_t z) {
    return x + 16 * y + 256 * z;
}

/// Bins as kernels see them. Sorted node s is node `node[s]` of cell `cell[s]` at (x, y, z)[s].
struct NodeBinsView {
    NodeBox box;
    double per_length[3];  ///< 1/length of the box, 1/um
    int n[3];              ///< bins along each axis
    const int* start;      ///< first sorted node of every bin, and one more entry for the end
    const int *node, *cell;
    const double *x, *y, *z;
    /// 0: the bins around sorted node s hold nothing but the same image of its own cell, so it meets nobody.
    const unsigned char* meets;

    /// Bin of a coordinate along one axis; beyond walls, and for what is not a number, one at an end. turns: periods
    /// between the coordinate and its image in the box, 0 between walls and beyond a million.
    HEMOFLUX_INLINE int along(int axis, double X, int* turns) const {
        double t = (X - box.lower[axis]) * per_length[axis];
        *turns = 0;
        if (box.periodic[axis]) {
            const double whole = std::floor(t);
            if (std::fabs(whole) < 1e6) *turns = static_cast<int>(whole);
            t -= whole;
        }
        const int b = static_cast<int>(t * n[axis]);
        return !(t > 0) ? 0 : b < n[axis] ? b : n[axis] - 1;
    }
    /// Number of the bin of a point, x fastest. image: image_number of its periods.
    HEMOFLUX_INLINE int bin(const Vec3d& r, int* image) const {
        int turns[3];
        const int i = along(0, r.x, &turns[0]), j = along(1, r.y, &turns[1]), k = along(2, r.z, &turns[2]);
        *image = static_cast<int>(image_number(turns[0], turns[1], turns[2]));
        return (k * n[1] + j) * n[0] + i;
    }
    /// Position of sorted node s, um.
    HEMOFLUX_INLINE Vec3d position(int s) const { return {x[s], y[s], z[s]}; }

    /// Bins b - 1, b, b + 1 of one axis, each once: between walls and where there are fewer than three, fewer.
    struct Span {
        int bin[3], count = 0;
        /// Around bin b of n.
        HEMOFLUX_INLINE Span(int b, int n, bool periodic) {
            for (int o = -1; o <= 1; ++o) {
                int c = b + o;
                if (periodic) c = c < 0 ? c + n : c >= n ? c - n : c;
                if (c < 0 || c >= n || (o == 1 && n < 3 && periodic)) continue;
                if (n == 1 && o != 0) continue;
                bin[count++] = c;
            }
        }
    };

    /// Calls visit(s) for every sorted node in the bins around r, in an order that depends on positions only.
    template <class Visitor>
    HEMOFLUX_INLINE void around(const Vec3d& r, Visitor& visit) const {
        int turns;
        const Span xs(along(0, r.x, &turns), n[0], box.periodic[0]),
            ys(along(1, r.y, &turns), n[1], box.periodic[1]),
            zs(along(2, r.z, &turns), n[2], box.periodic[2]);
        for (int c = 0; c < zs.count; ++c)
            for (int b = 0; b < ys.count; ++b) {
                const int row = (zs.bin[c] * n[1] + ys.bin[b]) * n[0];
                for (int a = 0; a < xs.count;) {
                    const int first = xs.bin[a];
                    int last = first;
                    while (++a < xs.count && xs.bin[a] == last + 1) ++last;
                    for (int s = start[row + first]; s < start[row + last + 1]; ++s) visit(s);
                }
            }
    }
};

/// Owns the bins and sorts into them.
class NodeBins {
  public:
    /// For `cells` cells of `vertices` nodes, the first of cell c at c * stride. reach in um. InputError when a periodic
    /// axis is shorter than two reaches, as a node would then meet two images of another.
    NodeBins(const NodeBox& box, double reach, std::size_t cells, std::size_t vertices, std::size_t stride);

    /// Sorts the nodes at x, y, z (device, um).
    void update(const double* x, const double* y, const double* z);

    /// Valid until the next update, as long as this object lives.
    [[nodiscard]] NodeBinsView view() const;
    /// Nodes sorted: cells times vertices.
    [[nodiscard]] std::size_t nodes() const { return node_.size(); }
    /// Smallest edge of the bins, um.
    [[nodiscard]] double reach() const { return reach_; }

  private:
    NodeBox box_;
    double reach_;
    std::size_t cells_, vertices_, stride_, chunk_, chunks_, bins_;
    int n_[3];
    /// Sorted nodes, their cells; where each (bin, chunk) begins, cursors of the sort, where each bin begins.
    exchange::Buffer<int> node_, cell_, chunk_start_, cursor_, start_;
    exchange::Buffer<double> x_, y_, z_;
    /// Bin and image of the nodes as they come, images as they are sorted; owner of every bin (BinOwner).
    exchange::Buffer<int> bin_, image_, sorted_image_;
    exchange::Buffer<std::int64_t> owner_;
    exchange::Buffer<unsigned char> meets_;
};

}  // namespace hemoflux::coupling
