/// The fluid cells in a band around the membranes, as the viscosity inside cells needs them: implemented for rows of
/// cells (cell_band.cpp) and for hexahedra (hex_band.cpp). Outermost level: one call a recomputation.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace hemoflux::coupling {

struct BandTriangle;

/// Half-width of the band: `local_cells` times the local cell, unless `fixed` (um) is positive.
struct HalfWidth {
    double local_cells = 1;
    double fixed = 0;
};

/// What (6.45) is made of; nu_inside: one value a membrane, device. surface_nu: see viscosity.hpp.
struct BandViscosity {
    const double* nu_inside = nullptr;
    double nu_outside = 0, low = 0, high = 0, surface_nu = 0;  ///< low, high: range of the sum
    HalfWidth half_width;
};

/// The closed surfaces that a band lies around: `cells` of them, of `vertices` nodes each, joined by `triangles`.
struct BandSurfaces {
    const std::vector<std::array<int, 3>>& triangles;
    std::size_t vertices, cells;
};

/// The cells around a number of closed surfaces.
class MembraneBand {
  public:
    virtual ~MembraneBand() = default;

    /// Takes the surfaces as they are now: x, y, z (device, um) and `moved` as in SignedDistance::prepare().
    virtual void prepare(const double* x, const double* y, const double* z,
                         const std::vector<int>& moved) = 0;
    /// Writes the viscosity of every fluid cell, value i at nu[stride * i].
    virtual void viscosity(const BandViscosity& v, double* nu, std::size_t stride) = 0;
    /// The triangles of all surfaces as prepared; device.
    [[nodiscard]] virtual const BandTriangle* triangles() const = 0;
    /// Half-width at every node as prepared, um; device.
    [[nodiscard]] virtual const double* half_widths() const = 0;

  protected:
    MembraneBand() = default;
    MembraneBand(const MembraneBand&) = default;
    MembraneBand& operator=(const MembraneBand&) = default;
};

}  // namespace hemoflux::coupling
