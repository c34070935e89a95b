#include "membrane/relax.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "membrane/stretch.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

double largest_force(Batch& batch) {
    batch.compute_forces();
    double most = 0;
    for (const Vec3d& f : batch.forces(0)) most = std::max(most, norm(f));
    return most;
}

TEST(Relax, ReachesTheToleranceAndLowersTheEnergy) {
    Batch batch = test::rough_batch(2);
    batch.compute_forces();
    const double before = batch.energies(0).total();
    const RelaxResult result = relax(batch);
    EXPECT_LE(largest_force(batch), 2e-5);
    EXPECT_DOUBLE_EQ(result.largest_force, largest_force(batch));
    EXPECT_LT(result.energy, 0.5 * before);
    EXPECT_DOUBLE_EQ(result.energy, batch.energies(0).total());
    EXPECT_GT(result.evaluations, result.iterations);
}

TEST(Relax, AMinimumStaysWhereItIs) {
    Batch batch = test::rough_batch(2);
    relax(batch);
    EXPECT_EQ(relax(batch).iterations, 0);
}

TEST(Relax, IsBitwiseTheSameWithOneAndTwoThreads) {
    std::vector<Vec3d> first;
    for (int threads : {1, 2}) {
        exchange::set_threads(threads);  // 2562 vertices are shared
        Batch batch = test::rough_batch(4);
        relax(batch, {.tolerance = 1});
        const auto r = batch.positions(0);
        if (first.empty()) first = r;
        for (std::size_t v = 0; v < r.size(); ++v) EXPECT_EQ(norm(r[v] - first[v]), 0);
    }
    exchange::set_threads(1);
}

/// A sphere of springs at rest under a small stretch relaxes to its reference: zero energy in every term.
TEST(Relax, ReturnsToAStressFreeSphere) {
    const auto topology = test::icosphere_topology(2);
    const auto sphere = meshing::icosphere(2, 3.0);
    Reference reference = reference_from_shape(*topology, sphere.vertices, {.reduced_curvature = 0});
    reference.area = meshing::area(sphere);
    reference.volume = meshing::volume(sphere);
    Parameters parameters;
    parameters.bending = {.local = 0, .area_difference = 0};
    Batch batch(topology, parameters, reference);
    auto r = sphere.vertices;
    for (Vec3d& p : r) p = {1.1 * p.x, 0.95 * p.y, 0.97 * p.z};
    batch.set_positions(0, r);
    relax(batch, {.tolerance = 1e-6});
    const auto lengths = edge_lengths(*topology, batch.positions(0));
    for (std::size_t e = 0; e < lengths.size(); ++e) EXPECT_NEAR(lengths[e], reference.edge_lengths[e], 1e-5);
}

TEST(Relax, RejectsStepsThatWouldBreakASpring) {
    Batch batch = test::rough_batch(2, 1);
    relax(batch);
    std::vector<Vec3d> load(batch.vertices(), Vec3d{0, 0, 0});
    const auto rest = batch.positions(0);
    const auto by_x = [](const Vec3d& a, const Vec3d& b) { return a.x < b.x; };
    const auto [low, high] = std::minmax_element(rest.begin(), rest.end(), by_x);
    load[static_cast<std::size_t>(low - rest.begin())].x = -20;  // 200 pN on one vertex at once
    load[static_cast<std::size_t>(high - rest.begin())].x = 20;
    relax(batch, {.largest_move = 5}, load);
    const auto lengths = edge_lengths(batch.topology(), batch.positions(0));
    double most = 0;
    for (std::size_t e = 0; e < lengths.size(); ++e)
        most = std::max(most, lengths[e] / (2.6 * batch.reference().edge_lengths[e]));
    EXPECT_LT(most, 1);
    EXPECT_GT(most, 0.8);
}

TEST(Relax, ErrorsNameTheirCause) {
    const auto message = [](auto&& call) -> std::string {
        try {
            call();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    Batch two = test::rough_batch(1, 2), one = test::rough_batch(1);
    EXPECT_NE(message([&] { relax(two); }).find("2 cells"), std::string::npos);
    EXPECT_NE(message([&] { relax(one, {}, std::vector<Vec3d>(5)); }).find("5 loads"), std::string::npos);
    EXPECT_NE(message([&] { relax(one, {.tolerance = -1}); }).find("tolerance"), std::string::npos);
    EXPECT_NE(message([&] { relax(one, {.max_iterations = 3}); }).find("after 3 iterations"),
              std::string::npos)
        << message([&] { relax(one, {.max_iterations = 3}); });
    auto far = one.positions(0);
    for (Vec3d& r : far) r = 4.0 * r;
    one.set_positions(0, far);
    EXPECT_NE(message([&] { relax(one); }).find("contour length"), std::string::npos);
}

/// Relaxes discs turned at random, every vertex moved by up to 20 % of an edge, c_0 between 0 and 10. Returns
/// the number that reached a minimum without a folded triangle; the others must name their cause.
int relaxed_random_starts(int level, int count) {
    const auto topology = test::icosphere_topology(level);
    const auto spheroid = test::reference_spheroid(level).vertices;
    const auto disc = meshing::evans_fung(meshing::icosphere(level, 1.0));
    const double reach = 0.2 * meshing::quality(disc).mean_edge;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto inside_ball = [&](auto&& self) -> Vec3d {
        const Vec3d r{uniform(random), uniform(random), uniform(random)};
        return norm(r) <= 1 ? r : self(self);
    };
    int good = 0;
    for (int k = 0; k < count; ++k) {
        const double c0 = 5 + 5 * uniform(random);
        const Vec3d axis = inside_ball(inside_ball);
        const double turn = std::sqrt(1 - dot(axis, axis));  // a unit quaternion
        auto start = disc.vertices;
        for (Vec3d& r : start) {
            const Vec3d side = 2.0 * cross(axis, r);
            r += turn * side + cross(axis, side) + reach * inside_ball(inside_ball);
        }
        Batch batch(topology, {}, reference_from_shape(*topology, spheroid, {.reduced_curvature = c0}));
        batch.set_positions(0, start);
        try {
            const RelaxResult result = relax(batch);
            EXPECT_TRUE(std::isfinite(result.energy)) << k;
            EXPECT_LE(largest_force(batch), 2e-5) << k;
            EXPECT_EQ(folded_triangle(*topology, batch.positions(0)), topology->triangles().size()) << k;
            ++good;
        } catch (const NumericalError& error) {
            const std::string text = error.what();
            EXPECT_TRUE(text.find("spring") != std::string::npos ||
                        text.find("triangle") != std::string::npos)
                << text;
        }
    }
    return good;
}

TEST(Relax, TwoHundredRandomStartsAt162Nodes) { EXPECT_EQ(relaxed_random_starts(2, 200), 200); }

TEST(ValidationRelax, TwoHundredRandomStartsAt642Nodes) { EXPECT_EQ(relaxed_random_starts(3, 200), 200); }

TEST(Relax, ForcesFarBeyondTheSpringsOrTheTrianglesNameTheCause) {
    const auto message = [](InPlaneLaw law) -> std::string {
        Batch batch = test::rough_batch(2);
        Parameters parameters;
        parameters.network.law = law;
        batch.set_parameters(parameters);
        relax(batch);
        const auto rest = batch.positions(0);
        try {
            relax(batch, {}, pulling_loads(pulled_vertices(rest), rest.size(), 1e5));  // pN
        } catch (const NumericalError& error) {
            return error.what();
        }
        return "no error";
    };
    for (const InPlaneLaw law : {InPlaneLaw::wlc, InPlaneLaw::wlc_power, InPlaneLaw::wlc_hydrostatic})
        EXPECT_NE(message(law).find("% of its contour length"), std::string::npos) << message(law);
    EXPECT_NE(message(InPlaneLaw::neo_hookean).find("is folded over"), std::string::npos)
        << message(InPlaneLaw::neo_hookean);
}

TEST(FoldedTriangle, IsFoundAndNamed) {
    const auto topology = test::icosphere_topology(2);
    auto r = meshing::icosphere(2, 1.0).vertices;
    EXPECT_EQ(folded_triangle(*topology, r), topology->triangles().size());
    // the last vertex, in the middle of an edge, is drawn beyond its ring
    const std::size_t v = r.size() - 1;
    const auto across = static_cast<std::size_t>(topology->neighbours(v)[0]);
    r[v] = r[v] + 2.5 * (r[across] - r[v]);
    const std::size_t k = folded_triangle(*topology, r);
    ASSERT_LT(k, topology->triangles().size());
    const auto& corners = topology->triangles()[k];
    EXPECT_TRUE(std::find(corners.begin(), corners.end(), static_cast<int>(v)) != corners.end());
}

TEST(Deflate, EndsAtTheVolumeAskedFor) {
    const auto spheroid = test::reference_spheroid(2);
    const auto topology = test::icosphere_topology(2);
    Batch batch(topology, {}, reference_from_shape(*topology, spheroid.vertices));
    batch.set_positions(0, spheroid.vertices);
    deflate(batch, 110);
    EXPECT_EQ(batch.reference().volume, 110);
    EXPECT_NEAR(batch.sums(0).volume, 110, 0.1);
    EXPECT_LE(largest_force(batch), 2e-5);
    EXPECT_THROW(deflate(batch, 100, {}, 0), InputError);
}

TEST(Approach, EndsUnderTheTargetWhateverTheSteps) {
    const auto topology = test::icosphere_topology(2);
    const auto disc = meshing::evans_fung(meshing::icosphere(2, 1.0));
    const Reference start = reference_from_shape(*topology, test::reference_spheroid(2).vertices);
    Reference target = start;
    target.curvature *= 0.8;
    target.total_curvature *= 1.05;
    target.volume = 95;
    double energy[2];
    for (int i = 0; i < 2; ++i) {
        Batch batch(topology, {}, start);
        batch.set_positions(0, disc.vertices);
        relax(batch);
        energy[i] = approach(batch, target, {}, 3 + 4 * i).energy;
        EXPECT_EQ(batch.reference().curvature, target.curvature);
        EXPECT_EQ(batch.reference().total_curvature, target.total_curvature);
        EXPECT_LE(largest_force(batch), 2e-5);
    }
    EXPECT_NEAR(energy[0], energy[1], 1e-6 * energy[1]);
}

}  // namespace
}  // namespace hemoflux::membrane
