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

/// Hochmuth, Worthy and Evans (1979): four cells, t_c = 0.114, 0.115, 0.144 and 0.160 s by the same fit. The
/// drag that stands for the fluid may be wrong by a factor of two without much effect.
TEST(ValidationRelaxBack, OfBothShearModuliIsThatOfHochmuthAt642Nodes) {
    for (const double shear : {0.4, 0.61}) {
        ShapeOptions shape;
        shape.parameters.network.shear = shear;
        const Cell cell = make_discocyte(3, shape);
        std::vector<double> times;
        for (const double factor : {1.0, 2.0}) {
            Batch batch(cell.topology, cell.parameters, cell.reference);
            batch.set_positions(0, cell.positions);
            const auto points = stretch(batch, {20, 40});
            const DynamicsOptions options{
                .drag = factor * stokes_drag(10, 60, 3.27), .step = 1000, .steps = 45};
            const auto back = relax_back(batch, options);
            EXPECT_NEAR(back.front().axial_um, points.back().axial_um, 1e-9);
            times.push_back(recovery_time(back, 1.0));
        }
        RecordProperty("K_S_" + std::to_string(shear), std::to_string(times[0]) + " s");
        EXPECT_GT(times[0], 0.10);
        EXPECT_LT(times[0], 0.18);
        EXPECT_NEAR(times[0], 7000 / shear * 1e-5, 0.1 * times[0]);
        EXPECT_NEAR(times[1] / times[0], 1, 0.06);
    }
}

}  // namespace
}  // namespace hemoflux::membrane
