// The band of fluid cells around the membranes on a rectilinear grid.
#include "coupling/surface_scan.hpp"
#include "coupling/viscosity.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Adds one membrane cell to the viscosity.
struct AddCell {
    double* nu;
    double jump, low, high;
    HEMOFLUX_INLINE void operator()(std::size_t at, double ratio) const {
        const double sum = nu[at] + jump * heaviside(ratio);
        nu[at] = sum < low ? low : (sum > high ? high : sum);
    }
};

/// Adds the surface viscosity of one membrane cell.
struct AddMembrane {
    double* nu;
    CellGridView grid;
    double surface_nu;
    HalfWidth half_width;
    HEMOFLUX_INLINE void operator()(std::size_t at, double ratio) const {
        const double slope = heaviside_slope(ratio);
        if (!(slope > 0)) return;
        const std::size_t from = at - grid.layout.origin, in_plane = from % grid.layout.plane;
        const double x = grid.axis[0].width[in_plane % grid.layout.row],
                     y = grid.axis[1].width[in_plane / grid.layout.row],
                     z = grid.axis[2].width[from / grid.layout.plane];
        const double local = x > y ? (x > z ? x : z) : (y > z ? y : z);
        const double h = half_width.fixed > 0 ? half_width.fixed : half_width.local_cells * local;
        nu[at] += surface_nu * slope / h;
    }
};

/// Viscosity of one tile: all membrane cells in turn.
struct ViscosityTile {
    SurfacesView surfaces;
    Tiles tiles;
    const double* nu_inside;
    double nu_outside, low, high, surface_nu;
    HalfWidth half_width;
    double* nu;
    HEMOFLUX_FN void operator()(std::size_t tile) const {
        const TileRange r = tiles.range(tile);
        for (int k = r.k0; k < r.k1; ++k)
            for (int j = r.j0; j < r.j1; ++j)
                for (int i = 0; i < surfaces.grid.axis[0].n; ++i)
                    nu[surfaces.grid.layout.at(i, j, k)] = nu_outside;
        for (std::size_t c = 0; c < surfaces.cells; ++c)
            band_cells(surfaces, r, c, AddCell{nu, nu_inside[c] - nu_outside, low, high});
        if (surface_nu > 0)  // after all of them, whose sum is limited
            for (std::size_t c = 0; c < surfaces.cells; ++c)
                band_cells(surfaces, r, c, AddMembrane{nu, surfaces.grid, surface_nu, half_width});
    }
};

class CellBand final : public MembraneBand {
  public:
    CellBand(const CellGrid& grid, const BandSurfaces& s, HalfWidth half_width)
        : distance_(grid, s.triangles, s.vertices, s.cells, half_width) {}

    void prepare(const double* x, const double* y, const double* z, const std::vector<int>& moved) override {
        distance_.prepare(x, y, z, moved);
    }
    void viscosity(const BandViscosity& v, double* nu, std::size_t /*stride: one array*/) override {
        const SurfacesView surfaces = distance_.view();
        const Tiles tiles(surfaces.grid.layout);
        exchange::for_each_index(tiles.count(), ViscosityTile{surfaces, tiles, v.nu_inside, v.nu_outside,
                                                              v.low, v.high, v.surface_nu, v.half_width, nu});
    }
    [[nodiscard]] const BandTriangle* triangles() const override { return distance_.triangles(); }
    [[nodiscard]] const double* half_widths() const override { return distance_.half_widths(); }

  private:
    SignedDistance distance_;
};

}  // namespace

std::unique_ptr<MembraneBand> CellGrid::band(const BandSurfaces& surfaces, HalfWidth half_width) const {
    return std::make_unique<CellBand>(*this, surfaces, half_width);
}

}  // namespace hemoflux::coupling
