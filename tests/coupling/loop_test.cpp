#include "coupling/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::coupling {
namespace {

/// One coarse cell in a small shear box; everything a loop needs.
struct Partners {
    std::unique_ptr<membrane::Batch> cells;
    std::unique_ptr<fluid::Solver> fluid;
    std::unique_ptr<Loop> loop;
    double step = 0;

    explicit Partners(bool periodic, bool recentre, std::size_t count = 1, double apart = 3.5,
                      std::optional<ContactOptions> contact = {},
                      const std::function<void(LoopOptions&, const membrane::Batch&)>& change = {},
                      double membrane_viscosity = 0) {
        static const membrane::Cell cell = membrane::make_discocyte(2);
        membrane::Parameters parameters = cell.parameters;
        parameters.network.viscosity = membrane_viscosity;
        cells = std::make_unique<membrane::Batch>(cell.topology, parameters, cell.reference, count);
        for (std::size_t c = 0; c < count; ++c) {
            std::vector<Vec3d> positions = cell.positions;
            for (Vec3d& r : positions) r = Vec3d{r.x, r.z + apart * static_cast<double>(c), -r.y};
            cells->set_positions(c, positions);
        }
        meshing::RectilinearGrid grid;
        grid.axes = {meshing::uniform_axis(-5.5, 5.5, 16), meshing::plateau_axis(-5.5, 5.5, 18, 5, 0.3),
                     meshing::uniform_axis(-5.5, 5.5, 16)};
        const double h = grid.smallest(), nu = 0.5 * h, rate = 0.004;
        fluid::Patches patches;
        patches.fill(periodic ? fluid::periodic_patch() : fluid::velocity_patch([=](const Vec3d& x) {
            return Vec3d{rate * x.y, 0, 0};
        }));
        fluid::SolverOptions o;
        o.nu = nu;
        o.with_force = o.with_viscosity = true;
        o.scheme = fluid::Scheme::factored;
        fluid = std::make_unique<fluid::Solver>(grid, patches, o);
        if (!periodic)
            fluid->initialise([=](const Vec3d& x) { return fluid::FlowPoint{1, {rate * x.y, 0, 0}}; });
        LoopOptions l;
        l.force_factor = 0.05;
        l.nu_inside.assign(count, 0.3 * nu);
        l.recentre = recentre;
        l.contact = contact;
        if (change) change(l, *cells);
        loop = std::make_unique<Loop>(*fluid, *cells, l);
        step = 0.5 * h;
    }
    std::vector<double> state() const {
        std::vector<double> all = cells->x().to_host();
        for (const auto& part :
             {cells->y().to_host(), cells->z().to_host(), fluid->state().interior(fluid->state().view().q[0]),
              fluid->state().interior(fluid->state().view().q[1])})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }
};

}  // namespace

TEST(Loop, IsBitwiseTheSameForAnyNumberOfThreadsAndRunToRun) {
    std::vector<std::vector<double>> states;
    for (const int threads : {1, 2, 2, 3}) {
        exchange::set_threads(threads);
        Partners p(false, true);
        for (int s = 0; s < 60; ++s) p.loop->step(p.step);
        states.push_back(p.state());
    }
    exchange::set_threads(0);
    for (const auto& s : states) EXPECT_EQ(s, states.front());
}

TEST(Loop, ContinuesBitwiseFromItsMemory) {
    Partners one(false, true);
    for (int s = 0; s < 30; ++s) one.loop->step(one.step);
    Partners two(false, true);
    for (int q = 0; q < 4; ++q)
        two.fluid->state().set_interior(two.fluid->state().view().q[q],
                                        one.fluid->state().interior(one.fluid->state().view().q[q]));
    two.cells->x().assign(one.cells->x().to_host());
    two.cells->y().assign(one.cells->y().to_host());
    two.cells->z().assign(one.cells->z().to_host());
    two.loop->restore(one.loop->memory());
    EXPECT_EQ(two.loop->memory(), one.loop->memory());
    for (int s = 0; s < 40; ++s) {
        one.loop->step(one.step);
        two.loop->step(two.step);
    }
    EXPECT_EQ(one.state(), two.state());
}

// Newton's third law through all parts: the membrane's forces add up to nothing, so a periodic box keeps its
// momentum.
TEST(Loop, PeriodicBoxKeepsItsMomentumAndMass) {
    Partners p(true, false);
    auto x = p.cells->positions(0);
    for (Vec3d& r : x)
        r = Vec3d{1.15 * r.x, r.y, 0.95 * r.z};  // stretched: the membrane sets the fluid in motion
    p.cells->set_positions(0, x);
    const double mass = p.fluid->mean_density();
    double largest = 0;
    for (int s = 0; s < 50; ++s) {
        p.loop->step(p.step);
        largest = std::max(largest, p.fluid->largest_speed());
    }
    EXPECT_GT(largest, 1e-4);
    EXPECT_NEAR(p.fluid->mean_density(), mass, 1e-13);
    const auto rho = p.fluid->state().interior(p.fluid->state().view().q[0]);
    const auto& axes = p.fluid->grid().rectilinear().axes;
    const auto dy = axes[1].widths();
    for (int c = 1; c < 4; ++c) {
        const auto u = p.fluid->state().interior(p.fluid->state().view().q[c]);
        double momentum = 0, magnitude = 0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            const double volume = dy[i / 16 % 18];
            momentum += volume * rho[i] * u[i];
            magnitude += volume * std::abs(rho[i] * u[i]);
        }
        EXPECT_LT(std::abs(momentum), 1e-11 * magnitude) << c;
    }
}

TEST(Loop, RecentringHoldsTheCentroid) {
    Partners p(false, true);
    for (int s = 0; s < 40; ++s) p.loop->step(p.step);
    const auto m = membrane::shape_moments(p.cells->topology().triangles(), p.cells->positions(0));
    EXPECT_LT(norm(m.centroid), 1e-12);
    EXPECT_GT(norm(p.loop->total_shift()), 0);
}

namespace {

/// Pulls the first cell apart along x, at its outermost two nodes.
void pull_apart(LoopOptions& l, const membrane::Batch& cells) {
    l.pull.assign(cells.stride(), 0.0);
    const auto at = cells.positions(0);
    const auto [left, right] =
        std::minmax_element(at.begin(), at.end(), [](const Vec3d& a, const Vec3d& b) { return a.x < b.x; });
    l.pull[static_cast<std::size_t>(left - at.begin())] = -1;
    l.pull[static_cast<std::size_t>(right - at.begin())] = 1;
}

double length_along_x(const membrane::Batch& cells) {
    const auto at = cells.positions(0);
    const auto [left, right] =
        std::minmax_element(at.begin(), at.end(), [](const Vec3d& a, const Vec3d& b) { return a.x < b.x; });
    return right->x - left->x;
}

}  // namespace

TEST(Loop, AConstantPullStretchesTheCellAndGivesNoMomentum) {
    Partners free(true, false), pulled(true, false, 1, 0, {}, pull_apart);
    const double start = length_along_x(*free.cells);
    for (int s = 0; s < 60; ++s) {
        free.loop->step(free.step);
        pulled.loop->step(pulled.step);
    }
    EXPECT_NEAR(length_along_x(*free.cells), start, 0.01);
    EXPECT_GT(length_along_x(*pulled.cells), start + 0.05);
    EXPECT_LT(std::abs(pulled.fluid->largest_speed()), 0.1);
    const auto u = pulled.fluid->state().interior(pulled.fluid->state().view().q[1]),
               rho = pulled.fluid->state().interior(pulled.fluid->state().view().q[0]);
    const auto dy = pulled.fluid->grid().rectilinear().axes[1].widths();
    double momentum = 0, magnitude = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        momentum += dy[i / 16 % 18] * rho[i] * u[i];
        magnitude += dy[i / 16 % 18] * std::abs(rho[i] * u[i]);
    }
    EXPECT_LT(std::abs(momentum), 1e-11 * magnitude);
    EXPECT_THROW(Partners(true, false, 1, 0, {},
                          [](LoopOptions& l, const membrane::Batch&) { l.pull.assign(7, 0.0); }),
                 InputError);
}

// Both forms of membrane viscosity slow the stretch, the more the larger it is, and neither stops it.
TEST(Loop, MembraneViscositySlowsTheStretch) {
    const auto stretch = [](double springs, double fluid) {
        Partners p(
            true, false, 1, 0, {},
            [&](LoopOptions& l, const membrane::Batch& cells) {
                pull_apart(l, cells);
                if (springs > 0) l.membrane_time = 1;
                l.surface_nu = fluid;
            },
            springs);
        const double start = length_along_x(*p.cells);
        for (int s = 0; s < 40; ++s) p.loop->step(p.step);
        p.loop->check();
        return length_along_x(*p.cells) - start;
    };
    const double none = stretch(0, 0);
    EXPECT_LT(stretch(2, 0), 0.99 * none);
    EXPECT_LT(stretch(20, 0), 0.97 * stretch(2, 0));
    EXPECT_GT(stretch(20, 0), 0.1 * none);
    EXPECT_LT(stretch(0, 0.3), 0.95 * none);
    EXPECT_GT(stretch(0, 0.3), 0.1 * none);
}

TEST(Loop, MembraneViscosityContinuesBitwiseFromItsMemory) {
    const auto viscous = [](LoopOptions& l, const membrane::Batch& cells) {
        pull_apart(l, cells);
        l.membrane_time = 1;
    };
    Partners one(false, true, 1, 0, {}, viscous, 50), two(false, true, 1, 0, {}, viscous, 50);
    for (int s = 0; s < 20; ++s) one.loop->step(one.step);
    for (int q = 0; q < 4; ++q)
        two.fluid->state().set_interior(two.fluid->state().view().q[q],
                                        one.fluid->state().interior(one.fluid->state().view().q[q]));
    two.cells->x().assign(one.cells->x().to_host());
    two.cells->y().assign(one.cells->y().to_host());
    two.cells->z().assign(one.cells->z().to_host());
    const CellMemory memory = one.loop->memory();
    EXPECT_GT(*std::max_element(memory.viscous.tension.begin(), memory.viscous.tension.end()), 0);
    two.loop->restore(memory);
    EXPECT_EQ(two.loop->memory(), memory);
    for (int s = 0; s < 20; ++s) {
        one.loop->step(one.step);
        two.loop->step(two.step);
    }
    EXPECT_EQ(one.state(), two.state());
}

TEST(Loop, TwoCellsAreCarriedByTheFlow) {
    Partners p(false, false, 2);  // the second one lies 3.5 um above the first, in faster fluid
    for (int s = 0; s < 100; ++s) p.loop->step(p.step);
    p.loop->check();
    const auto m = membrane::shape_moments(p.cells->topology().triangles(), p.cells->positions(1));
    const double expected = 0.004 * 3.5 * 100 * p.step;
    EXPECT_NEAR(m.centroid.x, expected, 0.1 * expected);
}

TEST(Loop, ContactPartsTwoCellsAndKeepsTheMomentum) {
    Partners p(true, false, 2, 3.0, ContactOptions{.pressure = 5, .range = 1.2, .walls = false});
    const double gap = p.loop->cells()->smallest_gap().distance;
    EXPECT_LT(gap, 0.7);
    for (int s = 0; s < 60; ++s) p.loop->step(p.step);
    p.loop->check();
    EXPECT_GT(p.loop->cells()->smallest_gap().distance, gap + 0.02);
    EXPECT_GT(p.loop->cells()->contact_energy(), 0);
    const auto v = p.fluid->state().interior(p.fluid->state().view().q[2]),
               rho = p.fluid->state().interior(p.fluid->state().view().q[0]);
    const auto dy = p.fluid->grid().rectilinear().axes[1].widths();
    double momentum = 0, magnitude = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        momentum += dy[i / 16 % 18] * rho[i] * v[i];
        magnitude += dy[i / 16 % 18] * std::abs(rho[i] * v[i]);
    }
    EXPECT_LT(std::abs(momentum), 1e-11 * magnitude);
}

TEST(Loop, NamesANodeInsideAnotherCell) {
    Partners p(false, false, 2, 2.2);
    try {
        p.loop->check();
        FAIL();
    } catch (const NumericalError& e) {
        EXPECT_NE(std::string(e.what()).find("inside cell"), std::string::npos) << e.what();
    }
    EXPECT_LT(p.loop->cells()->smallest_gap().distance, 0);
}

TEST(Loop, NamesALostNodeAndABadCell) {
    Partners p(false, false);
    auto x = p.cells->positions(0);
    for (Vec3d& r : x) r.x += 4;
    p.cells->set_positions(0, x);
    p.loop->step(p.step);
    const auto expect_lost = [&](const std::string& why) {
        try {
            p.loop->check();
            FAIL();
        } catch (const NumericalError& e) {
            EXPECT_NE(std::string(e.what()).find("membrane node"), std::string::npos) << e.what();
            EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
        }
    };
    expect_lost("has left the box");
    x = p.cells->positions(0);
    for (Vec3d& r : x) r.x -= 4;
    x[7].y = std::nan("");
    p.cells->set_positions(0, x);
    expect_lost("no longer a number");
    auto rho = p.fluid->state().interior(p.fluid->state().view().q[0]);
    rho[77] = std::nan("");
    p.fluid->state().set_interior(p.fluid->state().view().q[0], rho);
    try {
        p.loop->check();
        FAIL();
    } catch (const NumericalError& e) {
        EXPECT_NE(std::string(e.what()).find("fluid cell 77"), std::string::npos);
    }
}

TEST(Loop, ListsTheFieldsItsPartnersExchange) {
    Partners p(false, false);
    EXPECT_EQ(p.loop->fields().list().size(), 6u);
}

}  // namespace hemoflux::coupling
