#include "fluid/transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "exchange/error.hpp"

namespace hemoflux::fluid {
namespace {

/// Points that are averaged.
constexpr std::size_t nearest = 8;

double component(const Vec3d& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Neighbour {
    double distance2;
    std::size_t point;
    bool operator<(const Neighbour& b) const {
        return distance2 < b.distance2 || (distance2 == b.distance2 && point < b.point);
    }
};

}  // namespace

PointFlow::PointFlow(std::vector<Vec3d> points, std::vector<FlowPoint> values)
    : points_(std::move(points)), values_(std::move(values)) {
    if (points_.empty() || points_.size() != values_.size())
        throw InputError("the flow to start from",
                         fmt::format("it has {} points and {} values", points_.size(), values_.size()),
                         "give one value for every point");
    double extent[3], volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto [low, high] = std::minmax_element(
            points_.begin(), points_.end(),
            [a](const Vec3d& p, const Vec3d& q) { return component(p, a) < component(q, a); });
        low_[a] = component(*low, a);
        extent[a] = component(*high, a) - low_[a];
    }
    // A direction without extent has one bin; the others share the points evenly, about four to a bin.
    int directions = 0;
    for (const double e : extent)
        if (e > 0) volume *= e, ++directions;
    const double edge =
        directions > 0 ? std::pow(4 * volume / static_cast<double>(points_.size()), 1.0 / directions) : 1;
    for (std::size_t a = 0; a < 3; ++a) {
        bins_[a] = extent[a] > 0 ? static_cast<std::size_t>(std::clamp(extent[a] / edge, 1.0, 1024.0)) : 1;
        size_[a] = extent[a] > 0 ? extent[a] / static_cast<double>(bins_[a]) : 1;
    }
    const auto bin = [&](std::size_t p) {
        const Vec3d& x = points_[p];
        return bin_of(x.x, 0) + bins_[0] * (bin_of(x.y, 1) + bins_[1] * bin_of(x.z, 2));
    };
    first_.assign(bins_[0] * bins_[1] * bins_[2] + 1, 0);
    for (std::size_t p = 0; p < points_.size(); ++p) ++first_[bin(p) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    member_.resize(points_.size());
    std::vector<std::size_t> next = first_;
    for (std::size_t p = 0; p < points_.size(); ++p) member_[next[bin(p)]++] = p;
}

std::size_t PointFlow::bin_of(double x, std::size_t axis) const {
    const double at = (x - low_[axis]) / size_[axis];
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins_[axis] - 1)));
}

FlowPoint PointFlow::operator()(const Vec3d& x) const {
    const std::size_t at[3] = {bin_of(x.x, 0), bin_of(x.y, 1), bin_of(x.z, 2)};
    const std::size_t wanted = std::min(nearest, points_.size());
    std::vector<Neighbour> found;
    // Shells of bins around x until no unseen bin can hold a nearer point.
    for (std::size_t shell = 0;; ++shell) {
        std::size_t low[3], high[3];
        bool all = true;
        double reach = 1e300;  // distance to the nearest unseen bin
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = at[a] > shell ? at[a] - shell : 0;
            high[a] = std::min(at[a] + shell, bins_[a] - 1);
            const double offset = component(x, a) - low_[a];
            if (low[a] > 0)
                all = false, reach = std::min(reach, offset - static_cast<double>(low[a]) * size_[a]);
            if (high[a] + 1 < bins_[a])
                all = false, reach = std::min(reach, static_cast<double>(high[a] + 1) * size_[a] - offset);
        }
        for (std::size_t k = low[2]; k <= high[2]; ++k)
            for (std::size_t j = low[1]; j <= high[1]; ++j)
                for (std::size_t i = low[0]; i <= high[0]; ++i) {
                    const auto away = [&](std::size_t b, std::size_t a) {
                        return b > at[a] ? b - at[a] : at[a] - b;
                    };
                    if (std::max({away(i, 0), away(j, 1), away(k, 2)}) != shell) continue;
                    const std::size_t bin = i + bins_[0] * (j + bins_[1] * k);
                    for (std::size_t m = first_[bin]; m < first_[bin + 1]; ++m) {
                        const Vec3d d = points_[member_[m]] - x;
                        found.push_back({dot(d, d), member_[m]});
                    }
                }
        if (found.size() > wanted) {
            std::nth_element(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(wanted), found.end());
            found.resize(wanted);
        }
        if (all) break;
        const double farthest =
            found.size() < wanted ? 1e300 : std::max_element(found.begin(), found.end())->distance2;
        if (reach > 0 && farthest <= reach * reach) break;
    }
    std::sort(found.begin(), found.end());
    if (found[0].distance2 == 0) return values_[found[0].point];
    FlowPoint mean{0, {0, 0, 0}};
    double total = 0;
    for (const Neighbour& n : found) {
        const double weight = found[0].distance2 / n.distance2;
        const FlowPoint& v = values_[n.point];
        mean.density += weight * v.density;
        mean.velocity += weight * v.velocity;
        total += weight;
    }
    return {mean.density / total, (1 / total) * mean.velocity};
}

PointFlow sample(const Flow& flow) {
    std::array<std::vector<double>, 4> q;
    for (int c = 0; c < 4; ++c) q[static_cast<std::size_t>(c)] = flow.values(c);
    std::vector<Vec3d> points;
    std::vector<FlowPoint> values;
    for (std::size_t i = 0; i < flow.cells(); ++i) {
        points.push_back(flow.centre(i));
        values.push_back({q[0][i], {q[1][i], q[2][i], q[3][i]}});
    }
    return PointFlow(std::move(points), std::move(values));
}

void carry_over(const PointFlow& from, Flow& to) {
    to.initialise([&from](const Vec3d& x) { return from(x); });
}

}  // namespace hemoflux::fluid
