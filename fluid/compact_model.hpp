/// What an implicit method knows of a flow: the fluxes with the nodes of the local lattice at the values of the cell they
/// lie in, without gradients. They couple a cell with the neighbours across its faces only, so that their Jacobian is
/// sparse and diagonally strong; it is what Newton's linear systems are preconditioned with.
///
/// With delta = h/2 on a uniform grid the nodes lie level with the cell centres anyway. Where a floor of tau - 1/2 makes
/// delta shorter, leaving out the gradients is what keeps the preconditioner as stiff as the flux is for short waves: nodes
/// at values interpolated between the two cells did not converge there.
#pragma once

#include <cstdint>
#include <vector>

#include "exchange/vec3.hpp"
#include "fluid/boundary.hpp"

namespace hemoflux::fluid {

/// One face. On the border right == left, and the ghost's values follow from the cell's by the two conditions.
struct CompactFace {
    std::uint32_t left = 0, right = 0;
    Vec3d normal{};          ///< unit normal, from left to right (outward on the border)
    double area = 0;         ///< area
    double weight_left = 0;  ///< weight of the left cell in a linear mean at the face
    double delta = 0;        ///< streaming distance
    double nu = 0;           ///< kinematic viscosity at the face
    bool border = false;
    VelocityCondition velocity = VelocityCondition::zero_gradient;
    DensityCondition density = DensityCondition::zero_gradient;
    /// Border: the ghost's density and velocity are offset +- the cell's, minus where a value is given; under symmetry the
    /// velocity is reflected.
    double offset[4] = {0, 0, 0, 0};
};

/// All faces of a flow, save those by which a cell is its own neighbour.
struct CompactModel {
    double gamma = 1;
    std::vector<CompactFace> faces;
};

}  // namespace hemoflux::fluid
