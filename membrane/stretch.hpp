/// Optical tweezers, statically: a cell is pulled at both ends along x and relaxed at every force
/// (section 7.2.2 of the thesis; Mills et al. 2004).
///
///   D_A = 2 max |r|,  D_T = 2 max (y^2 + z^2)^{1/2},  the cell centred at its volume centroid.
#pragma once

#include <functional>
#include <vector>

#include "membrane/batch.hpp"
#include "membrane/relax.hpp"

namespace hemoflux::membrane {

/// Vertices that the beads hold: `left` is pulled towards -x, `right` towards +x.
struct PulledVertices {
    std::vector<int> left, right;
};

/// Fraction of the vertices that each bead holds in section 7.2.2.
inline constexpr double pulled_fraction = 0.02;

/// What each bead holds.
struct Grip {
    double fraction = pulled_fraction;  ///< of all vertices
    double contact_diameter = 0;  ///< um; when positive, all within half of it from the end, in its place
    bool operator==(const Grip&) const = default;
};

/// The round(fraction N) vertices, at least one, of smallest and of largest x of the rest shape; the lower
/// index wins a tie. With a contact diameter those no further than half of it from the outermost one.
/// InputError when there are fewer than two vertices, or the two ends would share one.
PulledVertices pulled_vertices(const std::vector<Vec3d>& rest, const Grip& grip = {});

/// Force on each vertex, 1e-11 N: `force_pN` along +-x, shared out among the pulled vertices of each end.
std::vector<Vec3d> pulling_loads(const PulledVertices& pulled, std::size_t vertices, double force_pN);

/// The cell at one force.
struct StretchPoint {
    double force_pN = 0;
    double axial_um = 0, transverse_um = 0;
    int iterations = 0;
    double area_error = 0, volume_error = 0;  ///< relative to the relaxed cell without force
};

/// Measures of the batch's one cell as it is; areas and volumes relative to those given.
StretchPoint stretch_point(const Batch& batch, double force_pN, double rest_area, double rest_volume);

/// Relaxes the batch's one cell, chooses the pulled vertices once from that rest shape, and applies the
/// forces (pN) in the given order, each from the shape before; `done`, if any, is called after each. The batch
/// is left in its last shape. Errors as relax(), with the force; InputError
/// when a force is negative or not finite.
std::vector<StretchPoint> stretch(Batch& batch, const std::vector<double>& forces_pN,
                                  const RelaxOptions& options = {}, const Grip& grip = {},
                                  const std::function<void(const StretchPoint&)>& done = {});

}  // namespace hemoflux::membrane
