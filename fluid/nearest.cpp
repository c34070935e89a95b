#include "fluid/nearest.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hemoflux::fluid {

NearestPoint::NearestPoint(std::vector<Vec3d> points)
    : points_(std::move(points)), order_(points_.size()), axis_(points_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, points_.size());
}

void NearestPoint::build(std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    double low[3], high[3];
    for (unsigned a = 0; a < 3; ++a) {
        low[a] = std::numeric_limits<double>::infinity(), high[a] = -low[a];
        for (std::size_t i = first; i < last; ++i) {
            low[a] = std::min(low[a], component(points_[order_[i]], a));
            high[a] = std::max(high[a], component(points_[order_[i]], a));
        }
    }
    unsigned axis = 0;
    for (unsigned a = 1; a < 3; ++a)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
        return component(points_[a], axis) < component(points_[b], axis);
    });
    axis_[middle] = static_cast<unsigned char>(axis);
    build(first, middle);
    build(middle + 1, last);
}

void NearestPoint::search(std::size_t first, std::size_t last, const Vec3d& at, std::size_t& best,
                          double& distance2) const {
    if (first == last) return;
    const std::size_t middle = first + (last - first) / 2;
    const Vec3d away = points_[order_[middle]] - at;
    if (dot(away, away) < distance2) distance2 = dot(away, away), best = order_[middle];
    const double beyond = component(away, axis_[middle]);
    const auto lower = [&] { search(first, middle, at, best, distance2); };
    const auto upper = [&] { search(middle + 1, last, at, best, distance2); };
    if (beyond > 0) {
        lower();
        if (beyond * beyond < distance2) upper();
    } else {
        upper();
        if (beyond * beyond < distance2) lower();
    }
}

std::size_t NearestPoint::operator()(const Vec3d& at) const {
    std::size_t best = 0;
    double distance2 = std::numeric_limits<double>::infinity();
    search(0, points_.size(), at, best, distance2);
    return best;
}

}  // namespace hemoflux::fluid
