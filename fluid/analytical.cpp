#include "fluid/analytical.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace hemoflux::fluid {

FlowPoint Couette::operator()(const Vec3d& x, double) const {
    return {1, {speed * (x.y - lower) / height, 0, 0}};
}

FlowPoint Poiseuille::operator()(const Vec3d& x, double) const {
    const double s = (x.y - lower) / height;
    return {1, {4 * speed * s * (1 - s), 0, 0}};
}

double TaylorGreen::decay_time() const { return 1 / (nu * (kx * kx + ky * ky)); }

FlowPoint TaylorGreen::operator()(const Vec3d& x, double t) const {
    const double u = u0 * std::exp(-t / decay_time()), r = ky / kx;
    const double p = -u * u / 4 * (r * std::cos(2 * kx * x.x) + std::cos(2 * ky * x.y) / r);
    return {1 + 3 * p / gamma,
            {-u * std::sqrt(r) * std::cos(kx * x.x) * std::sin(ky * x.y),
             u / std::sqrt(r) * std::sin(kx * x.x) * std::cos(ky * x.y), 0}};
}

double Womersley::period() const { return 2 * std::numbers::pi / omega; }

double Womersley::number() const { return half_height * std::sqrt(omega / nu); }

FlowPoint Womersley::operator()(const Vec3d& x, double t) const {
    using Complex = std::complex<double>;
    constexpr Complex i(0, 1);
    const Complex z = std::sqrt(i) * number();
    const double s = std::abs(x.y - middle) / half_height;
    // cosh(z s)/cosh(z) by decaying exponentials, which do not overflow at large Wo
    const Complex ratio = std::exp(z * (s - 1)) * (1.0 + std::exp(-2.0 * z * s)) / (1.0 + std::exp(-2.0 * z));
    const Complex u = amplitude / (i * omega) * (1.0 - ratio) * std::exp(i * (omega * t + phase));
    return {1, {u.real(), 0, 0}};
}

VelocityError velocity_error(const Flow& flow, const ExactFlow& exact, double t) {
    const auto u = flow.values(1), v = flow.values(2), w = flow.values(3);
    double error = 0, reference = 0, volume = 0, worst = 0, fastest = 0;
    for (std::size_t i = 0; i < flow.cells(); ++i) {
        const Vec3d q = exact(flow.centre(i), t).velocity;
        const Vec3d e = Vec3d{u[i], v[i], w[i]} - q;
        const double dv = flow.volume(i);
        volume += dv;
        error += dv * dot(e, e);
        reference += dv * dot(q, q);
        worst = std::max(worst, norm(e));
        fastest = std::max(fastest, norm(q));
    }
    const double relative = std::sqrt(error / reference);
    return {relative, std::sqrt(static_cast<double>(flow.cells())) * relative, worst / fastest,
            std::sqrt(reference / volume), std::sqrt(error / volume)};
}

double density_error(const Flow& flow, const ExactFlow& exact, double t) {
    const auto rho = flow.values(0);
    std::vector<double> wanted(flow.cells());
    double volume = 0, mean = 0, exact_mean = 0;
    for (std::size_t i = 0; i < flow.cells(); ++i) {
        wanted[i] = exact(flow.centre(i), t).density;
        const double dv = flow.volume(i);
        volume += dv;
        mean += dv * (rho[i] - 1);
        exact_mean += dv * (wanted[i] - 1);
    }
    double error = 0, variation = 0;
    for (std::size_t i = 0; i < flow.cells(); ++i) {
        const double q = wanted[i] - 1 - exact_mean / volume;
        const double e = rho[i] - 1 - mean / volume - q;
        error += flow.volume(i) * e * e;
        variation += flow.volume(i) * q * q;
    }
    return variation > 0 ? std::sqrt(error / variation) : NAN;
}

}  // namespace hemoflux::fluid
