#include "meshing/hex_pipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/error.hpp"
#include "meshing/plane_mesh.hpp"

namespace hemoflux::meshing {
namespace {

using Point = std::array<double, 2>;

constexpr double core = 0.45;   // half the side of the square over R
constexpr double bulge = 0.12;  // how far the middle of a side stands out, over R

void check(const PipeShape& s) {
    const auto refuse = [](const std::string& what, const std::string& range) {
        throw InputError("pipe with " + what, "it must be " + range, "Change this option");
    };
    if (!(s.diameter > 0) || !std::isfinite(s.diameter))
        refuse(fmt::format("diameter {}", s.diameter), "above 0");
    if (!(s.length > 0 && s.length <= 1e4))
        refuse(fmt::format("length {} D", s.length), "above 0, up to 10,000 D");
    if (s.cells < 200 || s.cells > 50000000)
        refuse(fmt::format("{} cells", s.cells), "from 200 to 50 million");
    if (!(s.wall >= 0.1 && s.wall <= 1)) refuse(fmt::format("wall {}", s.wall), "from 0.1 to 1");
    if (!(s.constriction >= 0 && s.constriction <= 0.8))
        refuse(fmt::format("constriction {}", s.constriction), "from 0 to 0.8");
    if (s.constriction == 0) return;
    if (!(s.throat_length > 0)) refuse(fmt::format("throat length {} D", s.throat_length), "above 0");
    if (!(s.throat - s.throat_length / 2 >= 0 && s.throat + s.throat_length / 2 <= s.length))
        refuse(fmt::format("a throat from {} to {} D", s.throat - s.throat_length / 2,
                           s.throat + s.throat_length / 2),
               fmt::format("within the pipe, 0 to {} D", s.length));
}

/// The point of the bulging square with the coordinates u, v in -1 .. 1.
Point core_point(double u, double v) {
    const double side = core * (1 + bulge / core * (1 - v * v) * u * u),
                 top = core * (1 + bulge / core * (1 - u * u) * v * v);
    return {u * side, v * top};
}

/// Cross-section of radius 1 with n cells along a side of the square and m between it and the wall.
class Section {
  public:
    Section(std::uint32_t n, std::uint32_t m, double wall) : n_(n), m_(m) {
        // widths from the square to the wall fall in equal steps from that of the square to `wall` times it
        double sum = 0;
        fractions_.push_back(0);
        for (std::uint32_t j = 0; j < m; ++j) {
            const double at = m == 1 ? 0 : static_cast<double>(j) / (m - 1);
            sum += 1 + (wall - 1) * at;
            fractions_.push_back(sum);
        }
        for (double& f : fractions_) f /= sum;
        add_core();
        add_rings();
    }

    PlaneMesh take() { return std::move(plane_); }

  private:
    void add_core() {
        for (std::uint32_t j = 0; j <= n_; ++j)
            for (std::uint32_t i = 0; i <= n_; ++i)
                plane_.nodes.push_back(core_point(2.0 * i / n_ - 1, 2.0 * j / n_ - 1));
        const std::uint32_t row = n_ + 1;
        for (std::uint32_t j = 0; j < n_; ++j)
            for (std::uint32_t i = 0; i < n_; ++i) {
                const std::uint32_t a = j * row + i;
                plane_.quads.push_back({a, a + 1, a + 1 + row, a + row});
            }
    }

    /// Node k = 0 .. 4n - 1 of the square's border, counter-clockwise from its corner (-1, -1).
    [[nodiscard]] std::uint32_t border(std::uint32_t k) const {
        const std::uint32_t row = n_ + 1, i = k % n_;
        switch (k / n_) {
            case 0:
                return i;
            case 1:
                return i * row + n_;
            case 2:
                return n_ * row + n_ - i;
            default:
                return (n_ - i) * row;
        }
    }

    void add_rings() {
        const std::uint32_t around = 4 * n_;
        std::vector<std::uint32_t> inner(around);
        for (std::uint32_t k = 0; k < around; ++k) inner[k] = border(k);
        const std::vector<std::uint32_t> square = inner;
        plane_.sides.push_back({"wall", {}});
        for (std::uint32_t j = 1; j <= m_; ++j) {
            std::vector<std::uint32_t> outer(around);
            for (std::uint32_t k = 0; k < around; ++k) {
                outer[k] = static_cast<std::uint32_t>(plane_.nodes.size());
                const double angle = (-0.75 + 0.5 * k / n_) * std::numbers::pi, f = fractions_[j];
                const Point& from = plane_.nodes[square[k]];
                plane_.nodes.push_back(
                    {from[0] + f * (std::cos(angle) - from[0]), from[1] + f * (std::sin(angle) - from[1])});
            }
            for (std::uint32_t k = 0; k < around; ++k) {
                const std::uint32_t next = (k + 1) % around;
                plane_.quads.push_back({inner[k], outer[k], outer[next], inner[next]});
                if (j == m_) plane_.sides[0].edges.push_back({outer[k], outer[next]});
            }
            inner = std::move(outer);
        }
    }

    std::uint32_t n_, m_;
    std::vector<double> fractions_;
    PlaneMesh plane_;
};

double radius(const PipeShape& s, double x) {
    const double from_throat = (x - s.throat) / s.throat_length;
    if (s.constriction == 0 || std::abs(from_throat) >= 0.5) return 0.5;
    return 0.5 * (1 - 0.5 * s.constriction * (1 + std::cos(2 * std::numbers::pi * from_throat)));
}

}  // namespace

HexMesh pipe_mesh(const PipeShape& s) {
    check(s);
    // n cells of the width h = 2 core R / n; m so that the blocks begin with that width; layers as wide as 2 h
    const double gap = 1 - core - 0.5 * (bulge + core * (std::numbers::sqrt2 - 1));
    const auto divisions = [&](double n) {
        const double h = 2 * core / n;
        return std::array<double, 2>{gap / (0.5 * (1 + s.wall) * h), 2 * s.length / (2 * h)};
    };
    const auto count = [&](double n) {
        const auto [m, layers] = divisions(n);
        return (n * n + 4 * n * m) * layers;
    };
    const double n_exact = std::cbrt(s.cells / count(1.0));  // all three grow with n
    const auto n = static_cast<std::uint32_t>(std::max(2L, std::lround(n_exact)));
    const auto m = static_cast<std::uint32_t>(std::max(1L, std::lround(divisions(n_exact)[0])));
    const auto layers = std::max(1L, std::lround(static_cast<double>(s.cells) / (n * n + 4 * n * m)));
    std::vector<double> levels;
    for (long k = 0; k <= layers; ++k)
        levels.push_back(s.length * static_cast<double>(k) / static_cast<double>(layers));
    HexMesh mesh = z_to_x(extrude(Section(n, m, s.wall).take(), levels, "inlet", "outlet"));
    for (Vec3d& p : mesh.nodes) {
        const double r = s.diameter * radius(s, p.x);
        p = {s.diameter * p.x, r * p.y, r * p.z};
    }
    return mesh;
}

}  // namespace hemoflux::meshing
