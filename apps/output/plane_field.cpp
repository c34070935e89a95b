#include "apps/output/plane_field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hemoflux::output {
namespace {

using Point = std::array<double, 2>;

std::vector<double> spaced(double low, double high, std::size_t n) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i)
        values.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(n - 1));
    return values;
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Unit vectors of a flow between the points of a lattice.
class Direction {
  public:
    Direction(const Lattice& lattice, const std::vector<double>& u, const std::vector<double>& v)
        : lattice_(lattice), u_(u), v_(v) {}

    /// Nothing outside, at a NaN and at rest.
    [[nodiscard]] std::optional<Point> operator()(const Point& at) const {
        const auto& [x, y] = lattice_;
        const double a = (at[0] - x.front()) / (x[1] - x[0]), b = (at[1] - y.front()) / (y[1] - y[0]);
        if (!(a >= 0 && b >= 0 && a <= double(x.size() - 1) && b <= double(y.size() - 1))) return {};
        const std::size_t i = std::min(static_cast<std::size_t>(a), x.size() - 2),
                          j = std::min(static_cast<std::size_t>(b), y.size() - 2);
        const double s = a - static_cast<double>(i), t = b - static_cast<double>(j);
        const auto between = [&](const std::vector<double>& f) {
            return (1 - t) * ((1 - s) * f[lattice_.at(i, j)] + s * f[lattice_.at(i + 1, j)]) +
                   t * ((1 - s) * f[lattice_.at(i, j + 1)] + s * f[lattice_.at(i + 1, j + 1)]);
        };
        const double u = between(u_), v = between(v_), speed = std::hypot(u, v);
        if (!(speed > 0)) return {};
        return Point{u / speed, v / speed};
    }

  private:
    const Lattice& lattice_;
    const std::vector<double>&u_, &v_;
};

/// Where lines have been, by squares of a given size.
class Occupied {
  public:
    Occupied(const Lattice& lattice, double size)
        : size_(size),
          x_(lattice.x.front()),
          y_(lattice.y.front()),
          across_(static_cast<std::size_t>((lattice.x.back() - x_) / size) + 2),
          points_(across_ * (static_cast<std::size_t>((lattice.y.back() - y_) / size) + 2)) {}

    [[nodiscard]] bool near(const Point& p, double reach) const {
        const auto [i, j] = square(p);
        for (std::size_t b = j == 0 ? 0 : j - 1; b <= j + 1; ++b)
            for (std::size_t a = i == 0 ? 0 : i - 1; a <= i + 1; ++a) {
                if (a >= across_ || b * across_ + a >= points_.size()) continue;
                for (const Point& q : points_[b * across_ + a])
                    if (distance(p, q) < reach) return true;
            }
        return false;
    }
    void add(const Point& p) {
        const auto [i, j] = square(p);
        points_[j * across_ + i].push_back(p);
    }

  private:
    [[nodiscard]] std::array<std::size_t, 2> square(const Point& p) const {
        return {static_cast<std::size_t>((p[0] - x_) / size_), static_cast<std::size_t>((p[1] - y_) / size_)};
    }
    double size_, x_, y_;
    std::size_t across_;
    std::vector<Polyline> points_;
};

/// One half of a streamline from `start`, by the classical Runge-Kutta method with steps of a given length; negative
/// steps go upstream. own: empty.
Polyline trace(const Direction& direction, const Occupied& occupied, Occupied own, const Point& start,
               double step, double clear, std::size_t most, bool& closed) {
    Polyline line{start};
    const auto turn = static_cast<std::size_t>(6 * clear / std::abs(step));
    while (line.size() < most) {
        const Point at = line.back();
        const auto move = [&](const Point& along, double h) {
            return Point{at[0] + h * along[0], at[1] + h * along[1]};
        };
        const auto k1 = direction(at);
        const auto k2 = k1 ? direction(move(*k1, step / 2)) : k1;
        const auto k3 = k2 ? direction(move(*k2, step / 2)) : k2;
        const auto k4 = k3 ? direction(move(*k3, step)) : k3;
        if (!k4) break;
        const Point next{at[0] + step / 6 * ((*k1)[0] + 2 * (*k2)[0] + 2 * (*k3)[0] + (*k4)[0]),
                         at[1] + step / 6 * ((*k1)[1] + 2 * (*k2)[1] + 2 * (*k3)[1] + (*k4)[1])};
        if (!direction(next) || occupied.near(next, clear)) break;
        line.push_back(next);
        // where it comes home it has been everywhere it can go, though it may miss its start by a little
        if (line.size() <= turn) continue;
        if (distance(next, start) < clear / 2) {
            line.push_back(start);
            closed = true;
            break;
        }
        // where it comes beside what it drew a turn ago it winds up, between lattice points where div u is not zero
        if (own.near(next, clear / 2)) break;
        own.add(line[line.size() - 1 - turn]);
    }
    return line;
}

}  // namespace

Lattice make_lattice(double x0, double x1, double y0, double y1, std::size_t across) {
    const double step = std::max(x1 - x0, y1 - y0) / static_cast<double>(across - 1);
    const auto points = [&](double length) {
        return std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(length / step)) + 1);
    };
    return {spaced(x0, x1, points(x1 - x0)), spaced(y0, y1, points(y1 - y0))};
}

std::vector<Polyline> contour(const Lattice& lattice, const std::vector<double>& field, double level) {
    std::vector<Polyline> pieces;
    const auto triangle = [&](const std::array<std::array<std::size_t, 2>, 3>& corners) {
        Polyline piece;
        for (std::size_t e = 0; e < 3; ++e) {
            const auto &p = corners[e], &q = corners[(e + 1) % 3];
            const double a = field[lattice.at(p[0], p[1])] - level, b = field[lattice.at(q[0], q[1])] - level;
            if ((a < 0) == (b < 0)) continue;
            const double s = a / (a - b);
            piece.push_back({(1 - s) * lattice.x[p[0]] + s * lattice.x[q[0]],
                             (1 - s) * lattice.y[p[1]] + s * lattice.y[q[1]]});
        }
        if (piece.size() == 2) pieces.push_back(std::move(piece));
    };
    for (std::size_t j = 0; j + 1 < lattice.y.size(); ++j)
        for (std::size_t i = 0; i + 1 < lattice.x.size(); ++i) {
            const double sum = field[lattice.at(i, j)] + field[lattice.at(i + 1, j)] +
                               field[lattice.at(i, j + 1)] + field[lattice.at(i + 1, j + 1)];
            if (!std::isfinite(sum)) continue;
            triangle({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
            triangle({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    return pieces;
}

std::vector<Polyline> streamlines(const Lattice& lattice, const std::vector<double>& u,
                                  const std::vector<double>& v, double spacing) {
    const Direction direction(lattice, u, v);
    const Occupied none(lattice, spacing);
    Occupied occupied = none;
    const double width = lattice.x.back() - lattice.x.front(), height = lattice.y.back() - lattice.y.front();
    const double step =
        std::min(spacing / 4, std::min(lattice.x[1] - lattice.x[0], lattice.y[1] - lattice.y[0]));
    const auto most = static_cast<std::size_t>(8 * (width + height) / step);
    const auto columns = static_cast<std::size_t>(width / spacing),
               rows = static_cast<std::size_t>(height / spacing);
    std::vector<Polyline> lines;
    for (std::size_t j = 0; j <= rows; ++j)
        for (std::size_t i = 0; i <= columns; ++i) {
            const Point seed{
                lattice.x.front() + width * (static_cast<double>(i) + 0.5) / static_cast<double>(columns + 1),
                lattice.y.front() + height * (static_cast<double>(j) + 0.5) / static_cast<double>(rows + 1)};
            if (!direction(seed) || occupied.near(seed, spacing)) continue;
            bool closed = false;
            Polyline line = trace(direction, occupied, none, seed, step, spacing / 2, most, closed);
            if (!closed) {
                Polyline back = trace(direction, occupied, none, seed, -step, spacing / 2, most, closed);
                std::reverse(back.begin(), back.end());
                back.insert(back.end(), line.begin() + 1, line.end());
                line = std::move(back);
            }
            if (static_cast<double>(line.size()) * step < spacing) continue;
            for (const Point& p : line) occupied.add(p);
            lines.push_back(std::move(line));
        }
    return lines;
}

}  // namespace hemoflux::output
