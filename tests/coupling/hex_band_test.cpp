#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/cell_grid.hpp"
#include "coupling/viscosity.hpp"
#include "hex_grids.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

using test::Points;

/// Two spheres one behind the other in memory; the second lies across the periodic seam of [0, 6] along x.
struct Spheres {
    meshing::SurfaceMesh mesh = meshing::icosphere(3, 1.3);
    std::vector<Vec3d> nodes;
    Spheres() {
        for (const Vec3d& r : mesh.vertices) nodes.push_back(r + Vec3d{2.6, 3.1, 2.9});
        for (const Vec3d& r : mesh.vertices) nodes.push_back(r + Vec3d{-0.1, 3.0, 3.2});
    }
};

std::vector<double> on_hexahedra(const meshing::HexGrid& grid, const Spheres& s, double surface_nu,
                                 HalfWidth half_width = {}) {
    const HexCells cells(grid);
    InteriorViscosity viscosity(cells, s.mesh.triangles, s.mesh.vertices.size(), {0.3, 2.0}, 1.0, half_width,
                                {}, surface_nu);
    const Points p(s.nodes);
    exchange::Buffer<double> nu(4 * grid.cells());
    EXPECT_TRUE(viscosity.update(p[0], p[1], p[2], nu.data() + 3, 4));
    EXPECT_FALSE(viscosity.update(p[0], p[1], p[2], nu.data() + 3, 4));
    const auto all = nu.to_host();
    std::vector<double> values;
    for (std::size_t c = 0; c < grid.cells(); ++c) values.push_back(all[4 * c + 3]);
    return values;
}

}  // namespace

TEST(HexBand, GivesTheViscosityOfTheRectilinearGridOnEqualCells) {
    const Spheres s;
    const meshing::HexGrid grid = test::skewed_box(12, 0, true);
    const auto axis = meshing::uniform_axis(0, 6, 12);
    const CellGrid straight({{axis, axis, axis}}, {true, false, false});
    for (const double surface_nu : {0.0, 0.4}) {
        InteriorViscosity viscosity(straight, s.mesh.triangles, s.mesh.vertices.size(), {0.3, 2.0}, 1.0, {},
                                    {}, surface_nu);
        const Points p(s.nodes);
        exchange::Buffer<double> field(straight.view().layout.size);
        viscosity.update(p[0], p[1], p[2], field.data());
        const auto of_box = field.to_host();
        const auto of_hex = on_hexahedra(grid, s, surface_nu);
        for (std::size_t c = 0; c < grid.cells(); ++c) {
            const Vec3d at = 2.0 * grid.centre[c];
            const std::size_t i = straight.view().layout.at(static_cast<int>(at.x), static_cast<int>(at.y),
                                                            static_cast<int>(at.z));
            ASSERT_NEAR(of_hex[c], of_box[i], 1e-9) << c;
        }
    }
}

// The integral of (nu - 1) over the domain is the jump times the volume of the surface; that of the surface viscosity is
// surface_nu times its area: to the order of the band's width over the radius, squared.
TEST(HexBand, HoldsVolumeAndAreaOnSkewedHexahedra) {
    const Spheres s;
    const meshing::HexGrid grid = test::skewed_box(24, 0.2, true);
    const auto nu = on_hexahedra(grid, s, 0, {1, 0.5}), with_surface = on_hexahedra(grid, s, 0.4, {1, 0.5});
    double jump = 0, surface = 0;
    for (std::size_t c = 0; c < grid.cells(); ++c) {
        jump += grid.volume[c] * (nu[c] - 1);
        surface += grid.volume[c] * (with_surface[c] - nu[c]);
    }
    const double volume = 4.0 / 3 * std::numbers::pi * std::pow(1.3, 3), area = 4 * std::numbers::pi * 1.69;
    // the half-width of 0.5 um about a radius of 1.3: the mean over the band adds 0.13 (w / R)^2
    EXPECT_NEAR(jump, (-0.7 + 1.0) * volume, 0.05 * 0.3 * volume);
    EXPECT_NEAR(surface, 2 * 0.4 * area, 0.05 * 0.8 * area);
}

}  // namespace hemoflux::coupling
