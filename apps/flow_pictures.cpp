// Pictures of a measured flow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/body_observer.hpp"
#include "apps/flow_observer.hpp"
#include "apps/output/plane_plot.hpp"
#include "fluid/grid_interpolant.hpp"
#include "fluid/hex_probe.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/solver.hpp"
#include "fluid/streamfunction.hpp"
#include "fluid/vorticity.hpp"
#include "fluid/wall.hpp"

namespace hemoflux::apps {
namespace {

using output::Lattice;
using output::LineSet;
using output::PlanePlot;

constexpr std::size_t resolution = 257;  // points along the longer side of a picture

/// Velocity in a plane: along the lattice's x and y, and its magnitude, in reference units; NaN inside a body.
struct Plane {
    Lattice lattice;
    std::vector<double> u, v, speed;
};

/// Even-odd rule.
bool inside(const output::Polyline& outline, double x, double y) {
    bool odd = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        const auto &a = outline[i], &b = outline[j];
        if ((a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]) odd = !odd;
    }
    return odd;
}

/// place: where a point of the lattice lies; components: of the velocity that the plane shows.
template <class Place>
Plane sample(const fluid::Probe& probe, Lattice lattice, const Place& place,
             std::array<std::size_t, 2> components, double unit, const output::Polyline& body = {}) {
    Plane plane{std::move(lattice), {}, {}, {}};
    for (const double y : plane.lattice.y)
        for (const double x : plane.lattice.x) {
            // a little inside the outline too, so that colours and lines reach it
            constexpr double rim = 0.97;
            const bool solid = !body.empty() && inside(body, x / rim, y / rim);
            const auto q = solid ? std::array<double, 4>{NAN, NAN, NAN, NAN} : probe(place(x, y));
            plane.u.push_back(unit * q[1 + components[0]]);
            plane.v.push_back(unit * q[1 + components[1]]);
            plane.speed.push_back(unit * std::hypot(q[1], q[2], q[3]));
        }
    return plane;
}

/// dv/dx - du/dy (3.13) by central differences, one-sided at the rim.
std::vector<double> vorticity(const Plane& plane) {
    const auto& [x, y] = plane.lattice;
    const auto slope = [](const std::vector<double>& f, std::size_t low, std::size_t high, double distance) {
        return (f[high] - f[low]) / distance;
    };
    std::vector<double> zeta;
    for (std::size_t j = 0; j < y.size(); ++j)
        for (std::size_t i = 0; i < x.size(); ++i) {
            const std::size_t i0 = i == 0 ? 0 : i - 1, i1 = std::min(i + 1, x.size() - 1),
                              j0 = j == 0 ? 0 : j - 1, j1 = std::min(j + 1, y.size() - 1);
            const Lattice& l = plane.lattice;
            zeta.push_back(slope(plane.v, l.at(i0, j), l.at(i1, j), x[i1] - x[i0]) -
                           slope(plane.u, l.at(i, j0), l.at(i, j1), y[j1] - y[j0]));
        }
    return zeta;
}

/// The solver's own, between the cells of an unstructured grid.
template <class Place>
std::vector<double> vorticity(const fluid::HexSolver& solver, const Plane& plane, const Place& place,
                              double unit) {
    std::vector<double> cells;
    for (const auto& gradient : solver.gradients()) cells.push_back(unit * fluid::vorticity(gradient).z);
    const fluid::HexInterpolant at(solver.grid(), 1, std::move(cells), {});
    std::vector<double> zeta(plane.lattice.size(), NAN);
    for (std::size_t j = 0; j < plane.lattice.y.size(); ++j)
        for (std::size_t i = 0; i < plane.lattice.x.size(); ++i)
            if (const std::size_t p = plane.lattice.at(i, j); std::isfinite(plane.speed[p]))
                at(place(plane.lattice.x[i], plane.lattice.y[j]), &zeta[p]);
    return zeta;
}

/// Blue for negative levels, red for positive ones, paler the weaker they are among their kind; black for zero.
std::string colour_of(double level, const std::vector<double>& levels) {
    if (level == 0) return "#000000";
    const auto same_sign = [&](double other) { return other * level > 0; };
    const auto weaker = [&](double other) { return same_sign(other) && std::abs(other) < std::abs(level); };
    const auto all = std::count_if(levels.begin(), levels.end(), same_sign);
    const auto below = std::count_if(levels.begin(), levels.end(), weaker);
    const auto pale = all < 2 ? 0 : static_cast<int>(170 * (all - 1 - below) / (all - 1));
    return level > 0 ? fmt::format("#c8{:02x}{:02x}", pale, pale / 2)
                     : fmt::format("#{:02x}{:02x}c8", pale / 2, pale);
}

/// Contour lines by descending level, with a key.
std::vector<LineSet> contours(const Lattice& lattice, const std::vector<double>& field,
                              std::vector<double> levels) {
    std::sort(levels.begin(), levels.end(), std::greater<>());
    std::vector<LineSet> sets;
    for (const double level : levels)
        sets.push_back({fmt::format("{:g}", level), colour_of(level, levels), 1.6,
                        output::contour(lattice, field, level)});
    std::erase_if(sets, [](const LineSet& s) { return s.lines.empty(); });
    return sets;
}

LineSet flow_lines(const Plane& plane, double spacing) {
    return {"", "#ffffff", 1.1, output::streamlines(plane.lattice, plane.u, plane.v, spacing)};
}

/// Levels of Table 3.7, and their negatives.
const std::vector<double> vorticity_levels{0, 0.5, 1, 2, 3, 4, 5, -0.5, -1, -2, -3, -4, -5};
/// Levels of Ghia, Ghia and Shin's figures.
const std::vector<double> streamfunction_levels{-0.1175, -0.115, -0.11, -0.1, -0.09,  -0.07, -0.05, -0.03,
                                                -0.01,   -1e-4,  -1e-5, 1e-8, 1e-7,   1e-6,  1e-5,  5e-5,
                                                1e-4,    2.5e-4, 5e-4,  1e-3, 1.5e-3, 3e-3};

bool is_plane(const fluid::Flow& flow) {
    for (std::size_t c = 1; c < flow.cells(); ++c)
        if (std::abs(flow.centre(c).z - flow.centre(0).z) > 1e-9 * std::abs(flow.centre(0).z) + 1e-12)
            return false;
    return true;
}

}  // namespace

std::string FlowObserver::draw(const output::OutputFolder& folder) const {
    const auto probe = fluid::make_probe(flow_);
    const double unit = scales_.velocity_um_per_s / speed_;
    const Vec3d middle = 0.5 * (box_.lower + box_.upper);
    const auto extent = [&](std::size_t a) {
        const double e[3] = {box_.upper.x - box_.lower.x, box_.upper.y - box_.lower.y,
                             box_.upper.z - box_.lower.z};
        return e[a] / length_;
    };
    std::string message;
    const auto make = [&](const std::string& name, const PlanePlot& plot) {
        if (const auto failed = output::plot_plane(plot, folder.path() / ("picture_" + name + ".png")))
            message = *failed;
    };
    const auto& body = case_.observables->body;
    if (!body && !is_plane(flow_)) {
        struct View {
            const char* name;
            std::size_t across, up;
        };
        for (const View& view : {View{"x", 2, 1}, View{"y", 0, 2}, View{"z", 0, 1}}) {
            const auto place = [&](double a, double b) {
                double at[3] = {middle.x, middle.y, middle.z};
                const double low[3] = {box_.lower.x, box_.lower.y, box_.lower.z};
                at[view.across] = low[view.across] + a * length_;
                at[view.up] = low[view.up] + b * length_;
                return Vec3d{at[0], at[1], at[2]};
            };
            const Plane plane =
                sample(*probe, output::make_lattice(0, extent(view.across), 0, extent(view.up), 161), place,
                       {view.across, view.up}, unit);
            std::vector<double> in_plane;
            for (std::size_t i = 0; i < plane.u.size(); ++i)
                in_plane.push_back(std::hypot(plane.u[i], plane.v[i]));
            make(std::string("streamlines_") + view.name,
                 {fmt::format("{}: streamlines in the middle plane normal to {}", case_.title, view.name),
                  fmt::format("{} / L", "xyz"[view.across]),
                  fmt::format("{} / L", "xyz"[view.up]),
                  "velocity in the plane / U",
                  plane.lattice,
                  in_plane,
                  {flow_lines(plane, 0.03)}});
        }
        return message;
    }

    output::Polyline outline;
    Vec3d origin = box_.lower;
    Lattice lattice = output::make_lattice(0, extent(0), 0, extent(1), resolution);
    if (body) {
        const auto faces = flow_.wall_faces(body->patch);
        origin = centre_of(*body, faces);
        for (const auto& p : fluid::wall_points(faces, {origin, {1, 0, 0}, {0, 1, 0}}))
            outline.push_back({(p.centre.x - origin.x) / length_, (p.centre.y - origin.y) / length_});
        const auto clip = [&](double at, double low, double high, double o) {
            return std::clamp(at, (low - o) / length_, (high - o) / length_);
        };
        lattice = output::make_lattice(clip(-1.5, box_.lower.x, box_.upper.x, origin.x),
                                       clip(4.5, box_.lower.x, box_.upper.x, origin.x),
                                       clip(-2, box_.lower.y, box_.upper.y, origin.y),
                                       clip(2, box_.lower.y, box_.upper.y, origin.y), resolution);
    }
    const auto place = [&](double x, double y) {
        return Vec3d{origin.x + x * length_, origin.y + y * length_, middle.z};
    };
    const Plane plane = sample(*probe, lattice, place, {0, 1}, unit, outline);
    const double spacing = (lattice.y.back() - lattice.y.front()) / 35;
    make("velocity", {case_.title + ": velocity and streamlines",
                      "x / L",
                      "y / L",
                      "velocity / U",
                      plane.lattice,
                      plane.speed,
                      {flow_lines(plane, spacing)},
                      outline});
    const auto* hex = dynamic_cast<const fluid::HexSolver*>(&flow_);
    const auto zeta = hex ? vorticity(*hex, plane, place, unit * length_) : vorticity(plane);
    std::vector<double> levels = vorticity_levels;
    if (body) std::erase(levels, 0.0);  // the stream around a body has none: its zero is noise
    make("vorticity", {case_.title + ": vorticity L / U",
                       "x / L",
                       "y / L",
                       "",
                       plane.lattice,
                       {},
                       contours(plane.lattice, zeta, levels),
                       outline});
    const auto* solver = dynamic_cast<const fluid::Solver*>(&flow_);
    if (!case_.observables->cavity || !solver) return message;
    const auto psi = fluid::streamfunction(*solver);
    std::array<fluid::Border, 6> walls{};
    std::fill_n(walls.begin(), 4, fluid::Border::face);
    const fluid::GridInterpolant at(solver->grid(), fluid::padded_field(solver->grid(), psi.values, -1),
                                    walls);
    std::vector<double> field;
    for (const double y : lattice.y)
        for (const double x : lattice.x) field.push_back(unit / length_ * at(place(x, y)));
    make("streamfunction", {case_.title + ": streamfunction / (U L)",
                            "x / L",
                            "y / L",
                            "",
                            lattice,
                            {},
                            contours(lattice, field, streamfunction_levels)});
    return message;
}

}  // namespace hemoflux::apps
