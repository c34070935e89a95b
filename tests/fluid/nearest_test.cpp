#include "fluid/nearest.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hemoflux::fluid {
namespace {

TEST(NearestPoint, AgreesWithTryingAll) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto point = [&] { return Vec3d{any(random), 0.1 * any(random), any(random) > 0 ? 1.0 : 0.5}; };
    std::vector<Vec3d> points;
    for (int i = 0; i < 300; ++i) points.push_back(point());
    const NearestPoint nearest(points);
    for (int i = 0; i < 500; ++i) {
        const Vec3d at = point();
        double best = 1e300;
        for (const Vec3d& p : points) best = std::min(best, norm(p - at));
        EXPECT_EQ(norm(points[nearest(at)] - at), best);
    }
}

TEST(NearestPoint, FindsThePointsThemselves) {
    const std::vector<Vec3d> points{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}};
    const NearestPoint nearest(points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(nearest(points[i]), i);
}

}  // namespace
}  // namespace hemoflux::fluid
