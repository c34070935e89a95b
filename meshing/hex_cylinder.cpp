#include "meshing/hex_cylinder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/error.hpp"
#include "meshing/plane_mesh.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double around_over_outward = 0.71;  // N_theta / N_r
constexpr double gathering_length = 2;        // diameters over which cells turn into the wake

void check(const CylinderShape& s) {
    const auto refuse = [](const std::string& what, const std::string& range) {
        throw InputError("mesh around a cylinder with " + what, "it must be " + range, "Change this option");
    };
    if (!(s.diameter > 0) || !std::isfinite(s.diameter))
        refuse(fmt::format("diameter {}", s.diameter), "above 0");
    if (!(s.radius >= 2 && s.radius <= 1e4))
        refuse(fmt::format("far radius {} D", s.radius), "from 2 to 10,000 D");
    if (!(s.thickness > 0) || !std::isfinite(s.thickness))
        refuse(fmt::format("thickness {} D", s.thickness), "above 0");
    if (!(s.wake >= 0 && s.wake <= 0.9)) refuse(fmt::format("wake {}", s.wake), "from 0 to 0.9");
    if (!(s.scale > 0.05 && s.scale < 20)) refuse(fmt::format("scale {}", s.scale), "between 0.05 and 20");
    if (s.cells < 200 || s.cells > 50000000)
        refuse(fmt::format("{} cells", s.cells), "from 200 to 50 million");
    if (!(s.first_height > 0 && s.first_height < 0.5))
        refuse(fmt::format("first height {} D", s.first_height), "between 0 and 0.5 D");
}

/// The root of an increasing function between two bounds.
template <class Function>
double bisect(double low, double high, const Function& f) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Radii in diameters, from the cylinder outwards.
std::vector<double> radii(const CylinderShape& s, int count, double height) {
    const double reach = s.radius - 0.5;
    if (!(count * height < reach))
        throw InputError(
            fmt::format("{} cells of {} D and more across the far field of {} D", count, height, reach),
            "equal cells already fill it, the mesh would have to shrink outwards",
            "Give fewer cells, a smaller first height or a larger far field");
    // sinh(N k) / sinh(k) rises from N to infinity
    const double k = bisect(1e-9, 20, [&](double x) {
        return count * x - x + std::log1p(-std::exp(-2 * count * x)) - std::log1p(-std::exp(-2 * x)) -
               std::log(reach / height);
    });
    if (k > std::log(1.3))
        throw InputError(
            fmt::format("cells around a cylinder that grow by {:.3g} from one to the next", std::exp(k)),
            "a solution is not accurate on cells that grow by more than 1.3",
            "Give more cells, a larger first height or a smaller far field");
    std::vector<double> r;
    for (int j = 0; j <= count; ++j) r.push_back(0.5 + height * std::sinh(k * j) / std::sinh(k));
    r.back() = s.radius;
    return r;
}

double angle(const CylinderShape& s, double r, double turn) {
    const double q = (r - 0.5) / gathering_length, a = s.wake * q * q / (1 + q * q);
    return turn - a * std::sin(turn);
}

}  // namespace

HexMesh cylinder_mesh(const CylinderShape& s) {
    check(s);
    const double outward = std::sqrt(s.cells / around_over_outward);
    const int nr = std::max(4, static_cast<int>(std::lround(outward / s.scale)));
    const int half =
        std::max(4, static_cast<int>(std::lround(around_over_outward * outward / (2 * s.scale))));
    const auto nt = static_cast<std::uint32_t>(2 * half);  // even: symmetric about the wake's axis
    const std::vector<double> r = radii(s, nr, s.first_height * s.scale);

    PlaneMesh plane;
    for (const double radius : r) {
        for (std::uint32_t i = 0; i < nt; ++i) {
            const double turn = 2 * std::numbers::pi * i / nt, theta = angle(s, radius, turn);
            plane.nodes.push_back(
                {s.diameter * radius * std::cos(theta), s.diameter * radius * std::sin(theta)});
        }
    }
    plane.sides = {{"cylinder", {}}, {"inlet", {}}, {"far", {}}, {"outlet", {}}};
    const auto last = static_cast<std::uint32_t>(nr) * nt;
    for (std::uint32_t i = 0; i < nt; ++i) {
        const std::uint32_t next = (i + 1) % nt;
        for (std::uint32_t ring = 0; ring < last; ring += nt)
            plane.quads.push_back({ring + i, ring + nt + i, ring + nt + next, ring + next});
        const double cosine = std::cos(angle(s, s.radius, 2 * std::numbers::pi * (i + 0.5) / nt));
        plane.sides[0].edges.push_back({next, i});
        plane.sides[cosine < -std::numbers::sqrt2 / 2  ? 1
                    : cosine < std::numbers::sqrt2 / 2 ? 2
                                                       : 3]
            .edges.push_back({last + i, last + next});
    }
    return extrude(plane, {0, s.thickness * s.diameter}, "z-", "z+");
}

}  // namespace hemoflux::meshing
