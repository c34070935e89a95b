#include "coupling/body_motion.hpp"

#include <cmath>
#include <utility>

namespace hemoflux::coupling {
namespace {

template <std::size_t N>
using System = std::array<std::array<double, N + 1>, N>;

/// Solves the N x N system whose last column is the right-hand side, by elimination with row exchange.
template <std::size_t N>
std::array<double, N> solve(System<N> a) {
    for (std::size_t p = 0; p < N; ++p) {
        std::size_t best = p;
        for (std::size_t r = p + 1; r < N; ++r)
            if (std::abs(a[r][p]) > std::abs(a[best][p])) best = r;
        std::swap(a[p], a[best]);
        for (std::size_t r = p + 1; r < N; ++r) {
            const double factor = a[r][p] / a[p][p];
            for (std::size_t c = p; c <= N; ++c) a[r][c] -= factor * a[p][c];
        }
    }
    std::array<double, N> x{};
    for (std::size_t p = N; p-- > 0;) {
        double sum = a[p][N];
        for (std::size_t c = p + 1; c < N; ++c) sum -= a[p][c] * x[c];
        x[p] = sum / a[p][p];
    }
    return x;
}

using Block = double[3][3];

/// v x as a matrix.
void cross_matrix(const Vec3d& v, double sign, Block& m) {
    const Block values = {{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = sign * values[i][j];
}

/// sum K (r^2 1 - r r^T) + I_e / dt.
void rotational_block(const NodeSums& s, const Matrix3& inertia, double dt, Block& m) {
    const double trace = s.rr[0] + s.rr[1] + s.rr[2];
    const Block rr = {{s.rr[0], s.rr[3], s.rr[5]}, {s.rr[3], s.rr[1], s.rr[4]}, {s.rr[5], s.rr[4], s.rr[2]}};
    for (int i = 0; i < 3; ++i) {
        const double own[3] = {inertia.row[i].x, inertia.row[i].y, inertia.row[i].z};
        for (int j = 0; j < 3; ++j) m[i][j] = (i == j ? trace : 0) - rr[i][j] + own[j] / dt;
    }
}

}  // namespace

Matrix3 rotation(const std::array<double, 4>& q) {
    const auto [w, x, y, z] = q;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
             {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
             {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

void advance(BodyState& state, double dt) {
    state.centre += dt * state.velocity;
    const double speed = norm(state.angular_velocity), half = 0.5 * speed * dt;
    if (speed == 0) return;
    const Vec3d v = (std::sin(half) / speed) * state.angular_velocity;
    const double w = std::cos(half);
    const auto [qw, qx, qy, qz] = state.orientation;
    const Vec3d q{qx, qy, qz}, turned = w * q + qw * v + cross(v, q);
    std::array<double, 4> r{w * qw - dot(v, q), turned.x, turned.y, turned.z};
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    for (double& c : r) c /= length;
    state.orientation = r;
}

BodyVelocity balance(BodyFreedom freedom, const BodyState& before, const NodeSums& s, const BodyLoad& load,
                     double dt) {
    if (freedom == BodyFreedom::prescribed) return {before.velocity, before.angular_velocity};
    Block turn, arm;
    rotational_block(s, load.excess_inertia, dt, turn);
    cross_matrix(s.gain_arm, 1, arm);
    const Vec3d& spin = before.angular_velocity;
    const Vec3d own = load.excess_inertia * spin;
    const Vec3d torque = load.torque + (1 / dt) * own - cross(spin, own) - s.torque + s.gain_moment;
    if (freedom == BodyFreedom::torque_free) {
        const Vec3d right = torque - cross(s.gain_arm, before.velocity);
        const double rhs[3] = {right.x, right.y, right.z};
        System<3> a{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) a[i][j] = turn[i][j];
            a[i][3] = rhs[i];
        }
        const auto x = solve<3>(a);
        return {before.velocity, {x[0], x[1], x[2]}};
    }
    const Vec3d force = load.force + (load.excess_mass / dt) * before.velocity - s.force + s.gain_velocity;
    const double rhs[6] = {force.x, force.y, force.z, torque.x, torque.y, torque.z};
    System<6> a{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            a[i][j] = i == j ? load.excess_mass / dt + s.gain : 0;
            a[i][j + 3] = -arm[i][j];
            a[i + 3][j] = arm[i][j];
            a[i + 3][j + 3] = turn[i][j];
        }
        a[i][6] = rhs[i];
        a[i + 3][6] = rhs[i + 3];
    }
    const auto x = solve<6>(a);
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

}  // namespace hemoflux::coupling
