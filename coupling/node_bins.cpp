#include "coupling/node_bins.hpp"

#include <algorithm>
#include <string>

#include "exchange/error.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Cells of one chunk of the counting sort; entry (bin, chunk) lies at bin * chunks + chunk.
struct SortNodes {
    NodeBinsView bins;
    std::size_t cells, vertices, stride, chunk, chunks, count;
    const double *x, *y, *z;
    int *cursor, *node, *cell;
    double *sx, *sy, *sz;

    template <class Visitor>
    HEMOFLUX_INLINE void visit(std::size_t c, const Visitor& visitor) const {
        const std::size_t last = (c + 1) * chunk < cells ? (c + 1) * chunk : cells;
        for (std::size_t k = c * chunk; k < last; ++k)
            for (std::size_t v = 0; v < vertices; ++v) {
                const std::size_t i = k * stride + v;
                visitor(bins.bin({x[i], y[i], z[i]}) * chunks + c, i, k);
            }
    }
};

struct CountNodes : SortNodes {
    struct Count {
        int* cursor;
        HEMOFLUX_INLINE void operator()(std::size_t entry, std::size_t, std::size_t) const {
            ++cursor[entry];
        }
    };
    HEMOFLUX_FN void operator()(std::size_t c) const {
        for (std::size_t b = 0; b < count; ++b) cursor[b * chunks + c] = 0;
        visit(c, Count{cursor});
    }
};

struct PlaceNodes : SortNodes {
    struct Place {
        const PlaceNodes& p;
        HEMOFLUX_INLINE void operator()(std::size_t entry, std::size_t i, std::size_t k) const {
            const int s = p.cursor[entry]++;
            p.node[s] = static_cast<int>(i);
            p.cell[s] = static_cast<int>(k);
            p.sx[s] = p.x[i], p.sy[s] = p.y[i], p.sz[s] = p.z[i];
        }
    };
    HEMOFLUX_FN void operator()(std::size_t c) const { visit(c, Place{*this}); }
};

/// Where every bin begins.
struct BinStart {
    const int* chunk_start;
    std::size_t chunks;
    int* start;
    HEMOFLUX_FN void operator()(std::size_t b) const { start[b] = chunk_start[b * chunks]; }
};

}  // namespace

NodeBox node_box(const CellGridView& grid) {
    NodeBox box;
    for (int q = 0; q < 3; ++q) {
        box.lower[q] = grid.axis[q].lower;
        box.length[q] = grid.axis[q].length;
        box.periodic[q] = grid.axis[q].periodic;
    }
    return box;
}

NodeBins::NodeBins(const NodeBox& box, double reach, std::size_t cells, std::size_t vertices,
                   std::size_t stride)
    : box_(box),
      reach_(reach),
      cells_(cells),
      vertices_(vertices),
      stride_(stride),
      node_(cells * vertices),
      cell_(cells * vertices),
      x_(cells * vertices),
      y_(cells * vertices),
      z_(cells * vertices) {
    // bins of an empty box cost time as well: about as many as nodes are enough
    const double most = std::cbrt(std::max(4096.0, 2.0 * static_cast<double>(nodes())) /
                                  (box.length[0] * box.length[1] * box.length[2]));
    for (int q = 0; q < 3; ++q) {
        if (box.periodic[q] && box.length[q] < 2 * reach)
            throw InputError("a periodic side " + std::string(1, "xyz"[q]) + " of " +
                                 std::to_string(box.length[q]) + " um",
                             "cells feel each other up to " + std::to_string(reach) +
                                 " um, so one would feel another twice",
                             "Enlarge the box, or shorten the reach of the contact forces");
        n_[q] =
            std::max(1, static_cast<int>(std::min(box.length[q] / reach, std::ceil(box.length[q] * most))));
    }
    bins_ =
        static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]);
    chunk_ = exchange::on_gpu ? 1 : std::max<std::size_t>(1, 16384 / vertices);
    chunk_ = std::max(chunk_, (cells + 15) / 16);
    chunks_ = (cells + chunk_ - 1) / chunk_;
    cursor_ = exchange::Buffer<int>(bins_ * chunks_ + 1);
    chunk_start_ = exchange::Buffer<int>(bins_ * chunks_ + 1);
    start_ = exchange::Buffer<int>(bins_ + 1);
}

NodeBinsView NodeBins::view() const {
    NodeBinsView v{};
    v.box = box_;
    for (int q = 0; q < 3; ++q) v.n[q] = n_[q];
    v.start = start_.data();
    v.node = node_.data();
    v.cell = cell_.data();
    v.x = x_.data(), v.y = y_.data(), v.z = z_.data();
    return v;
}

void NodeBins::update(const double* x, const double* y, const double* z) {
    const SortNodes sort{view(),       cells_,    vertices_, stride_,  chunk_,         chunks_,
                         bins_,        x,         y,         z,        cursor_.data(), node_.data(),
                         cell_.data(), x_.data(), y_.data(), z_.data()};
    exchange::for_each_index(chunks_, CountNodes{sort});
    exchange::exclusive_scan(cursor_.size(), cursor_.data(), chunk_start_.data());
    exchange::for_each_index(bins_ + 1, BinStart{chunk_start_.data(), chunks_, start_.data()},
                             exchange::Cost::cheap);
    exchange::copy_on_device(cursor_.data(), chunk_start_.data(), cursor_.size() * sizeof(int));
    exchange::for_each_index(chunks_, PlaceNodes{sort});
}

}  // namespace hemoflux::coupling
