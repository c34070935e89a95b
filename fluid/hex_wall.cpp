// Forces on the border patches of an unstructured grid (4.22, 4.23).
#include <cmath>

#include "exchange/error.hpp"
#include "fluid/hex_solver.hpp"

namespace hemoflux::fluid {
namespace {

struct Point {
    double density;
    Vec3d velocity;
};

/// Density and velocity of a record, taken `reach` away from its centre.
Point extrapolate(const double* record, const Vec3d& reach) {
    double q[4];
    for (int c = 0; c < 4; ++c)
        q[c] = record[c] + record[4 + c] * reach.x + record[8 + c] * reach.y + record[12 + c] * reach.z;
    return {q[0], {q[1], q[2], q[3]}};
}

}  // namespace

std::vector<WallFace> HexSolver::wall_faces(const std::string& patch) const {
    const meshing::HexGrid::Patch* range = nullptr;
    for (const auto& p : grid_.patches)
        if (p.name == patch) range = &p;
    if (!range) throw InputError("patch " + patch, "the mesh has no such patch", "name one of its patches");
    const HexView view = geometry_.whole_view();
    exchange::Buffer<double> all_records(16 * (cells() + grid_.border_faces())), all_fluxes(4 * view.fluxes);
    HexFields whole = fields();
    whole.records = all_records.data();
    whole.flux = all_fluxes.data();
    fill_ghost_values(view, boundary_.view(), values_.data());
    evaluate_gradients(view, whole);
    evaluate_fluxes(view, boundary_.view(), flow_parameters(), whole);
    const std::vector<double> records = all_records.to_host(), fluxes = all_fluxes.to_host();
    std::vector<std::uint32_t> number(view.border);
    exchange::copy_to_host(number.data(), view.border_face, number.size() * sizeof(std::uint32_t));
    const std::vector<Vec3d> ghosts = ghost_centres(grid_);
    std::vector<WallFace> all;
    for (std::size_t f = range->first; f < range->first + range->count; ++f) {
        const std::size_t cell = grid_.left[f], ghost = grid_.right[f];
        const Vec3d& area = grid_.area[f];
        const Point inner = extrapolate(&records[16 * cell], grid_.face_centre[f] - grid_.centre[cell]);
        const Point outer =
            extrapolate(&records[16 * ghost], grid_.face_centre[f] - ghosts[ghost - grid_.cells()]);
        const double density = (inner.density + outer.density) / 2;
        const Vec3d velocity = 0.5 * (inner.velocity + outer.velocity);
        const double* flux = &fluxes[4 * std::size_t{number[f - grid_.interior_faces()]}];
        const Vec3d momentum{flux[1], flux[2], flux[3]};
        // gamma times the flux is p n + rho u (u.n) less the viscous stress, with p = gamma rho / 3.
        const double gamma = options_.gamma;
        const Vec3d convected = (density * dot(velocity, area)) * velocity;
        const Vec3d viscous = gamma * momentum - (gamma * density / 3) * area - convected;
        all.push_back({grid_.face_centre[f], area, (gamma * (density - 1) / 3) * area, viscous});
    }
    return all;
}

}  // namespace hemoflux::fluid
