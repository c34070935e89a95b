/// Boundary conditions on an unstructured grid, through one ghost cell per border face. The ghost's centre is the border
/// cell's mirror image at the plane of the face, and so are its values and gradients:
///
///   given value b       phi_ghost = 2 b(foot) - phi,    grad phi_ghost = 2 b_t - grad phi + 2 n (n.grad phi)
///   zero gradient       phi_ghost = phi,                grad phi_ghost = grad phi - 2 n (n.grad phi)
///   given gradient g    phi_ghost = phi - 2 d g,        the same, with 2 g along the inward normal added
///   symmetry            V_ghost = H V, grad V_ghost = H grad V H,  H = I - 2 n n^T
///
/// n: unit normal; d: distance from the cell's centre to the plane. Profiles are evaluated at the face's centroid;
/// b_t, their gradient along the face, takes them from there to the foot of the cell's centre on the plane,
/// b(foot) = b - b_t.(r_face - r_cell)_t, so that the value on the face is as given and fields linear in space are
/// exact. The mass flux through a face with a given velocity is exactly rho_0 u_n (rho_0 = 1).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "exchange/buffer.hpp"
#include "fluid/boundary.hpp"
#include "fluid/hex_geometry.hpp"

namespace hemoflux::fluid {

/// Conditions of the border patches by their names in the mesh. Periodic pairs are glued in the grid and are no patches.
using HexPatches = std::map<std::string, Patch>;

/// Faces (nonzero) across which nothing can move because the cells are one sheet: those by which a cell is its own
/// periodic neighbour, and pairs of parallel planes of symmetry of one cell. They do not limit a time step.
std::vector<char> idle_faces(const meshing::HexGrid& grid, const HexPatches& patches);

/// What a ghost cell needs; value and slope: density, then velocity x, y, z.
struct HexBorderFace {
    double normal[3];    ///< outward
    double step;         ///< distance between the cell's centre and the ghost's
    double value[4];     ///< given values at the foot of the cell's centre, or the density's inward gradient
    double slope[3][4];  ///< their derivatives along the face with respect to x, y, z
    double mass_flux;    ///< outward, through the whole face
    VelocityCondition velocity;
    DensityCondition density;
};

/// Trivially copyable view of the border.
struct HexBorderView {
    const HexBorderFace* face = nullptr;
    std::size_t count = 0;
};

/// Evaluates the patches on a grid and keeps the result on the device.
class HexBoundary {
  public:
    /// InputError when a patch of the grid has no condition, a condition no patch, or a condition is impossible.
    HexBoundary(const meshing::HexGrid& grid, HexPatches patches);

    /// Re-evaluates the conditions that change in time.
    void set_time(double t);
    /// Whether any condition changes in time.
    [[nodiscard]] bool unsteady() const;

    [[nodiscard]] HexBorderView view() const { return {device_.data(), device_.size()}; }
    [[nodiscard]] const HexPatches& patches() const { return patches_; }
    /// True when no patch lets mass through freely.
    [[nodiscard]] bool closed() const;
    /// Throws InputError when the domain is closed but the given velocities (at the time last set) do not balance, so that
    /// its mass would grow or shrink for ever.
    void check_mass_balance() const;
    /// Sum of the prescribed mass fluxes, outward, over all faces (density 1).
    [[nodiscard]] double net_mass_flux() const;

  private:
    void evaluate(const meshing::HexGrid::Patch& range, const Patch& patch, double t);

    HexPatches patches_;
    std::vector<meshing::HexGrid::Patch> ranges_;
    std::size_t first_ = 0;
    std::vector<Vec3d> area_, centre_, reach_;
    std::vector<HexBorderFace> host_;
    exchange::Buffer<HexBorderFace> device_;
};

/// Fills the ghost cells of `values`, records of four.
void fill_ghost_values(const HexView& grid, const HexBorderView& border, double* values);
/// Fills the ghost cells of `records`, values and gradients, of some border faces in the order of the sweep; the ghost
/// values must be filled.
void fill_ghost_records(const HexView& grid, const HexBorderView& border, HexRange ghosts,
                        const double* values, double* records);
/// Fills the ghost cells of a field of records of four with the border cells' values.
void copy_to_ghosts(const HexView& grid, double* values);

}  // namespace hemoflux::fluid
