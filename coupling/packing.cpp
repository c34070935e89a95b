#include "coupling/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "coupling/shape_distance.hpp"
#include "exchange/error.hpp"

namespace hemoflux::coupling {

Vec3d AxisTurn::operator()(const Vec3d& v) const {
    if (!(axis.z > -1 + 1e-12)) return {v.x, -v.y, -v.z};
    const Vec3d k{-axis.y, axis.x, 0}, kv = cross(k, v);
    return v + kv + (1 / (1 + axis.z)) * cross(k, kv);
}

Vec3d AxisTurn::back(const Vec3d& v) const {
    if (!(axis.z > -1 + 1e-12)) return {v.x, -v.y, -v.z};
    const Vec3d k{axis.y, -axis.x, 0}, kv = cross(k, v);
    return v + kv + (1 / (1 + axis.z)) * cross(k, kv);
}

namespace {

/// Tries for one cell before the box counts as full, and the size at which growing cells start.
constexpr int tries = 3000;
constexpr double first_size = 0.45, growth = 1.02;
/// What cells that do not get stuck grow by while patience lasts.
constexpr double least_progress = 1.003;
/// Largest move (um) and turn (parts of the axis) of a cell in one sweep.
constexpr double largest_move = 0.6, largest_turn = 0.3;
/// Vertices that are enough to find an overlap.
constexpr std::size_t probes = 700;

class Packing {
  public:
    explicit Packing(const PackingInput& in)
        : in_(in), distance_(in.shape, in.triangles, in.gap / first_size + 0.1), random_(in.seed) {
        const std::size_t stride = in.shape.size() / probes + 1;
        for (std::size_t v = 0; v < in.shape.size(); v += stride) probe_.push_back(in.shape[v]);
        for (const Vec3d& r : in.shape) radius_ = std::max(radius_, norm(r));
    }

    std::vector<Placement> run() {
        if (add_all()) return cells_;
        size_ = first_size;
        const bool started = add_all();
        double before = 0;
        for (int sweep = 0; started; ++sweep) {
            if (sweep % in_.patience == 0) {
                if (size_ < least_progress * before) break;
                before = size_;
            }
            for (std::size_t c = 0; c < cells_.size(); ++c) move(c);
            grow();
            if (size_ == 1) return cells_;
        }
        throw InputError(
            fmt::format("{} cells in a box of {:.4g} x {:.4g} x {:.4g} um", in_.cells, in_.box.length[0],
                        in_.box.length[1], in_.box.length[2]),
            fmt::format("no arrangement without overlap was found: they fit at {:.0f} % of their size",
                        100 * size_),
            "Lower packing.haematocrit or packing.gap, enlarge the box, or try another packing.seed");
    }

  private:
    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    Vec3d direction() {
        const double z = 2 * uniform() - 1, angle = 2 * std::numbers::pi * uniform();
        const double s = std::sqrt(1 - z * z);
        return {s * std::cos(angle), s * std::sin(angle), z};
    }

    bool add_all() {
        cells_.clear();
        while (cells_.size() < in_.cells)
            if (!add()) return false;
        return true;
    }

    bool add() {
        for (int n = 0; n < tries; ++n) {
            const double u[3] = {uniform(), uniform(), uniform()};
            const NodeBox& b = in_.box;
            const Placement one{{b.lower[0] + u[0] * b.length[0], b.lower[1] + u[1] * b.length[1],
                                 b.lower[2] + u[2] * b.length[2]},
                                direction()};
            if (!fits(one, cells_.size(), size_)) continue;
            cells_.push_back(one);
            return true;
        }
        return false;
    }

    void move(std::size_t c) {
        const double far = largest_move * uniform();
        Placement moved = cells_[c];
        moved.position += far * direction();
        moved.axis += largest_turn * uniform() * direction();
        moved.axis = (1 / norm(moved.axis)) * moved.axis;
        if (fits(moved, c, size_)) cells_[c] = moved;
    }

    /// To the largest of some sizes at which no cell meets another.
    void grow() {
        for (double step = growth; step > 1.001; step = 1 + (step - 1) / 2) {
            const double size = std::min(1.0, size_ * step);
            bool all = true;
            for (std::size_t c = 0; all && c < cells_.size(); ++c) all = fits(cells_[c], c, size);
            if (!all) continue;
            size_ = size;
            return;
        }
    }

    /// Whether cell number c, placed so, is clear of walls, of all other cells and of its own images.
    bool fits(const Placement& one, std::size_t c, double size) const {
        const AxisTurn turn{one.axis};
        for (const Vec3d& r : probe_)
            if (!inside(one.position + size * turn(r))) return false;
        if (meets(one, one, size, true)) return false;
        for (std::size_t k = 0; k < cells_.size(); ++k)
            if (k != c && meets(one, cells_[k], size, false)) return false;
        return true;
    }

    bool inside(const Vec3d& r) const {
        const double x[3] = {r.x, r.y, r.z};
        for (int q = 0; q < 3; ++q) {
            const double from = x[q] - in_.box.lower[q];
            if (!in_.box.periodic[q] && !(from > in_.gap && in_.box.length[q] - from > in_.gap)) return false;
        }
        return true;
    }

    /// Whether a meets any image of b within reach; `same`: b itself is a, only its images count.
    bool meets(const Placement& a, const Placement& b, double size, bool same) const {
        const double reach = 2 * size * radius_ + in_.gap;
        bool itself;
        const Vec3d nearest = in_.box.nearest(a.position, b.position, &itself);
        int most[3];
        for (int q = 0; q < 3; ++q)
            most[q] = in_.box.periodic[q] ? static_cast<int>(std::ceil(reach / in_.box.length[q] + 0.5)) : 0;
        for (int i = -most[0]; i <= most[0]; ++i)
            for (int j = -most[1]; j <= most[1]; ++j)
                for (int k = -most[2]; k <= most[2]; ++k) {
                    if (same && i == 0 && j == 0 && k == 0) continue;
                    const Vec3d d =
                        nearest + Vec3d{i * in_.box.length[0], j * in_.box.length[1], k * in_.box.length[2]};
                    if (norm(d) < reach && (probes_in(a, b, d, size) || probes_in(b, a, -d, size)))
                        return true;
                }
        return false;
    }

    /// Whether a vertex of b, whose centre lies d from that of a, is within the gap of a.
    bool probes_in(const Placement& a, const Placement& b, const Vec3d& d, double size) const {
        const AxisTurn turn_a{a.axis}, turn_b{b.axis};
        const double margin = in_.gap / size;
        return std::any_of(probe_.begin(), probe_.end(), [&](const Vec3d& r) {
            return distance_(turn_a.back((1 / size) * d + turn_b(r))) < margin;
        });
    }

    const PackingInput& in_;
    ShapeDistance distance_;
    std::mt19937_64 random_;
    std::vector<Vec3d> probe_;
    double radius_ = 0, size_ = 1;
    std::vector<Placement> cells_;
};

}  // namespace

std::vector<Placement> pack(const PackingInput& input) { return Packing(input).run(); }

}  // namespace hemoflux::coupling
