#include "coupling/overlap.hpp"

#include "coupling/surface_gap.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// The least of several gaps, the first of equal ones.
struct LeastGap {
    Gap gap;
    HEMOFLUX_FN LeastGap& operator+=(const LeastGap& b) {
        if (b.gap.distance < gap.distance) gap = b.gap;
        return *this;
    }
};

/// Other cells that a node can meet at once.
constexpr int most_others = 8;

/// The gap of sorted node s.
struct NodeGap {
    NodeBinsView bins;
    double reach2;
    std::size_t stride;
    const double *x, *y, *z;
    const int *ring_begin, *ring;

    /// The nearest node of every other cell (or image of the own one) around.
    struct Nearest {
        const NodeBinsView& bins;
        double reach2;
        int own;
        Vec3d at;
        int cell[most_others], sorted[most_others], count = 0;
        double d2[most_others];
        HEMOFLUX_INLINE void operator()(int s) {
            bool itself;
            const Vec3d d = bins.box.nearest(at, bins.position(s), &itself);
            if (itself && bins.cell[s] == own) return;
            const double distance2 = dot(d, d);
            if (!(distance2 < reach2)) return;
            int slot = 0;
            while (slot < count && cell[slot] != bins.cell[s]) ++slot;
            if (slot == count) {
                if (count == most_others) return;
                cell[count] = bins.cell[s];
                d2[count++] = 1e300;
            }
            if (distance2 < d2[slot]) d2[slot] = distance2, sorted[slot] = s;
        }
    };

    HEMOFLUX_FN LeastGap operator()(std::size_t s) const {
        const int i = static_cast<int>(s);
        if (!bins.meets[i]) return {};
        Nearest nearest{bins, reach2, bins.cell[i], bins.position(i), {}, {}, 0, {}};
        bins.around(nearest.at, nearest);
        LeastGap least;
        for (int k = 0; k < nearest.count; ++k) {
            const double d = distance(nearest.at, nearest.sorted[k]);
            if (d < least.gap.distance)
                least.gap = {d, bins.cell[i], static_cast<int>(node(i)), nearest.cell[k]};
        }
        return least;
    }

  private:
    /// Vertex number in its cell.
    HEMOFLUX_INLINE std::size_t node(int s) const {
        return static_cast<std::size_t>(bins.node[s]) - static_cast<std::size_t>(bins.cell[s]) * stride;
    }
    /// From `at` to the triangles around sorted node n, moved to its nearest image.
    HEMOFLUX_INLINE double distance(const Vec3d& at, int n) const {
        bool itself;
        const Vec3d base = bins.position(n), shifted = at + bins.box.nearest(at, base, &itself);
        const std::size_t v = node(n), first = static_cast<std::size_t>(bins.cell[n]) * stride;
        RingDistance ring_distance(at);
        for (int t = ring_begin[v]; t < ring_begin[v + 1]; ++t) {
            Vec3d corner[3];
            for (int c = 0; c < 3; ++c) {
                const std::size_t k = first + static_cast<std::size_t>(ring[3 * t + c]);
                corner[c] = Vec3d{x[k], y[k], z[k]} - base + shifted;
            }
            ring_distance.add(corner[0], corner[1], corner[2]);
        }
        return ring_distance.value();
    }
};

}  // namespace

struct OverlapCheck::Scratch {
    exchange::Reduction<LeastGap> reduction;
};

OverlapCheck::OverlapCheck(const NodeBox& box, double reach, const std::vector<std::array<int, 3>>& triangles,
                           std::size_t cells, std::size_t vertices, std::size_t stride)
    : bins_(box, reach, cells, vertices, stride), stride_(stride), scratch_(new Scratch) {
    std::vector<std::vector<int>> around(vertices);
    for (const auto& t : triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            auto& corners = around[static_cast<std::size_t>(t[c])];
            corners.insert(corners.end(), {t[c], t[(c + 1) % 3], t[(c + 2) % 3]});
        }
    std::vector<int> begin{0}, ring;
    for (const auto& corners : around) {
        ring.insert(ring.end(), corners.begin(), corners.end());
        begin.push_back(static_cast<int>(ring.size() / 3));
    }
    ring_begin_ = exchange::Buffer<int>(begin);
    ring_ = exchange::Buffer<int>(ring);
}

OverlapCheck::~OverlapCheck() = default;

Gap OverlapCheck::smallest(const double* x, const double* y, const double* z) {
    bins_.update(x, y, z);
    return scratch_->reduction
        .sum(bins_.nodes(), NodeGap{bins_.view(), bins_.reach() * bins_.reach(), stride_, x, y, z,
                                    ring_begin_.data(), ring_.data()})
        .gap;
}

}  // namespace hemoflux::coupling
