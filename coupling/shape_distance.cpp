#include "coupling/shape_distance.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/surface_gap.hpp"

namespace hemoflux::coupling {

ShapeDistance::ShapeDistance(const std::vector<Vec3d>& positions,
                             const std::vector<std::array<int, 3>>& triangles, double margin, double spacing)
    : margin_(margin), spacing_(spacing) {
    Vec3d low = positions.front(), high = low;
    for (const Vec3d& r : positions) {
        low = {std::min(low.x, r.x), std::min(low.y, r.y), std::min(low.z, r.z)};
        high = {std::max(high.x, r.x), std::max(high.y, r.y), std::max(high.z, r.z)};
    }
    const double around = margin + spacing;
    lower_ = low - Vec3d{around, around, around};
    const Vec3d size = high - low + Vec3d{2 * around, 2 * around, 2 * around};
    const double lengths[3] = {size.x, size.y, size.z};
    for (int q = 0; q < 3; ++q) n_[q] = static_cast<std::size_t>(std::ceil(lengths[q] / spacing)) + 1;
    std::vector<std::vector<std::array<int, 3>>> rings(positions.size());
    for (const auto& t : triangles)
        for (std::size_t c = 0; c < 3; ++c)
            rings[static_cast<std::size_t>(t[c])].push_back({t[c], t[(c + 1) % 3], t[(c + 2) % 3]});
    const auto at = [&](int v) { return positions[static_cast<std::size_t>(v)]; };
    value_.resize(n_[0] * n_[1] * n_[2]);
    for (std::size_t k = 0; k < n_[2]; ++k)
        for (std::size_t j = 0; j < n_[1]; ++j)
            for (std::size_t i = 0; i < n_[0]; ++i) {
                const Vec3d p = lower_ + spacing * Vec3d{static_cast<double>(i), static_cast<double>(j),
                                                         static_cast<double>(k)};
                std::size_t nearest = 0;
                double least = 1e300;
                for (std::size_t v = 0; v < positions.size(); ++v) {
                    const Vec3d d = positions[v] - p;
                    if (dot(d, d) < least) least = dot(d, d), nearest = v;
                }
                RingDistance ring(p);
                for (const auto& t : rings[nearest]) ring.add(at(t[0]), at(t[1]), at(t[2]));
                value_[index(i, j, k)] = ring.value();
            }
}

double ShapeDistance::operator()(const Vec3d& r) const {
    const double x[3] = {(r.x - lower_.x) / spacing_, (r.y - lower_.y) / spacing_,
                         (r.z - lower_.z) / spacing_};
    std::size_t at[3];
    double s[3];
    for (int q = 0; q < 3; ++q) {
        if (!(x[q] >= 0 && x[q] < static_cast<double>(n_[q] - 1))) return margin_;
        at[q] = static_cast<std::size_t>(x[q]);
        s[q] = x[q] - static_cast<double>(at[q]);
    }
    double sum = 0;
    for (std::size_t c = 0; c < 8; ++c) {
        const std::size_t a = c & 1, b = c >> 1 & 1, d = c >> 2;
        sum += (a ? s[0] : 1 - s[0]) * (b ? s[1] : 1 - s[1]) * (d ? s[2] : 1 - s[2]) *
               value_[index(at[0] + a, at[1] + b, at[2] + d)];
    }
    return sum;
}

}  // namespace hemoflux::coupling
