#include "membrane/viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "membrane/relax.hpp"
#include "membrane/sheet.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

/// A flat sheet without elasticity, of the viscosity 7000.
Batch viscous_sheet() {
    Parameters p;
    p.network = {.shear = 0, .viscosity = 7000};
    p.constraint.local_area = 0;
    return flat_sheet(p, 3, 0.25);
}

/// Shear stress T_xy = -sum F_x y / A of the elements alone.
double shear_stress(Batch& batch, const MembraneViscosity& viscosity) {
    batch.compute_forces();
    viscosity.add_forces(batch);
    const auto r = batch.positions(0), f = batch.forces(0);
    double sum = 0;
    for (std::size_t v = 0; v < r.size(); ++v) sum -= f[v].x * r[v].y;
    return sum / batch.sums(0).area;
}

void shear_to(Batch& batch, const std::vector<Vec3d>& rest, double gamma) {
    auto r = rest;
    for (Vec3d& p : r) p.x += gamma * p.y;
    batch.set_positions(0, r);
}

/// A Maxwell fluid of viscosity mu_PM sheared at a small constant rate, then held:
/// T = mu_PM rate (1 - exp(-t/T)), then decays; the same for any division of the time.
TEST(MembraneViscosity, SheetFollowsTheMaxwellElementExactly) {
    const double rate = 1e-9;
    for (const int steps : {1, 7, 100}) {
        Batch batch = viscous_sheet();
        const auto rest = batch.positions(0);
        MembraneViscosity viscosity(batch, 5);
        const double time = 1.3 * viscosity.relaxation_time();
        for (int k = 1; k <= steps; ++k) {
            shear_to(batch, rest, rate * time * k / steps);
            viscosity.advance(batch, time / steps);
        }
        const double loaded = 7000 * rate * (1 - std::exp(-1.3));
        EXPECT_NEAR(shear_stress(batch, viscosity), loaded, 1e-4 * loaded) << steps;
        for (int k = 1; k <= steps; ++k) viscosity.advance(batch, time / steps);
        EXPECT_NEAR(shear_stress(batch, viscosity), loaded * std::exp(-1.3), 1e-4 * loaded) << steps;
    }
}

TEST(MembraneViscosity, MeetsNoRigidMotionAndHasNoNetForce) {
    Batch batch = test::rough_batch(2);
    MembraneViscosity viscosity(batch);
    auto r = batch.positions(0);
    for (Vec3d& p : r) p = {p.y + 3, -p.x, p.z - 1};
    batch.set_positions(0, r);
    viscosity.advance(batch, 2);
    batch.compute_forces();
    const auto before = batch.forces(0);
    viscosity.add_forces(batch);
    for (std::size_t v = 0; v < r.size(); ++v) EXPECT_LT(norm(batch.forces(0)[v] - before[v]), 1e-12);
    for (Vec3d& p : r) p = {1.1 * p.x, 0.95 * p.y + 0.02 * p.x * p.z, p.z};
    batch.set_positions(0, r);
    viscosity.advance(batch, 2);
    batch.compute_forces();
    const auto elastic = batch.forces(0);
    viscosity.add_forces(batch);
    const auto total = batch.forces(0);
    Vec3d net{0, 0, 0}, torque{0, 0, 0};
    double sum = 0;
    for (std::size_t v = 0; v < r.size(); ++v) {
        const Vec3d f = total[v] - elastic[v];
        net += f;
        torque += cross(r[v], f);
        sum += norm(f);
    }
    EXPECT_GT(sum, 1);
    EXPECT_LT(norm(net), 1e-12 * sum);
    EXPECT_LT(norm(torque), 1e-12 * sum);
}

/// Explicit motion of a disturbed disc against a drag, at half the step that elasticity allows: with Maxwell
/// elements it comes to rest in the minimum without viscosity; with next to bare dashpots it blows up.
TEST(MembraneViscosity, IsStableAtTheElasticStepAndDoesNotChangeTheRestingShape) {
    Batch rest = test::rough_batch(2, 1);
    Parameters thin;
    thin.network.viscosity = 700;
    rest.set_parameters(thin);
    relax(rest, {.tolerance = 1e-6});
    const double energy = (rest.compute_forces(), rest.energies(0).total());
    const auto run = [&](double stiffness) {
        Batch batch(rest.shared_topology(), rest.parameters(), rest.reference());
        auto r = rest.positions(0);
        for (Vec3d& p : r) p = {1.02 * p.x, p.y / 1.02, p.z};
        batch.set_positions(0, r);
        MembraneViscosity viscosity(batch, stiffness);
        const double dt = 1, drag = 200;
        double speed = 0;
        for (int k = 0; k < 25000 && speed < 1; ++k) {
            if (!batch.try_compute_forces()) return 1e9;
            viscosity.add_forces(batch);
            const auto f = batch.forces(0);
            speed = 0;
            for (std::size_t v = 0; v < r.size(); ++v) {
                r[v] += (dt / drag) * f[v];
                speed = std::max(speed, norm(f[v]) / drag);
            }
            batch.set_positions(0, r);
            viscosity.advance(batch, dt);
        }
        return batch.try_compute_forces() ? batch.energies(0).total() - energy : 1e9;
    };
    EXPECT_NEAR(run(maxwell_stiffness), 0, 1e-5 * energy);
    EXPECT_GT(run(1e4), energy);
}

TEST(MembraneViscosity, StateGoesOnFromACheckpointBitByBitOnAnyThreads) {
    Batch batch = test::rough_batch(4, 2);
    MembraneViscosity viscosity(batch);
    const auto stir = [&](double factor) {
        for (std::size_t c = 0; c < batch.cells(); ++c) {
            auto r = batch.positions(c);
            for (Vec3d& p : r) p = {factor * p.x, p.y / factor, p.z};
            batch.set_positions(c, r);
        }
    };
    stir(1.01);
    viscosity.advance(batch, 2);
    const ViscousState saved = viscosity.state(batch);
    MembraneViscosity resumed(batch);
    resumed.set_state(batch, saved);
    stir(1.02);
    exchange::set_threads(1);
    viscosity.advance(batch, 3);
    exchange::set_threads(3);
    resumed.advance(batch, 3);
    exchange::set_threads(1);
    EXPECT_EQ(viscosity.state(batch).tension, resumed.state(batch).tension);
    EXPECT_EQ(viscosity.state(batch).length, resumed.state(batch).length);
    EXPECT_THROW(resumed.set_state(batch, {}), std::length_error);
}

TEST(MembraneViscosity, NoViscosityNoForceAndBadInputIsRefused) {
    Batch batch = test::rough_batch(1);
    Parameters p;
    p.network.viscosity = 0;
    batch.set_parameters(p);
    MembraneViscosity none(batch);
    auto r = batch.positions(0);
    r[3].x += 0.01;
    batch.set_positions(0, r);
    none.advance(batch, 1);
    for (const double q : none.state(batch).tension) EXPECT_EQ(q, 0);
    EXPECT_THROW(none.advance(batch, 0), InputError);
    EXPECT_THROW(MembraneViscosity(batch, -1), InputError);
}

}  // namespace
}  // namespace hemoflux::membrane
