#include "fluid/boundary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

constexpr const char* patch_name[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

bool is_periodic(const Patch& p) { return p.velocity == VelocityCondition::periodic; }

/// Coordinates of the cell centres of one axis, ghost cells included (index shifted by ghosts).
std::vector<double> ghosted_centres(const Grid& grid, std::size_t axis) {
    const auto& widths = grid.ghosted_widths(static_cast<int>(axis));
    double face = grid.rectilinear().axes[axis].lower();
    for (std::size_t g = 0; g < exchange::ghosts; ++g) face -= widths[g];
    std::vector<double> centres;
    for (const double w : widths) centres.push_back(face + w / 2), face += w;
    return centres;
}

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

Boundary::Boundary(const Patches& patches, const Grid& grid) { update(patches, grid); }

void Boundary::update(const Patches& patches, const Grid& grid) {
    check(patches);
    patches_ = patches;
    net_mass_flux_ = gross_mass_flux_ = 0;
    constexpr std::size_t g = exchange::ghosts;
    const std::array<std::vector<double>, 3> centres{ghosted_centres(grid, 0), ghosted_centres(grid, 1),
                                                     ghosted_centres(grid, 2)};
    for (std::size_t p = 0; p < 6; ++p) {
        const Patch& patch = patches[p];
        const std::size_t axis = p / 2, side = p % 2, t1 = axis == 0 ? 1 : 0, t2 = axis == 2 ? 1 : 2;
        view_.periodic[axis] = is_periodic(patch);
        // Face values lie in rows along t1 (x where possible), ghost columns included, so that corners are
        // filled too.
        const std::size_t n1 = centres[t1].size(), n2 = centres[t2].size();
        const std::size_t pitch = n1 + 2 * exchange::row_alignment;
        std::array<std::vector<double>, 4> value;
        value.fill(std::vector<double>(pitch * n2, 0.0));
        const meshing::Axis& normal = grid.rectilinear().axes[axis];
        const auto& widths = grid.ghosted_widths(static_cast<int>(axis));
        const double default_density = patch.density == DensityCondition::given ? 1.0 : 0.0;
        const auto &w1 = grid.ghosted_widths(static_cast<int>(t1)),
                   &w2 = grid.ghosted_widths(static_cast<int>(t2));
        for (std::size_t b = 0; b < n2; ++b)
            for (std::size_t a = 0; a < n1; ++a) {
                double x[3];
                x[axis] = side == 0 ? normal.lower() : normal.upper();
                x[t1] = centres[t1][a];
                x[t2] = centres[t2][b];
                const Vec3d at{x[0], x[1], x[2]};
                const std::size_t i = b * pitch + a;
                value[0][i] = patch.density_profile ? patch.density_profile(at) : default_density;
                const Vec3d u = patch.velocity_profile ? patch.velocity_profile(at) : Vec3d{0, 0, 0};
                value[1][i] = u.x, value[2][i] = u.y, value[3][i] = u.z;
                const bool inside = a >= g && a + g < n1 && b >= g && b + g < n2;
                if (inside && patch.velocity == VelocityCondition::given) {
                    const double flux = (side == 0 ? -1 : 1) * value[1 + axis][i] * w1[a] * w2[b];
                    net_mass_flux_ += flux;
                    gross_mass_flux_ += std::abs(flux);
                }
            }
        const std::size_t first = g * pitch + g;  // the face of cell (0, 0) of the patch
        const auto rule = [&](const exchange::Buffer<double>& values, double sign, double near, double far) {
            return GhostRule{sign, {near, far}, values.data() + first, pitch};
        };
        density_[p] = exchange::Buffer<double>(value[0]);
        GhostRule& density = view_.rule[p][0];
        density = GhostRule{};
        if (patch.density == DensityCondition::given) density = rule(density_[p], -1, 2, 2);
        if (patch.density == DensityCondition::given_gradient) {
            // Mirror cells lie as far inside as ghosts lie outside; the gradient counts along the inward
            // normal.
            const std::size_t n = normal.cells(), border = side == 0 ? g : g + n - 1;
            const std::size_t next = n < 2 ? border : (side == 0 ? border + 1 : border - 1);
            const double near = widths[border];
            const double far = n < 2 ? 2 * near : 2 * near + widths[next];
            density = rule(density_[p], 1, -near, -far);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            velocity_[p][c] = exchange::Buffer<double>(value[1 + c]);
            GhostRule& r = view_.rule[p][1 + c];
            r = GhostRule{};
            if (patch.velocity == VelocityCondition::given) r = rule(velocity_[p][c], -1, 2, 2);
            if (patch.velocity == VelocityCondition::symmetry && c == axis) r.sign = -1;
        }
        view_.mass_flux[p] = MassFluxView{};
        if (patch.velocity == VelocityCondition::given)
            view_.mass_flux[p] = {velocity_[p][axis].data() + first, pitch};
        if (patch.velocity == VelocityCondition::symmetry) {
            mass_[p] = exchange::Buffer<double>(pitch * n2);
            view_.mass_flux[p] = {mass_[p].data() + first, pitch};
        }
    }
}

bool Boundary::closed() const {
    for (const Patch& p : patches_)
        if (p.velocity == VelocityCondition::zero_gradient) return false;
    return true;
}

void Boundary::check_mass_balance() const {
    if (!closed() || std::abs(net_mass_flux_) <= 1e-10 * gross_mass_flux_) return;
    throw InputError(
        "the boundary",
        fmt::format("the given velocities bring {:.3g} % more fluid in than out, and no side is open",
                    -100 * net_mass_flux_ / gross_mass_flux_),
        "balance the velocities, or let one side have a zero-gradient velocity with a given density or "
        "pressure");
}

}  // namespace hemoflux::fluid
