#include "membrane/recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::membrane {
namespace {

TEST(RecoveryTime, OfHochmuthsOwnCurveIsExact) {
    std::vector<RecoveryPoint> points;
    for (int k = 0; k < 40; ++k) {
        const double t = 0.01 * k, w_inf = 1.1, w0 = 2;
        const double s = std::exp(-t / 0.13) * (w0 - w_inf) / (w0 + w_inf);  // (w - w_inf)/(w + w_inf)
        points.push_back({t, 5 * w_inf * (1 + s) / (1 - s), 5});
    }
    EXPECT_NEAR(recovery_time(points, 1.1), 0.13, 1e-9);
    EXPECT_THROW(recovery_time({points[0]}, 1.1), InputError);
}

/// The stress-free cell of Table 6.1 at 162 nodes: mu_PM/K_S = 0.175 s and the drag of plasma and cytosol.
TEST(RelaxBack, TakesTheTimeOfTheMembraneViscosity) {
    const Cell cell = make_discocyte(2);
    Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    DynamicsOptions options{.drag = stokes_drag(10, 60, 3.27), .step = 2000, .steps = 200};
    const auto pulled = pulled_vertices(cell.positions);
    const auto pull = pull_in_time(batch, pulled, 30, options);
    EXPECT_LT(pull.size(), 200u);  // came to rest
    EXPECT_GT(pull.back().axial_um, pull.front().axial_um + 1);
    options.steps = 25;
    const auto back = relax_back(batch, options);
    const double tau = recovery_time(back, pull.front().axial_um / pull.front().transverse_um);
    RecordProperty("recovery_time_s", std::to_string(tau));
    EXPECT_GT(tau, 0.1);
    EXPECT_LT(tau, 0.3);

    Parameters fluid = cell.parameters;
    fluid.network.viscosity = 0;
    batch.set_parameters(fluid);
    pull_in_time(batch, pulled, 30, options);
    options.step = 100;
    const auto quick = relax_back(batch, options);
    EXPECT_LT(recovery_time(quick, pull.front().axial_um / pull.front().transverse_um), 0.1 * tau);
}

}  // namespace
}  // namespace hemoflux::membrane
