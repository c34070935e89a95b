#include "fluid/boundary.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "flows.hpp"

namespace hemoflux::fluid {
namespace {

struct Box {
    Patches patches;
    Grid grid;
    Boundary boundary;
    State state;

    explicit Box(const Patches& p)
        : patches(p),
          grid(make_grid(), periodic_axes(p)),
          boundary(p, grid),
          state(grid.view().layout, true, true, 0.1) {}
    static meshing::RectilinearGrid make_grid() {
        meshing::RectilinearGrid g;
        g.axes = {meshing::uniform_axis(0, 1, 5), meshing::explicit_axis({0, 0.1, 0.3, 0.6, 1}),
                  meshing::uniform_axis(-1, 1, 3)};
        return g;
    }
    void set(int c, const std::function<double(const Vec3d&)>& f) {
        std::vector<double> v;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 4; ++j)
                for (std::size_t i = 0; i < 5; ++i)
                    v.push_back(
                        f({grid.rectilinear().axes[0].centres()[i], grid.rectilinear().axes[1].centres()[j],
                           grid.rectilinear().axes[2].centres()[k]}));
        state.set_interior(state.view().q[c], v);
    }
    double at(int c, std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        std::vector<double> all(grid.view().layout.size);
        exchange::copy_to_host(all.data(), state.view().q[c], all.size() * sizeof(double));
        return all[grid.view().layout.at(i, j, k)];
    }
};

}  // namespace

TEST(Boundary, LinearProfilesAreContinuedExactly) {
    // A linear velocity, given on all sides, is extended linearly into every ghost cell, edges and corners
    // included.
    const auto linear = [](const Vec3d& x) { return 0.1 + 0.02 * x.x - 0.03 * x.y + 0.01 * x.z; };
    Patches p;
    p.fill(velocity_patch([&](const Vec3d& x) { return Vec3d{linear(x), 0, 0}; }));
    Box s(p);
    s.set(1, linear);
    s.boundary.fill(s.grid.view(), s.state.view());
    const double x[9] = {-0.3, -0.1, 0.1, 0.3, 0.5, 0.7, 0.9, 1.1, 1.3};
    const double y[8] = {-0.2, -0.05, 0.05, 0.2, 0.45, 0.8, 1.2, 1.55};
    for (int k = -2; k < 5; ++k)
        for (int j = -2; j < 6; ++j)
            for (int i = -2; i < 7; ++i) {
                const double z = -1 + (k + 0.5) * 2.0 / 3.0;
                EXPECT_NEAR(s.at(1, i, j, k), linear({x[i + 2], y[j + 2], z}), 1e-15)
                    << i << " " << j << " " << k;
            }
}

TEST(Boundary, PeriodicSymmetricAndGradientGhosts) {
    Patches p;
    p.fill(periodic_patch());
    p[2] = symmetry_patch();
    p[3] = open_patch();
    p[3].density = DensityCondition::given_gradient;
    p[3].density_profile = [](const Vec3d&) {
        return -0.5;
    };  // along the inward normal, that is d(rho)/dy = 0.5
    Box s(p);
    s.set(0, [](const Vec3d& x) { return 1 + 0.5 * x.y; });
    for (int c = 1; c < 4; ++c) s.set(c, [c](const Vec3d& x) { return c + x.x + 10 * x.y + 100 * x.z; });
    s.boundary.fill(s.grid.view(), s.state.view());
    for (int c = 1; c < 4; ++c) {
        EXPECT_EQ(s.at(c, -1, 1, 1), s.at(c, 4, 1, 1));
        EXPECT_EQ(s.at(c, 6, 1, 1), s.at(c, 1, 1, 1));
        EXPECT_EQ(s.at(c, 2, 1, -2), s.at(c, 2, 1, 1));
        EXPECT_EQ(s.at(c, 2, -2, 1), (c == 2 ? -1 : 1) * s.at(c, 2, 1, 1));
        EXPECT_EQ(s.at(c, 2, 4, 1), s.at(c, 2, 3, 1));
    }
    EXPECT_NEAR(s.at(0, 2, 4, 1), 1 + 0.5 * 1.2, 1e-15);
    EXPECT_NEAR(s.at(0, 2, 5, 1), 1 + 0.5 * 1.55, 1e-15);
    EXPECT_FALSE(s.boundary.closed());
}

TEST(Boundary, NetMassFluxOfGivenVelocities) {
    Patches p;
    p.fill(wall_patch());
    p[0] = velocity_patch([](const Vec3d&) { return Vec3d{0.2, 0, 0}; });
    EXPECT_NEAR(Box(p).boundary.net_mass_flux(), -0.2 * 1 * 2, 1e-15);
    p.fill(velocity_patch([](const Vec3d& x) { return Vec3d{x.y, 0, 0}; }));
    EXPECT_NEAR(Box(p).boundary.net_mass_flux(), 0, 1e-15);
    EXPECT_TRUE(Box(p).boundary.closed());
    EXPECT_NO_THROW(Box(p).boundary.check_mass_balance());
    p.fill(wall_patch());
    p[0] = velocity_patch([](const Vec3d&) { return Vec3d{0.2, 0, 0}; });
    EXPECT_THROW(Box(p).boundary.check_mass_balance(), InputError);
    p[1] = density_patch(1);
    EXPECT_NO_THROW(Box(p).boundary.check_mass_balance());
}

TEST(Boundary, ConditionsThatChangeInTime) {
    Patches p;
    p.fill(wall_patch());
    p[3].unsteady_velocity = [](const Vec3d& x, double t) { return Vec3d{x.x + t, 0, 0}; };
    p[3].density = DensityCondition::given;
    p[3].unsteady_density = [](const Vec3d&, double t) { return 1 + 0.1 * t; };
    Box s(p);
    EXPECT_TRUE(s.boundary.unsteady());
    s.set(0, [](const Vec3d&) { return 1.0; });
    for (const double t : {0.0, 0.5}) {
        s.boundary.set_time(t, s.grid);
        s.boundary.fill(s.grid.view(), s.state.view());
        EXPECT_NEAR(s.at(1, 1, 4, 1) + s.at(1, 1, 3, 1), 2 * (0.3 + t), 1e-15) << t;
        EXPECT_NEAR(s.at(0, 1, 4, 1), 1 + 0.2 * t, 1e-15) << t;
    }
    p[3] = wall_patch();
    EXPECT_FALSE(Box(p).boundary.unsteady());
}

TEST(Boundary, PeriodicSidesComeInPairs) {
    Patches p;
    p.fill(wall_patch());
    p[4] = periodic_patch();
    EXPECT_THROW(check(p), InputError);
    p[5] = periodic_patch();
    EXPECT_NO_THROW(check(p));
    p[5].density = DensityCondition::zero_gradient;
    EXPECT_THROW(check(p), InputError);
}

}  // namespace hemoflux::fluid
