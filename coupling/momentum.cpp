#include "coupling/momentum.hpp"

namespace hemoflux::coupling {

MomentumBalance::Fields MomentumBalance::read() const {
    Fields q;
    for (int c = 0; c < 4; ++c) q[static_cast<std::size_t>(c)] = fluid_.values(c);
    return q;
}

void MomentumBalance::write(const Fields& q) {
    for (int c = 0; c < 4; ++c) fluid_.set_values(c, q[static_cast<std::size_t>(c)]);
}

void MomentumBalance::before() { old_ = read(); }

MomentumStep MomentumBalance::after(double dt) {
    const Fields now = read();
    write(old_);
    MomentumStep step;
    step.flux = fluid_.border_momentum();
    write(now);

    std::array<std::vector<double>, 3> gain;
    double gained[3] = {0, 0, 0}, volume = 0;
    for (std::size_t i = 0; i < now[0].size(); ++i) {
        const double v = fluid_.volume(i);
        volume += v;
        for (std::size_t c = 0; c < 3; ++c) {
            gain[c].push_back(now[0][i] * now[c + 1][i] - old_[0][i] * old_[c + 1][i]);
            gained[c] += v * gain[c].back();
        }
    }
    step.gained = {gained[0], gained[1], gained[2]};
    const NodalForce nodes = loop_.nodal_force();
    step.nodes = dt * nodes.sum;
    const auto& f = fluid_.options().uniform_force;
    step.force = dt * volume * Vec3d{f[0], f[1], f[2]};
    step.gross = dt * nodes.gross + norm(step.force);
    step.sides = fluid_.side_impulse(gain);
    for (const Vec3d& flux : step.flux) step.sides -= dt * flux;
    return step;
}

}  // namespace hemoflux::coupling
