#include "coupling/constraint_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "exchange/backend.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

using Field = std::function<Vec3d(const Vec3d&)>;

/// A surface and the velocity of its nodes.
struct Moving {
    meshing::SurfaceMesh mesh;
    std::vector<Vec3d> u;

    Moving(meshing::SurfaceMesh surface, const Field& velocity) : mesh(std::move(surface)) {
        for (const Vec3d& r : mesh.vertices) u.push_back(velocity(r));
    }
    [[nodiscard]] double volume_rate() const {
        double rate = 0;
        for (const auto& t : mesh.triangles) {
            const auto [a, b, c] = corners(t);
            rate += (dot(u[index(t[0])], cross(b, c)) + dot(u[index(t[1])], cross(c, a)) +
                     dot(u[index(t[2])], cross(a, b))) /
                    6;
        }
        return rate;
    }
    /// dA_k/dt of all triangles by central differences.
    [[nodiscard]] std::vector<double> area_rates() const {
        constexpr double step = 1e-6;
        std::vector<double> rates;
        for (const auto& t : mesh.triangles) {
            const auto area = [&](double s) {
                const auto at = [&](int v) { return mesh.vertices[index(v)] + s * u[index(v)]; };
                return 0.5 * norm(cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])));
            };
            rates.push_back((area(step) - area(-step)) / (2 * step));
        }
        return rates;
    }
    /// sum_k (dA_k/dt)^2 / A_k: what the local penalty has to do with.
    [[nodiscard]] double work() const {
        double sum = 0;
        const auto rates = area_rates();
        for (std::size_t k = 0; k < rates.size(); ++k) {
            const auto [a, b, c] = corners(mesh.triangles[k]);
            sum += rates[k] * rates[k] / (0.5 * norm(cross(b - a, c - a)));
        }
        return sum;
    }
    [[nodiscard]] double size() const {
        double sum = 0;
        for (const Vec3d& v : u) sum += dot(v, v);
        return std::sqrt(sum);
    }
    [[nodiscard]] double distance(const Moving& other) const {
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i) sum += dot(u[i] - other.u[i], u[i] - other.u[i]);
        return std::sqrt(sum);
    }
    /// The same after damping, as cell number `cell` of `cells` equal ones.
    [[nodiscard]] Moving damped(double strength, std::size_t cells = 1, std::size_t cell = 0) const {
        const std::size_t n = mesh.vertices.size(), stride = n + 3;
        std::vector<double> x[3], v[3];
        for (std::size_t c = 0; c < cells; ++c)
            for (std::size_t i = 0; i < stride; ++i) {
                const Vec3d r = mesh.vertices[i < n ? i : 0], w = i < n ? u[i] : Vec3d{7, 7, 7};
                x[0].push_back(r.x + 20 * static_cast<double>(c)), x[1].push_back(r.y), x[2].push_back(r.z);
                v[0].push_back(w.x), v[1].push_back(w.y), v[2].push_back(w.z);
            }
        const exchange::Buffer<double> bx(x[0]), by(x[1]), bz(x[2]);
        exchange::Buffer<double> bu(v[0]), bv(v[1]), bw(v[2]);
        ConstraintDamping(mesh.triangles, stride, cells, strength)
            .apply(bx.data(), by.data(), bz.data(), {bu.data(), bv.data(), bw.data()});
        const auto hu = bu.to_host(), hv = bv.to_host(), hw = bw.to_host();
        Moving result = *this;
        for (std::size_t i = 0; i < n; ++i)
            result.u[i] = {hu[cell * stride + i], hv[cell * stride + i], hw[cell * stride + i]};
        EXPECT_EQ(hu[cell * stride + n + 2], hu[cell * stride]);  // padding goes with the first node
        return result;
    }

  private:
    static std::size_t index(int v) { return static_cast<std::size_t>(v); }
    [[nodiscard]] std::array<Vec3d, 3> corners(const std::array<int, 3>& t) const {
        return {mesh.vertices[index(t[0])], mesh.vertices[index(t[1])], mesh.vertices[index(t[2])]};
    }
};

meshing::SurfaceMesh disc() { return meshing::evans_fung(meshing::icosphere(3, 1.0)); }

Field noise() {
    return [engine = std::mt19937(5),
            range = std::uniform_real_distribution<double>(-1, 1)](const Vec3d&) mutable {
        return Vec3d{range(engine), range(engine), range(engine)};
    };
}

}  // namespace

TEST(ConstraintDamping, RigidMotionsPassThrough) {
    const Vec3d turn{0.3, -1, 0.7};
    const Moving m(disc(), [&](const Vec3d& r) { return Vec3d{1, 2, -3} + cross(turn, r); });
    EXPECT_LT(m.distance(m.damped(1)), 1e-12 * m.size());
}

// Growth in all directions changes the volume and all areas: strength 1 leaves a tenth of the first at most.
TEST(ConstraintDamping, SlowsVolumeAndArea) {
    const Moving m(disc(), [](const Vec3d& r) { return r; });
    const Moving d = m.damped(1);
    const auto total = [](const Moving& one) {
        double sum = 0;
        for (const double rate : one.area_rates()) sum += rate;
        return sum;
    };
    EXPECT_LT(std::abs(d.volume_rate()), 0.101 * m.volume_rate());
    EXPECT_LT(std::abs(total(d)), 0.101 * total(m));
    EXPECT_GT(m.volume_rate(), 0);
    // A third of the strength: a share of 1/(1 + 3).
    EXPECT_NEAR(m.damped(1.0 / 3).volume_rate() / m.volume_rate(), 0.25, 0.02);
}

// On a sphere both gradients are parallel.
TEST(ConstraintDamping, TakesSpheres) {
    const Moving m(meshing::icosphere(2, 3.0), [](const Vec3d& r) { return r; });
    const double left = m.damped(1).volume_rate() / m.volume_rate();
    EXPECT_GT(left, 0.05);
    EXPECT_LT(left, 0.101);
}

// What differs from node to node is damped, what a flow does to the cell as a whole is not.
TEST(ConstraintDamping, DampsNodeToNodeOnly) {
    const Moving rough(disc(), noise());
    EXPECT_LT(rough.damped(1).work(), 0.15 * rough.work());
    const Moving shear(disc(), [](const Vec3d& r) { return Vec3d{r.y, 0, 0}; });
    EXPECT_LT(shear.damped(1).work(), shear.work());
    EXPECT_LT(shear.distance(shear.damped(1)), 0.1 * shear.size());
}

TEST(ConstraintDamping, VanishesWithItsStrength) {
    const Moving rough(disc(), noise());
    const double one = rough.distance(rough.damped(1e-4)), half = rough.distance(rough.damped(0.5e-4));
    EXPECT_LT(one, 1e-3 * rough.size());
    EXPECT_NEAR(one / half, 2, 0.01);
}

TEST(ConstraintDamping, EveryCellAloneAndAnyNumberOfThreads) {
    const Moving m(disc(), noise());
    std::vector<Moving> results, of_many;
    for (const int threads : {1, 2, 3}) {
        exchange::set_threads(threads);
        results.push_back(m.damped(1));
        results.push_back(m.damped(1, 3, 0));
        of_many.push_back(m.damped(1, 20, 13));  // taken one by one
    }
    exchange::set_threads(0);
    for (const Moving& r : results) EXPECT_EQ(r.distance(results.front()), 0);
    for (const Moving& r : of_many) EXPECT_EQ(r.distance(of_many.front()), 0);
    EXPECT_LT(m.damped(1, 3, 2).distance(results.front()), 1e-9 * m.size());
    EXPECT_LT(of_many.front().distance(results.front()), 1e-9 * m.size());
}

}  // namespace hemoflux::coupling
