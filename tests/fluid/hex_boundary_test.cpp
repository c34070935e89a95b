#include "fluid/hex_boundary.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "hex_flows.hpp"

namespace hemoflux::fluid {

TEST(HexBoundary, RefusesPatchesThatDoNotFit) {
    const meshing::HexGrid grid = test::box_grid({3, 3, 3}, {3, 3, 3}, "xz");
    HexPatches patches = test::walls(grid);
    HexBoundary(grid, patches).check_mass_balance();
    patches["lid"] = wall_patch();
    EXPECT_THROW(HexBoundary(grid, patches), InputError);
    patches = test::walls(grid);
    patches.erase("y-");
    EXPECT_THROW(HexBoundary(grid, patches), InputError);
    patches["y-"] = periodic_patch();
    EXPECT_THROW(HexBoundary(grid, patches), InputError);
    patches["y-"] = velocity_patch([](const Vec3d&) { return Vec3d{0, 0.1, 0}; });
    EXPECT_THROW(HexBoundary(grid, patches).check_mass_balance(), InputError);
    EXPECT_NEAR(HexBoundary(grid, patches).net_mass_flux(), -0.9, 1e-14);
    patches["y+"] = open_patch();
    HexBoundary(grid, patches).check_mass_balance();
}

}  // namespace hemoflux::fluid
