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
    int *cursor, *bin, *image;

    /// Calls visitor(i, number of node i without padding, its cell).
    template <class Visitor>
    HEMOFLUX_INLINE void visit(std::size_t c, const Visitor& visitor) const {
        const std::size_t last = (c + 1) * chunk < cells ? (c + 1) * chunk : cells;
        for (std::size_t k = c * chunk; k < last; ++k)
            for (std::size_t v = 0; v < vertices; ++v) visitor(k * stride + v, k * vertices + v, k);
    }
    HEMOFLUX_INLINE int& entry(std::size_t number, std::size_t c) const {
        return cursor[static_cast<std::size_t>(bin[number]) * chunks + c];
    }
};

struct CountNodes : SortNodes {
    struct Count {
        const CountNodes& p;
        std::size_t c;
        HEMOFLUX_INLINE void operator()(std::size_t i, std::size_t number, std::size_t) const {
            p.bin[number] = p.bins.bin({p.x[i], p.y[i], p.z[i]}, &p.image[number]);
            ++p.entry(number, c);
        }
    };
    HEMOFLUX_FN void operator()(std::size_t c) const {
        for (std::size_t b = 0; b < count; ++b) cursor[b * chunks + c] = 0;
        visit(c, Count{*this, c});
    }
};

struct PlaceNodes : SortNodes {
    int *node, *cell, *sorted_image;
    double *sx, *sy, *sz;
    struct Place {
        const PlaceNodes& p;
        std::size_t c;
        HEMOFLUX_INLINE void operator()(std::size_t i, std::size_t number, std::size_t k) const {
            const int s = p.entry(number, c)++;
            p.node[s] = static_cast<int>(i);
            p.cell[s] = static_cast<int>(k);
            p.sorted_image[s] = p.image[number];
            p.sx[s] = p.x[i], p.sy[s] = p.y[i], p.sz[s] = p.z[i];
        }
    };
    HEMOFLUX_FN void operator()(std::size_t c) const { visit(c, Place{*this, c}); }
};

/// Where every bin begins.
struct BinStart {
    const int* chunk_start;
    std::size_t chunks;
    int* start;
    HEMOFLUX_FN void operator()(std::size_t b) const { start[b] = chunk_start[b * chunks]; }
};

/// Owners of bins that hold nothing, or nodes of several owners.
constexpr std::int64_t nobody = INT64_MIN, several = INT64_MIN + 1;

/// Whose nodes lie in a bin: cell + cells * image.
struct BinOwner {
    NodeBinsView bins;
    const int* image;
    std::int64_t cells;
    std::int64_t* owner;
    HEMOFLUX_FN void operator()(std::size_t b) const {
        std::int64_t all = nobody;
        for (int s = bins.start[b]; s < bins.start[b + 1] && all != several; ++s) {
            const std::int64_t one = bins.cell[s] + cells * image[s];
            all = all == nobody || all == one ? one : several;
        }
        owner[b] = all;
    }
};

/// Marks the nodes of a bin around which there is more than one owner.
struct MarkMeeting {
    NodeBinsView bins;
    std::int64_t cells;
    const std::int64_t* owner;
    unsigned char* meets;

    /// Neighbour `offset` of bin b along one axis, and what crossing a periodic side adds to the owner; false behind
    /// a wall.
    HEMOFLUX_INLINE bool step(int axis, int b, int offset, int* to, std::int64_t* image) const {
        const int n = bins.n[axis], c = b + offset;
        *image = c < 0 ? -1 : c >= n ? 1 : 0;
        *to = c - static_cast<int>(*image) * n;
        return *image == 0 || bins.box.periodic[axis];
    }
    /// Away from the sides: the neighbours are where the bin is.
    HEMOFLUX_INLINE bool inside(int axis, int b) const { return b > 0 && b < bins.n[axis] - 1; }
    HEMOFLUX_INLINE bool meeting_inside(const std::int64_t* at) const {
        bool meet = false;
        for (int c = -1; c <= 1; ++c)
            for (int b = -1; b <= 1; ++b) {
                const std::int64_t* row = at + (c * bins.n[1] + b) * bins.n[0];
                for (int a = -1; a <= 1; ++a) meet |= (row[a] != nobody) & (row[a] != *at);
            }
        return meet;
    }
    HEMOFLUX_INLINE bool meeting(int i, int j, int k) const {
        const std::int64_t* at = owner + (k * bins.n[1] + j) * bins.n[0] + i;
        const std::int64_t own = *at;
        if (own == several) return true;
        if (inside(0, i) && inside(1, j) && inside(2, k)) return meeting_inside(at);
        for (int c = -1; c <= 1; ++c) {
            int to_z;
            std::int64_t image_z;
            if (!step(2, k, c, &to_z, &image_z)) continue;
            for (int b = -1; b <= 1; ++b) {
                int to_y;
                std::int64_t image_y;
                if (!step(1, j, b, &to_y, &image_y)) continue;
                for (int a = -1; a <= 1; ++a) {
                    int to_x;
                    std::int64_t image_x;
                    if (!step(0, i, a, &to_x, &image_x)) continue;
                    const std::int64_t other = owner[(to_z * bins.n[1] + to_y) * bins.n[0] + to_x];
                    if (other != nobody && other != own + cells * image_number(image_x, image_y, image_z))
                        return true;
                }
            }
        }
        return false;
    }
    /// With less than three bins along a period a bin is its own neighbour through it: nothing is left out.
    HEMOFLUX_INLINE bool narrow() const {
        for (int q = 0; q < 3; ++q)
            if (bins.box.periodic[q] && bins.n[q] < 3) return true;
        return false;
    }
    HEMOFLUX_FN void operator()(std::size_t number) const {
        const int b = static_cast<int>(number), row = b / bins.n[0];
        if (bins.start[b] == bins.start[b + 1]) return;
        const bool meet = narrow() || meeting(b % bins.n[0], row % bins.n[1], row / bins.n[1]);
        for (int s = bins.start[b]; s < bins.start[b + 1]; ++s) meets[s] = meet;
    }
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
      z_(cells * vertices),
      bin_(cells * vertices),
      image_(cells * vertices),
      sorted_image_(cells * vertices),
      meets_(cells * vertices) {
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
    owner_ = exchange::Buffer<std::int64_t>(bins_);
}

NodeBinsView NodeBins::view() const {
    NodeBinsView v{};
    v.box = box_;
    for (int q = 0; q < 3; ++q) v.n[q] = n_[q], v.per_length[q] = 1 / box_.length[q];
    v.start = start_.data();
    v.node = node_.data();
    v.cell = cell_.data();
    v.x = x_.data(), v.y = y_.data(), v.z = z_.data();
    v.meets = meets_.data();
    return v;
}

void NodeBins::update(const double* x, const double* y, const double* z) {
    const SortNodes sort{view(), cells_, vertices_, stride_,        chunk_,      chunks_,      bins_,
                         x,      y,      z,         cursor_.data(), bin_.data(), image_.data()};
    exchange::for_each_index(chunks_, CountNodes{sort});
    exchange::exclusive_scan(cursor_.size(), cursor_.data(), chunk_start_.data());
    exchange::for_each_index(bins_ + 1, BinStart{chunk_start_.data(), chunks_, start_.data()},
                             exchange::Cost::cheap);
    exchange::copy_on_device(cursor_.data(), chunk_start_.data(), cursor_.size() * sizeof(int));
    exchange::for_each_index(chunks_, PlaceNodes{sort, node_.data(), cell_.data(), sorted_image_.data(),
                                                 x_.data(), y_.data(), z_.data()});
    const auto cells = static_cast<std::int64_t>(cells_);
    exchange::for_each_index(bins_, BinOwner{view(), sorted_image_.data(), cells, owner_.data()});
    exchange::for_each_index(bins_, MarkMeeting{view(), cells, owner_.data(), meets_.data()});
}

}  // namespace hemoflux::coupling
