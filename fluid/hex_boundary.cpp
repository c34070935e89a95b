#include "fluid/hex_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"
#include "meshing/face_frame.hpp"

namespace hemoflux::fluid {
namespace {

std::string names(const std::vector<meshing::HexGrid::Patch>& patches) {
    std::string all;
    for (const auto& p : patches) all += (all.empty() ? "" : ", ") + p.name;
    return all;
}

void check(const std::vector<meshing::HexGrid::Patch>& ranges, const HexPatches& patches) {
    for (const auto& range : ranges)
        if (!patches.count(range.name))
            throw InputError(fmt::format("boundary {}", range.name),
                             "the mesh has this patch, the case has no condition for it",
                             "give it a velocity and a density condition");
    for (const auto& [name, patch] : patches) {
        const auto known = [&n = name](const meshing::HexGrid::Patch& range) { return range.name == n; };
        if (std::none_of(ranges.begin(), ranges.end(), known))
            throw InputError(fmt::format("boundary {}", name), "the mesh has no such patch",
                             fmt::format("use one of: {}", names(ranges)));
        if (patch.velocity == VelocityCondition::periodic || patch.density == DensityCondition::periodic)
            throw InputError(fmt::format("boundary {}", name), "this patch is not glued to a partner",
                             "name its periodic partner, or give another condition");
    }
}

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

std::vector<char> idle_faces(const meshing::HexGrid& grid, const HexPatches& patches) {
    std::vector<char> idle(grid.faces(), 0);
    for (std::size_t f = 0; f < grid.interior_faces(); ++f) idle[f] = grid.left[f] == grid.right[f];
    std::map<std::uint32_t, std::vector<std::size_t>> mirrors;  // planes of symmetry of each cell
    for (const auto& range : grid.patches) {
        const auto patch = patches.find(range.name);
        if (patch == patches.end() || patch->second.velocity != VelocityCondition::symmetry) continue;
        for (std::size_t f = range.first; f < range.first + range.count; ++f)
            mirrors[grid.left[f]].push_back(f);
    }
    for (const auto& [cell, faces] : mirrors)
        for (const std::size_t a : faces)
            for (const std::size_t b : faces)
                if (dot(grid.area[a], grid.area[b]) < -0.999 * norm(grid.area[a]) * norm(grid.area[b]))
                    idle[a] = 1;
    return idle;
}

HexBoundary::HexBoundary(const meshing::HexGrid& grid, HexPatches patches)
    : patches_(std::move(patches)), ranges_(grid.patches), first_(grid.interior_faces()) {
    check(ranges_, patches_);
    const std::size_t count = grid.border_faces();
    host_.resize(count);
    for (std::size_t b = 0; b < count; ++b) {
        const std::size_t f = first_ + b;
        area_.push_back(grid.area[f]);
        centre_.push_back(grid.face_centre[f]);
        reach_.push_back(grid.face_centre[f] - grid.centre[grid.left[f]]);
    }
    for (const auto& range : ranges_) evaluate(range, patches_.at(range.name), 0);
    device_ = exchange::Buffer<HexBorderFace>(host_);
}

void HexBoundary::evaluate(const meshing::HexGrid::Patch& range, const Patch& patch, double t) {
    for (std::size_t b = range.first - first_; b < range.first - first_ + range.count; ++b) {
        const double surface = norm(area_[b]);
        const Vec3d n = (1 / surface) * area_[b];
        const meshing::FaceFrame frame = meshing::face_frame(n);
        HexBorderFace& face = host_[b];
        face = {};
        face.normal[0] = n.x, face.normal[1] = n.y, face.normal[2] = n.z;
        face.step = 2 * dot(reach_[b], n);
        face.velocity = patch.velocity;
        face.density = patch.density;
        const Vec3d u = patch.velocity_at(centre_[b], t);
        const double density = patch.density_at(centre_[b], t);
        face.mass_flux = patch.velocity == VelocityCondition::given ? dot(u, area_[b]) : 0.0;
        const double values[4] = {density, u.x, u.y, u.z};
        for (int c = 0; c < 4; ++c) face.value[c] = values[c];
        // Slopes by central differences over half the face's size, which stay near the face.
        const double reach = std::sqrt(surface) / 2;
        for (const Vec3d& tangent : {frame.tangent1, frame.tangent2}) {
            const Vec3d ahead = centre_[b] + reach * tangent, behind = centre_[b] - reach * tangent;
            Vec3d du = patch.velocity_at(ahead, t) - patch.velocity_at(behind, t);
            double d_density = patch.density_at(ahead, t) - patch.density_at(behind, t);
            if (!finite(du)) du = {0, 0, 0};
            if (!std::isfinite(d_density)) d_density = 0;
            const double difference[4] = {d_density, du.x, du.y, du.z};
            const double to_foot = dot(reach_[b], tangent);
            for (int c = 0; c < 4; ++c) {
                const double slope = difference[c] / (2 * reach);
                face.value[c] -= slope * to_foot;
                face.slope[0][c] += slope * tangent.x;
                face.slope[1][c] += slope * tangent.y;
                face.slope[2][c] += slope * tangent.z;
            }
        }
    }
}

bool HexBoundary::unsteady() const {
    return std::any_of(patches_.begin(), patches_.end(), [](const auto& p) { return p.second.unsteady(); });
}

void HexBoundary::set_time(double t) {
    if (!unsteady()) return;
    for (const auto& range : ranges_)
        if (patches_.at(range.name).unsteady()) evaluate(range, patches_.at(range.name), t);
    device_.assign(host_);
}

bool HexBoundary::closed() const {
    return std::none_of(patches_.begin(), patches_.end(),
                        [](const auto& p) { return p.second.velocity == VelocityCondition::zero_gradient; });
}

double HexBoundary::net_mass_flux() const {
    double sum = 0;
    for (const HexBorderFace& face : host_) sum += face.mass_flux;
    return sum;
}

void HexBoundary::check_mass_balance() const {
    const double net = net_mass_flux();
    double gross = 0, largest = 0;
    for (std::size_t b = 0; b < host_.size(); ++b) {
        gross += std::abs(host_[b].mass_flux);
        largest = std::max(
            largest, norm(area_[b]) * std::hypot(host_[b].value[1], host_[b].value[2], host_[b].value[3]));
    }
    // Walls that move along themselves carry rounding only, which never balances to a share of itself.
    const double rounding = 1e-14 * largest * static_cast<double>(host_.size());
    if (closed() && std::abs(net) > 1e-10 * gross + rounding) refuse_imbalance(net, gross);
}

}  // namespace hemoflux::fluid
