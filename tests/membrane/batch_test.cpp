#include "membrane/batch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

std::string message(Batch& batch) {
    try {
        batch.compute_forces();
    } catch (const NumericalError& error) {
        return error.what();
    }
    return "no error";
}

bool same(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].x != b[i].x || a[i].y != b[i].y || a[i].z != b[i].z) return false;
    return a.size() == b.size();
}

TEST(Batch, IsBitwiseTheSameForAnyNumberOfThreadsWithEveryLawAndScheme) {
    for (const InPlaneLaw law : {InPlaneLaw::wlc, InPlaneLaw::wlc_power, InPlaneLaw::wlc_hydrostatic,
                                 InPlaneLaw::neo_hookean, InPlaneLaw::skalak})
        for (const BendingScheme scheme : {BendingScheme::juelicher, BendingScheme::gompper_kroll}) {
            exchange::set_threads(1);
            Batch batch = test::rough_batch(4, 3);
            Parameters parameters;
            parameters.network.law = law;
            parameters.bending.scheme = scheme;
            batch.set_parameters(parameters);
            batch.compute_forces();
            std::vector<std::vector<Vec3d>> one;
            std::vector<double> energy;
            for (std::size_t c = 0; c < 3; ++c) {
                one.push_back(batch.forces(c));
                energy.push_back(batch.energies(c).total());
            }
            for (const int threads : {2, 3}) {
                exchange::set_threads(threads);
                batch.compute_forces();
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_TRUE(same(batch.forces(c), one[c])) << threads << " threads, cell " << c;
                    EXPECT_EQ(batch.energies(c).total(), energy[c]);
                }
            }
        }
    exchange::set_threads(1);
}

TEST(Batch, CellsAreIndependentOfTheirNeighboursInTheBatch) {
    Batch many = test::rough_batch(2, 5), one = test::rough_batch(2);  // five take the whole-cell route
    many.compute_forces();
    for (std::size_t c = 0; c < many.cells(); ++c) {
        one.set_positions(0, many.positions(c));
        one.compute_forces();
        EXPECT_TRUE(same(one.forces(0), many.forces(c))) << c;
        EXPECT_EQ(one.energies(0).total(), many.energies(c).total());
        EXPECT_EQ(one.sums(0).volume, many.sums(c).volume);
    }
}

TEST(Batch, PaddingHasNoForceWhateverItHolds) {
    Batch batch = test::rough_batch(2);
    ASSERT_GT(batch.stride(), batch.vertices());
    batch.compute_forces();
    const auto expected = batch.forces(0);
    for (double junk : {1e9, std::numeric_limits<double>::quiet_NaN()}) {
        auto x = batch.x().to_host();
        x.back() = junk;
        batch.x().assign(x);
        batch.compute_forces();
        EXPECT_TRUE(same(batch.forces(0), expected));
        for (std::size_t i = batch.vertices(); i < batch.stride(); ++i)
            EXPECT_EQ(batch.fx().to_host()[i], 0.0);
    }
}

TEST(Batch, NamesTheSpringThatReachesItsContourLength) {
    Batch batch = test::rough_batch(2, 3);
    Reference reference = batch.reference();
    const auto lengths = edge_lengths(batch.topology(), batch.positions(1));
    reference.edge_lengths[17] = lengths[17] / reference.stretch_ratio;  // l = 1 in cell 1
    for (std::size_t c : {std::size_t(0), std::size_t(2)}) {
        auto shrunk = batch.positions(c);
        for (Vec3d& r : shrunk) r = 0.5 * r;
        batch.set_positions(c, shrunk);
    }
    batch.set_reference(reference);
    const Edge& e = batch.topology().edges()[17];
    const std::string text = message(batch);
    EXPECT_NE(text.find("spring 17 of cell 1, between vertices " + std::to_string(e.v1) + " and " +
                        std::to_string(e.v2)),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("contour length"), std::string::npos) << text;
    EXPECT_FALSE(batch.try_compute_forces());

    reference.edge_lengths[17] = lengths[17] / reference.stretch_ratio * (1 + 1e-9);
    batch.set_reference(reference);
    EXPECT_EQ(message(batch), "no error");
}

TEST(Batch, NotANumberIsAnError) {
    Batch batch = test::rough_batch(2);
    auto r = batch.positions(0);
    r[5].y = std::numeric_limits<double>::quiet_NaN();
    batch.set_positions(0, r);
    const std::string text = message(batch);
    EXPECT_NE(text.find("vertex 5 "), std::string::npos) << text;
    EXPECT_NE(text.find("its position is not a number"), std::string::npos) << text;
}

TEST(Batch, RefusesWrongInput) {
    const auto topology = test::icosphere_topology(1);
    const Reference good = reference_from_shape(*topology, meshing::icosphere(1, 1.0).vertices);
    EXPECT_THROW(Batch(topology, {}, good, 0), InputError);
    Reference bad = good;
    bad.edge_lengths.pop_back();
    EXPECT_THROW(Batch(topology, {}, bad), InputError);
    bad = good;
    bad.volume = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(Batch(topology, {}, bad), InputError);
    bad = good;
    bad.stretch_ratio = 1;
    EXPECT_THROW(Batch(topology, {}, bad), InputError);
    bad = good;
    bad.triangle_areas[3] = 0;
    EXPECT_THROW(Batch(topology, {}, bad), InputError);
    Parameters parameters;
    parameters.bending.local = -1;
    EXPECT_THROW(Batch(topology, parameters, good), InputError);
    EXPECT_THROW(reference_from_shape(*topology, meshing::icosphere(2, 1.0).vertices), InputError);
}

}  // namespace
}  // namespace hemoflux::membrane
