#include "fluid/duct.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace hemoflux::fluid {
namespace {

constexpr double pi = std::numbers::pi;
/// Odd terms of the series up to here; they fall off exponentially but on the short walls.
constexpr int last_term = 401;

/// cosh(x)/cosh(y), |x| <= y, without overflow.
double cosh_ratio(double x, double y) {
    x = std::abs(x);
    return std::exp(x - y) * (1 + std::exp(-2 * x)) / (1 + std::exp(-2 * y));
}

}  // namespace

DuctFlow::DuctFlow(std::size_t axis, double drive, std::array<double, 3> lower, std::array<double, 3> length,
                   std::array<bool, 3> periodic)
    : axis_(axis), across_((axis + 1) % 3), along_((axis + 2) % 3), drive_(drive) {
    if (periodic[across_] && periodic[along_]) throw std::invalid_argument("DuctFlow: no walls");
    for (std::size_t q = 0; q < 3; ++q) middle_[q] = lower[q] + length[q] / 2;
    if (periodic[across_] || (!periodic[along_] && length[along_] < length[across_]))
        std::swap(across_, along_);
    a_ = length[across_] / 2;
    if (!periodic[along_]) b_ = length[along_] / 2;
    mean_ = drive * a_ * a_ / 3;
    rate_ = std::abs(drive) * a_;
    if (b_ > 0) {
        double fifth = 0, second = 0;
        for (int n = 1; n <= last_term; n += 2) {
            const double y = n * pi * b_ / (2 * a_);
            fifth += std::tanh(y) / std::pow(n, 5);
            second += cosh_ratio(0, y) / (n * n);
        }
        mean_ *= 1 - 192 * a_ / (std::pow(pi, 5) * b_) * fifth;
        rate_ *= 1 - 8 / (pi * pi) * second;
    }
    largest_ = std::abs(speed({middle_[0], middle_[1], middle_[2]}));
}

DuctFlow DuctFlow::round(std::size_t axis, double drive, double radius) {
    DuctFlow flow;
    flow.axis_ = axis;
    flow.across_ = (axis + 1) % 3;
    flow.along_ = (axis + 2) % 3;
    flow.drive_ = drive;
    flow.a_ = radius;
    flow.round_ = true;
    flow.mean_ = drive * radius * radius / 8;
    flow.rate_ = std::abs(drive) * radius / 2;
    flow.largest_ = std::abs(drive) * radius * radius / 4;
    return flow;
}

double DuctFlow::speed(const Vec3d& x) const {
    const double at[3] = {x.x - middle_[0], x.y - middle_[1], x.z - middle_[2]};
    const double s = at[across_];
    if (round_) return drive_ * (a_ * a_ - s * s - at[along_] * at[along_]) / 4;
    double u = (a_ * a_ - s * s) / 2;
    if (b_ > 0) {
        double sign = 1;
        for (int n = 1; n <= last_term; n += 2, sign = -sign) {
            const double k = n * pi / (2 * a_);
            u -= 16 * a_ * a_ * sign / std::pow(n * pi, 3) * cosh_ratio(k * at[along_], k * b_) *
                 std::cos(k * s);
        }
    }
    return drive_ * u;
}

}  // namespace hemoflux::fluid
