#include "fluid/factored.hpp"

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/factored_lines.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::load;
using exchange::Pack;

/// A pack of lines that run along y or z: lanes are neighbours in x.
struct StridedAccess {
    HEMOFLUX_INLINE static Pack get(const double* p, std::ptrdiff_t, std::ptrdiff_t) { return load<Pack>(p); }
    HEMOFLUX_INLINE static void put(double* p, std::ptrdiff_t, const Pack& v, std::ptrdiff_t) {
        exchange::store(p, v);
    }
};

/// A pack of lines that run along x: lanes are neighbouring rows, `pitch` apart; the first `count` are real.
struct TransposedAccess {
    HEMOFLUX_INLINE static Pack get(const double* p, std::ptrdiff_t pitch, std::ptrdiff_t count) {
        return exchange::load_strided<Pack>(p, pitch, count);
    }
    HEMOFLUX_INLINE static void put(double* p, std::ptrdiff_t pitch, const Pack& v, std::ptrdiff_t count) {
        exchange::store_strided(p, pitch, v, count);
    }
};

/// Solves one pack of lines for all three components, in place. step: distance between cells of a line.
template <class Access>
HEMOFLUX_INLINE void solve_lines(double* const (&r)[3], const LineFactors (&factors)[3], std::ptrdiff_t n,
                                 std::ptrdiff_t step, std::ptrdiff_t pitch, std::ptrdiff_t count,
                                 double scale) {
    Pack x[3] = {Pack(0.0), Pack(0.0), Pack(0.0)};
    for (std::ptrdiff_t i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c) {
            const LineFactors& f = factors[c];
            x[c] = (scale * Access::get(r[c] + i * step, pitch, count) - f.lower[i] * x[c]) * f.pivot[i];
            Access::put(r[c] + i * step, pitch, x[c], count);
        }
    for (std::ptrdiff_t i = n - 2; i >= 0; --i)
        for (int c = 0; c < 3; ++c) {
            x[c] = Access::get(r[c] + i * step, pitch, count) - factors[c].upper[i] * x[c];
            Access::put(r[c] + i * step, pitch, x[c], count);
        }
    if (!factors[0].cyclic) return;
    for (int c = 0; c < 3; ++c) {
        const LineFactors& f = factors[c];
        const Pack first = Access::get(r[c], pitch, count),
                   last = Access::get(r[c] + (n - 1) * step, pitch, count);
        const Pack correction = (first + f.cyclic_last * last) * f.cyclic_scale;
        for (std::ptrdiff_t i = 0; i < n; ++i)
            Access::put(r[c] + i * step, pitch,
                        Access::get(r[c] + i * step, pitch, count) - correction * f.cyclic[i], count);
    }
}

struct Lines {
    exchange::Layout layout;
    double* r[3];
    LineFactors factors[3];
    double scale;
};

/// x lines: `row` is the plane z = k, `pack` a group of neighbouring rows.
struct LinesX : Lines {
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t j = pack * exchange::lanes<Pack>;
        const std::size_t at = layout.at(0, static_cast<std::ptrdiff_t>(j), static_cast<std::ptrdiff_t>(row));
        double* const p[3] = {r[0] + at, r[1] + at, r[2] + at};
        const std::size_t left = layout.n[1] - j, most = exchange::lanes<Pack>;
        solve_lines<TransposedAccess>(p, factors, static_cast<std::ptrdiff_t>(layout.n[0]), 1,
                                      static_cast<std::ptrdiff_t>(layout.row),
                                      static_cast<std::ptrdiff_t>(left < most ? left : most), scale);
    }
};

/// y lines (row: plane z = k) or z lines (row: plane y = j); `pack` along x.
template <int Axis>
struct LinesYZ : Lines {
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const auto i = static_cast<std::ptrdiff_t>(pack * exchange::lanes<Pack>),
                   other = static_cast<std::ptrdiff_t>(row);
        const std::size_t at = Axis == 1 ? layout.at(i, 0, other) : layout.at(i, other, 0);
        double* const p[3] = {r[0] + at, r[1] + at, r[2] + at};
        solve_lines<StridedAccess>(p, factors, static_cast<std::ptrdiff_t>(layout.n[Axis]),
                                   static_cast<std::ptrdiff_t>(Axis == 1 ? layout.row : layout.plane), 0, 0,
                                   scale);
    }
};

/// Factor by which a ghost repeats the increment of its border cell.
double repeat(const Patch& patch, std::size_t axis, std::size_t component) {
    if (patch.velocity == VelocityCondition::given) return -1;
    if (patch.velocity == VelocityCondition::symmetry && axis == component) return -1;
    return 1;
}

}  // namespace

Factored::Factored(const Grid& grid, const Boundary& boundary, double nu, double dt)
    : layout_(grid.view().layout), nu_(nu), dt_(dt) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        widths_[axis] = grid.rectilinear().axes[axis].widths();
        for (std::size_t c = 0; c < 3; ++c) {
            const auto widths = grid.ghosted_widths(static_cast<int>(axis));
            const double strength = dt * nu * (axis == c ? 2 : 1),
                         delta = grid.smallest_delta(static_cast<int>(axis)),
                         low = repeat(boundary.patches()[2 * axis], axis, c),
                         high = repeat(boundary.patches()[2 * axis + 1], axis, c);
            const bool periodic = grid.periodic()[axis];
            operators_[axis][c] =
                line_operator(widths, exchange::ghosts, strength, delta, periodic, low, high);
            const HostLine line = factor_line(widths, exchange::ghosts, strength, delta, periodic, low, high);
            const auto keep = [&](const std::vector<double>& values) {
                buffers_.emplace_back(values);
                return buffers_.back().data();
            };
            LineFactors& f = factors_[axis][c];
            f = {keep(line.lower), keep(line.pivot), keep(line.upper),
                 nullptr,          line.cyclic_last, line.cyclic_scale};
            if (!line.cyclic.empty()) f.cyclic = keep(line.cyclic);
        }
    }
}

void Factored::solve(const ResidualView& r) const {
    const auto lines = [&](std::size_t axis, double scale) {
        return Lines{layout_,
                     {r.r[1], r.r[2], r.r[3]},
                     {factors_[axis][0], factors_[axis][1], factors_[axis][2]},
                     scale};
    };
    const auto packs = [](std::size_t n) {
        return exchange::round_up(n, exchange::lanes<Pack>) / exchange::lanes<Pack>;
    };
    exchange::for_each_row(layout_.n[2], packs(layout_.n[1]), LinesX{lines(0, dt_)});
    exchange::for_each_row(layout_.n[2], packs(layout_.n[0]), LinesYZ<1>{lines(1, 1.0)});
    exchange::for_each_row(layout_.n[1], packs(layout_.n[0]), LinesYZ<2>{lines(2, 1.0)});
}

}  // namespace hemoflux::fluid
