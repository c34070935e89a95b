#include "membrane/dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"
#include "membrane/sheet.hpp"
#include "membrane/stretch.hpp"
#include "membrane/wlc.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

constexpr double tau = 7000 / 0.4;  // mu_PM / K_S

/// Stretch in x, less 1, of a patch of springs and dashpots that starts from the stretches (x, y) and is let
/// go, after each of the steps that make up one time constant.
std::vector<double> let_go(double x, double y, int steps) {
    Parameters p;
    p.network = {.shear = 0.4, .viscosity = 7000};
    p.constraint.local_area = 0;
    Batch batch = flat_sheet(p, 2, 0.25);
    const auto rest = batch.positions(0);
    auto r = rest;
    for (Vec3d& q : r) q = {x * q.x, y * q.y, 0};
    batch.set_positions(0, r);
    std::size_t corner = 0;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (rest[v].x > rest[corner].x) corner = v;
    std::vector<double> strain;
    const DynamicsOptions options{
        .drag = 1e-6, .step = tau / steps, .steps = steps, .solver = {.tolerance = 3e-7}};
    evolve(batch, options, {}, [&](double) {
        strain.push_back(batch.positions(0)[corner].x / rest[corner].x - 1);
        return true;
    });
    return strain;
}

/// Stretched alike in both directions, every spring obeys g dL/dt = -dE/dL.
double dilated_patch_error(int steps) {
    const WormLikeChain chain(0.4, 2.6);
    const double contour = 2.6 * 0.25, g = 4 * 7000 / std::sqrt(3.0);
    const auto rate = [&](double length) {
        const double l = length / contour;
        return -chain.tension(l, 1 / (1 - l), contour) / g;
    };
    const auto strain = let_go(1.1, 1.1, steps);
    double length = 1.1 * 0.25, worst = 0;
    for (const double found : strain) {
        for (int k = 0; k < 20; ++k) {
            const double h = tau / steps / 20, a = rate(length), b = rate(length + 0.5 * h * a),
                         c = rate(length + 0.5 * h * b), d = rate(length + h * c);
            length += h / 6 * (a + 2 * b + 2 * c + d);
        }
        worst = std::max(worst, std::fabs(found / (length / 0.25 - 1) - 1));
    }
    return worst;
}

TEST(Dynamics, DilatedPatchRelaxesAsItsSpringsDoAndWithSecondOrder) {
    const double coarse = dilated_patch_error(40), fine = dilated_patch_error(80);
    EXPECT_LT(fine, 2e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
    RecordProperty("error_80_steps", std::to_string(fine));
}

/// In shear the strain falls as exp(-t K_S/mu_PM); half the difference of two opposite starts has no
/// second-order part.
TEST(Dynamics, ShearedPatchRelaxesWithTheRatioOfViscosityAndShearModulus) {
    constexpr double start = 5e-3;
    constexpr int steps = 40;
    const auto wide = let_go(1 + start, 1 - start, steps), tall = let_go(1 - start, 1 + start, steps);
    for (int k = 1; k <= steps; ++k) {
        const auto i = static_cast<std::size_t>(k - 1);
        EXPECT_NEAR((wide[i] - tall[i]) / (2 * start), std::exp(-static_cast<double>(k) / steps), 1e-3) << k;
    }
}

/// Pulled with and without membrane viscosity, fast and slow, a cell comes to rest in the static shape.
TEST(Dynamics, EndsInTheStaticShapeWhateverTheViscosity) {
    Batch rest = test::rough_batch(2);
    relax(rest);
    const auto start = rest.positions(0);
    const auto load = pulling_loads(pulled_vertices(start), start.size(), 60);
    relax(rest, {}, load);
    const auto expected = rest.positions(0);
    for (const double viscosity : {0.0, 7000.0}) {
        Parameters p;
        p.network.viscosity = viscosity;
        Batch batch(rest.shared_topology(), p, rest.reference());
        batch.set_positions(0, start);
        double time = 0;
        evolve(batch,
               {.drag = stokes_drag(10, 60, 3.27), .step = 40000, .steps = 40, .solver = {.tolerance = 2e-5}},
               load, [&](double now) {
                   time = now;
                   return true;
               });
        EXPECT_EQ(time, 40 * 40000.0);
        const auto r = batch.positions(0);
        for (std::size_t v = 0; v < r.size(); ++v) EXPECT_LT(norm(r[v] - expected[v]), 5e-3) << viscosity;
    }
}

TEST(Dynamics, RefusesBadOptions) {
    Batch batch = test::rough_batch(1);
    const auto always = [](double) { return true; };
    EXPECT_THROW(evolve(batch, {.drag = 0, .step = 1, .steps = 1}, {}, always), InputError);
    EXPECT_THROW(evolve(batch, {.drag = 1, .step = -1, .steps = 1}, {}, always), InputError);
    EXPECT_THROW(evolve(batch, {.drag = 1, .step = 1, .steps = 0}, {}, always), InputError);
    EXPECT_THROW(evolve(batch, {.drag = 1, .step = 1, .steps = 1}, std::vector<Vec3d>(3), always),
                 InputError);
}

}  // namespace
}  // namespace hemoflux::membrane
