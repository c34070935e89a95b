#include "fluid/vortices.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hemoflux::fluid {
namespace {

/// Of equal cells, as they lie about the centre of a symmetric flow, the last counts.
bool is_extremum(const PlaneField& psi, std::size_t i, std::size_t j) {
    const double centre = psi.at(i, j);
    bool above = true, below = true;
    for (std::size_t b = j - 1; b <= j + 1; ++b)
        for (std::size_t a = i - 1; a <= i + 1; ++a) {
            if (a == i && b == j) continue;
            const double other = psi.at(a, b);
            const bool tie = other == centre && (b < j || (b == j && a < i));
            above = above && (centre > other || tie);
            below = below && (centre < other || tie);
        }
    return above || below;
}

/// Extremum of c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2 fitted to the cell and its neighbours.
Vortex fit(const PlaneField& psi, const std::vector<double>& x, const std::vector<double>& y, std::size_t i,
           std::size_t j) {
    const double sx = x[i + 1] - x[i - 1], sy = y[j + 1] - y[j - 1];
    Eigen::Matrix<double, 9, 6> a;
    Eigen::Matrix<double, 9, 1> f;
    Eigen::Index row = 0;
    for (std::size_t m = j - 1; m <= j + 1; ++m)
        for (std::size_t l = i - 1; l <= i + 1; ++l, ++row) {
            const double u = (x[l] - x[i]) / sx, v = (y[m] - y[j]) / sy;
            a.row(row) << 1, u, v, u * u, u * v, v * v;
            f[row] = psi.at(l, m);
        }
    const Eigen::Matrix<double, 6, 1> c = a.colPivHouseholderQr().solve(f);
    Eigen::Matrix2d hessian;
    hessian << 2 * c[3], c[4], c[4], 2 * c[5];
    const Eigen::Vector2d gradient(c[1], c[2]), at = -hessian.fullPivLu().solve(gradient);
    // away from the nine cells the quadratic says nothing
    if (!(std::abs(at[0]) <= 0.5 && std::abs(at[1]) <= 0.5)) return {x[i], y[j], psi.at(i, j)};
    return {x[i] + at[0] * sx, y[j] + at[1] * sy, c[0] + gradient.dot(at) / 2};
}

}  // namespace

std::vector<Vortex> find_vortices(const PlaneField& psi, double weakest) {
    const std::vector<double> x = psi.x.centres(), y = psi.y.centres();
    std::vector<Vortex> vortices;
    for (std::size_t j = 1; j + 1 < y.size(); ++j)
        for (std::size_t i = 1; i + 1 < x.size(); ++i)
            if (is_extremum(psi, i, j)) vortices.push_back(fit(psi, x, y, i, j));
    std::sort(vortices.begin(), vortices.end(),
              [](const Vortex& a, const Vortex& b) { return std::abs(a.psi) > std::abs(b.psi); });
    while (!vortices.empty() && std::abs(vortices.back().psi) < weakest * std::abs(vortices.front().psi))
        vortices.pop_back();
    return vortices;
}

}  // namespace hemoflux::fluid
