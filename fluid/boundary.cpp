#include "fluid/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

constexpr const char* patch_name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

bool is_periodic(const Patch& p) { return p.velocity == VelocityCondition::periodic; }

/// How the face values of a patch lie in memory: rows along t1 (x where possible), ghost columns included, so
/// that corners are filled too.
struct FaceRows {
    std::size_t axis, side, t1, t2, pitch, rows;
    FaceRows(const Grid& grid, std::size_t patch)
        : axis(patch / 2), side(patch % 2), t1(axis == 0 ? 1 : 0), t2(axis == 2 ? 1 : 2) {
        const auto& axes = grid.rectilinear().axes;
        pitch = axes[t1].cells() + 2 * exchange::ghosts + 2 * exchange::row_alignment;
        rows = axes[t2].cells() + 2 * exchange::ghosts;
    }
    [[nodiscard]] std::size_t size() const { return pitch * rows; }
};

}  // namespace

Patch periodic_patch() { return {VelocityCondition::periodic, DensityCondition::periodic, {}, {}}; }
Patch wall_patch() { return {}; }
Patch velocity_patch(std::function<Vec3d(const Vec3d&)> profile) {
    return {VelocityCondition::given, DensityCondition::zero_gradient, std::move(profile), {}};
}
Patch density_patch(double density) {
    return {VelocityCondition::zero_gradient, DensityCondition::given, {}, [density](const Vec3d&) {
                return density;
            }};
}
Patch open_patch() { return {VelocityCondition::zero_gradient, DensityCondition::zero_gradient, {}, {}}; }
Patch symmetry_patch() { return {VelocityCondition::symmetry, DensityCondition::zero_gradient, {}, {}}; }

void check(const Patches& patches) {
    for (std::size_t p = 0; p < 6; ++p) {
        const bool density_periodic = patches[p].density == DensityCondition::periodic;
        if (is_periodic(patches[p]) != density_periodic)
            throw InputError(fmt::format("boundary {}", patch_name[p]),
                             "only one of velocity and density is periodic", "make both periodic or neither");
        if (is_periodic(patches[p]) != is_periodic(patches[p ^ 1u]))
            throw InputError(fmt::format("boundary {}", patch_name[p]),
                             fmt::format("periodic sides come in pairs, and {} differs", patch_name[p ^ 1u]),
                             "make both sides periodic or neither");
    }
}

std::array<bool, 3> periodic_axes(const Patches& patches) {
    return {is_periodic(patches[0]), is_periodic(patches[2]), is_periodic(patches[4])};
}

Vec3d Patch::velocity_at(const Vec3d& x, double t) const {
    if (unsteady_velocity) return unsteady_velocity(x, t);
    return velocity_profile ? velocity_profile(x) : Vec3d{0, 0, 0};
}

double Patch::density_at(const Vec3d& x, double t) const {
    if (unsteady_density) return unsteady_density(x, t);
    if (density_profile) return density_profile(x);
    return density == DensityCondition::given ? 1.0 : 0.0;
}

Boundary::Boundary(const Patches& patches, const Grid& grid) { update(patches, grid); }

void Boundary::update(const Patches& patches, const Grid& grid) {
    check(patches);
    patches_ = patches;
    for (std::size_t p = 0; p < 6; ++p) {
        evaluate(p, 0, grid);
        set_rules(p, grid);
    }
}

void Boundary::set_time(double t, const Grid& grid) {
    for (std::size_t p = 0; p < 6; ++p)
        if (patches_[p].unsteady()) evaluate(p, t, grid);
}

bool Boundary::unsteady() const {
    return std::any_of(patches_.begin(), patches_.end(), [](const Patch& p) { return p.unsteady(); });
}

void Boundary::evaluate(std::size_t p, double t, const Grid& grid) {
    const Patch& patch = patches_[p];
    const FaceRows rows(grid, p);
    const std::size_t axis = rows.axis, t1 = rows.t1, t2 = rows.t2;
    const auto c1 = ghosted_centres(grid, t1), c2 = ghosted_centres(grid, t2);
    const auto &w1 = grid.ghosted_widths(static_cast<int>(t1)),
               &w2 = grid.ghosted_widths(static_cast<int>(t2));
    const meshing::Axis& normal = grid.rectilinear().axes[axis];
    std::array<std::vector<double>, 4> value;
    value.fill(std::vector<double>(rows.size(), 0.0));
    net_mass_flux_[p] = gross_mass_flux_[p] = 0;
    constexpr std::size_t g = exchange::ghosts;
    for (std::size_t b = 0; b < c2.size(); ++b)
        for (std::size_t a = 0; a < c1.size(); ++a) {
            double x[3];
            x[axis] = rows.side == 0 ? normal.lower() : normal.upper();
            x[t1] = c1[a];
            x[t2] = c2[b];
            const Vec3d at{x[0], x[1], x[2]}, u = patch.velocity_at(at, t);
            const std::size_t i = b * rows.pitch + a;
            value[0][i] = patch.density_at(at, t);
            value[1][i] = u.x, value[2][i] = u.y, value[3][i] = u.z;
            const bool inside = a >= g && a + g < c1.size() && b >= g && b + g < c2.size();
            if (inside && patch.velocity == VelocityCondition::given) {
                const double flux = (rows.side == 0 ? -1 : 1) * value[1 + axis][i] * w1[a] * w2[b];
                net_mass_flux_[p] += flux;
                gross_mass_flux_[p] += std::abs(flux);
            }
        }
    const auto keep = [](exchange::Buffer<double>& buffer, const std::vector<double>& values) {
        if (buffer.size() == values.size())  // rules and kernels hold its address
            buffer.assign(values);
        else
            buffer = exchange::Buffer<double>(values);
    };
    keep(density_[p], value[0]);
    for (std::size_t c = 0; c < 3; ++c) keep(velocity_[p][c], value[1 + c]);
}

void Boundary::set_rules(std::size_t p, const Grid& grid) {
    const Patch& patch = patches_[p];
    const FaceRows rows(grid, p);
    view_.periodic[rows.axis] = is_periodic(patch);
    const std::size_t first = exchange::ghosts * rows.pitch + exchange::ghosts;  // the face of cell (0, 0)
    const auto rule = [&](const exchange::Buffer<double>& values, double sign, double near, double far) {
        return GhostRule{sign, {near, far}, values.data() + first, rows.pitch};
    };
    GhostRule& density = view_.rule[p][0];
    density = GhostRule{};
    if (patch.density == DensityCondition::given) density = rule(density_[p], -1, 2, 2);
    if (patch.density == DensityCondition::given_gradient) {
        // Mirror cells lie as far inside as ghosts lie outside; the gradient counts along the inward normal.
        const auto& widths = grid.ghosted_widths(static_cast<int>(rows.axis));
        const std::size_t n = grid.rectilinear().axes[rows.axis].cells();
        const std::size_t border = rows.side == 0 ? exchange::ghosts : exchange::ghosts + n - 1;
        const std::size_t next = n < 2 ? border : (rows.side == 0 ? border + 1 : border - 1);
        const double near = widths[border];
        const double far = n < 2 ? 2 * near : 2 * near + widths[next];
        density = rule(density_[p], 1, -near, -far);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        GhostRule& r = view_.rule[p][1 + c];
        r = GhostRule{};
        if (patch.velocity == VelocityCondition::given) r = rule(velocity_[p][c], -1, 2, 2);
        if (patch.velocity == VelocityCondition::symmetry && c == rows.axis) r.sign = -1;
    }
    view_.mass_flux[p] = MassFluxView{};
    if (patch.velocity == VelocityCondition::given)
        view_.mass_flux[p] = {velocity_[p][rows.axis].data() + first, rows.pitch};
    if (patch.velocity == VelocityCondition::symmetry) {
        mass_[p] = exchange::Buffer<double>(rows.size());
        view_.mass_flux[p] = {mass_[p].data() + first, rows.pitch};
    }
}

double Boundary::net_mass_flux() const {
    return std::accumulate(net_mass_flux_.begin(), net_mass_flux_.end(), 0.0);
}

bool Boundary::closed() const {
    for (const Patch& p : patches_)
        if (p.velocity == VelocityCondition::zero_gradient) return false;
    return true;
}

void Boundary::check_mass_balance() const {
    const double net = net_mass_flux();
    const double gross = std::accumulate(gross_mass_flux_.begin(), gross_mass_flux_.end(), 0.0);
    if (closed() && std::abs(net) > 1e-10 * gross) refuse_imbalance(net, gross);
}

void refuse_imbalance(double net, double gross) {
    throw InputError(
        "the boundary",
        fmt::format("the given velocities bring {:.3g} % more fluid in than out, and no side is open",
                    -100 * net / gross),
        "balance the velocities, or let one side have a zero-gradient velocity with a given density or "
        "pressure");
}

}  // namespace hemoflux::fluid
