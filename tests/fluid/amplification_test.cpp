// Figure 2.2: the amplification of one Runge-Kutta step (2.29) on single Fourier modes of the flow, against the
// polynomial G(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 of the eigenvalue z = lambda dt, and the region |G| <= 1.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "flows.hpp"

namespace hemoflux::fluid::test {
namespace {

using Complex = std::complex<double>;

Complex polynomial(Complex z) { return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))); }

constexpr int n = 16;
constexpr double length = 1, amplitude = 1e-7;

/// A mode exp(i k x) of density and the velocity components c along a periodic box.
struct Mode {
    int waves;  ///< wavelengths in the box
    double nu;
    Solver solver = make(nu);

    static Solver make(double nu) {
        meshing::RectilinearGrid grid;
        grid.axes = {meshing::uniform_axis(0, length, n), meshing::uniform_axis(0, length / 4, 4),
                     meshing::uniform_axis(0, length / 4, 4)};
        Patches p;
        p.fill(periodic_patch());
        SolverOptions o;
        o.nu = nu;
        return Solver(grid, p, o);
    }
    Complex wave(std::size_t cell) const {
        return std::polar(1.0, 2 * pi * waves * solver.centre(cell).x / length);
    }
    /// State 1 + amplitude Re[(rho, u, v) exp(ikx)].
    void set(const std::array<Complex, 3>& q) {
        std::array<std::vector<double>, 4> f;
        for (auto& v : f) v.resize(solver.cells());
        for (std::size_t i = 0; i < solver.cells(); ++i) {
            f[0][i] = 1 + amplitude * (q[0] * wave(i)).real();
            for (std::size_t c = 1; c < 3; ++c) f[c][i] = amplitude * (q[c] * wave(i)).real();
            f[3][i] = 0;
        }
        for (int c = 0; c < 4; ++c) solver.set_values(c, f[static_cast<std::size_t>(c)]);
    }
    /// Complex amplitude of a field in units of `amplitude`.
    Complex project(const std::vector<double>& field, double mean) const {
        Complex sum = 0;
        for (std::size_t i = 0; i < field.size(); ++i) sum += (field[i] - mean) * std::conj(wave(i));
        return 2.0 / (amplitude * static_cast<double>(field.size())) * sum;
    }
    /// Rate of change of (rho, u, v) for a mode.
    std::array<Complex, 3> rate(const std::array<Complex, 3>& q) {
        set(q);
        solver.evaluate();
        exchange::Buffer<double> device(4 * solver.cells());
        solver.read_residual(device.data());
        const auto all = device.to_host();
        std::array<Complex, 3> r;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto first = all.begin() + static_cast<std::ptrdiff_t>(c * solver.cells());
            r[c] = project({first, first + static_cast<std::ptrdiff_t>(solver.cells())}, 0);
        }
        return r;
    }
    std::array<Complex, 3> stepped(const std::array<Complex, 3>& q, double dt) {
        set(q);
        solver.step(dt);
        return {project(solver.values(0), 1), project(solver.values(1), 0), project(solver.values(2), 0)};
    }
    /// Eigenvalue of the sound waves that travel to one side, and their eigenvector.
    std::pair<Complex, std::array<Complex, 3>> sound() {
        const auto a = rate({1, 0, 0}), b = rate({0, 1, 0});
        const Complex trace = a[0] + b[1], determinant = a[0] * b[1] - a[1] * b[0];
        const Complex lambda = trace / 2.0 + std::sqrt(trace * trace / 4.0 - determinant);
        return {lambda, {b[0], lambda - a[0], 0}};
    }
};

}  // namespace

TEST(Amplification, BoundariesOfTheRegion) {
    constexpr double imaginary_limit_rk4 = 2.828;  // (2.37)
    // Where |G| = 1 on the axes, and that it is less just inside and more just outside.
    EXPECT_LT(std::abs(polynomial(-0.999 * real_limit_rk4)), 1);
    EXPECT_GT(std::abs(polynomial(-1.001 * real_limit_rk4)), 1);
    EXPECT_LT(std::abs(polynomial(Complex(0, 0.999 * imaginary_limit_rk4))), 1);
    EXPECT_GT(std::abs(polynomial(Complex(0, 1.001 * imaginary_limit_rk4))), 1);
    for (int i = 1; i <= 100; ++i)
        for (int j = 0; j <= 100; ++j)
            EXPECT_LE(std::abs(polynomial(std::polar(0.01 * i * radius_rk4, pi / 2 * (1 + 0.02 * j)))),
                      1 + 1e-12);
}

// Shear waves: real eigenvalues, nu k^2 for long waves.
TEST(Amplification, ShearWavesDecayByThePolynomial) {
    for (const int waves : {1, 3, 7}) {
        Mode mode{waves, 0.05};
        const double lambda = mode.rate({0, 0, 1})[2].real();
        const double k = 2 * pi * waves / length;
        if (waves == 1) {
            EXPECT_NEAR(lambda, -mode.nu * k * k, 0.05 * mode.nu * k * k);
        }
        EXPECT_LT(lambda, 0);
        for (const double z : {-0.3, -1.0, -1.6, -2.5, -2.78, -2.9}) {
            const Complex g = mode.stepped({0, 0, 1}, z / lambda)[2];
            EXPECT_NEAR(g.real(), polynomial(z).real(), 1e-6) << waves << " " << z;
            EXPECT_EQ(std::abs(g) > 1, z < -real_limit_rk4) << waves << " " << z;
        }
    }
}

// Sound waves: eigenvalues near the imaginary axis, damped by viscosity and by the streaming distance.
TEST(Amplification, SoundWavesTurnByThePolynomial) {
    for (const int waves : {1, 2, 4})
        for (const double nu : {1e-4, 0.01}) {
            Mode mode{waves, nu};
            const auto [lambda, vector] = mode.sound();
            const double k = 2 * pi * waves / length;
            if (waves == 1) {
                EXPECT_NEAR(std::abs(lambda.imag()), k / std::sqrt(3.0), 0.05 * k / std::sqrt(3.0));
            }
            EXPECT_LT(lambda.real(), 0);
            for (const double size : {0.2, 1.0, 2.0, 2.6, 3.2}) {
                const double dt = size / std::abs(lambda);
                const auto after = mode.stepped(vector, dt);
                const Complex expected = polynomial(lambda * dt);
                for (std::size_t c = 0; c < 2; ++c)
                    EXPECT_NEAR(std::abs(after[c] - expected * vector[c]), 0, 1e-5 * std::abs(vector[c]))
                        << waves << " " << nu << " " << size;
            }
        }
}

}  // namespace hemoflux::fluid::test
