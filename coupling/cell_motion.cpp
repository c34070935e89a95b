#include "coupling/cell_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hemoflux::coupling {
namespace {

/// The angles (degrees) without jumps, where they are known up to multiples of `turn`.
std::vector<double> unwrapped(std::vector<double> angle, double turn) {
    for (std::size_t i = 1; i < angle.size(); ++i)
        angle[i] = angle[i - 1] + std::remainder(angle[i] - angle[i - 1], turn);
    return angle;
}

/// When the angle has first gained 0, 1, 2 ... half turns in the direction in which it ends up.
std::vector<double> half_turns(const std::vector<double>& strain, const std::vector<double>& angle) {
    std::vector<double> times{strain.front()};
    const double sign = angle.back() >= angle.front() ? 1 : -1;
    for (std::size_t i = 1; i < angle.size(); ++i) {
        const double before = sign * (angle[i - 1] - angle.front()), now = sign * (angle[i] - angle.front());
        for (double next = 180.0 * static_cast<double>(times.size()); now >= next;
             next = 180.0 * static_cast<double>(times.size()))
            times.push_back(strain[i - 1] + (strain[i] - strain[i - 1]) *
                                                std::clamp((next - before) / (now - before), 0.0, 1.0));
    }
    return times;
}

/// Of a full turn; NaN without a half turn.
double period(const std::vector<double>& times) {
    return times.size() < 2 ? NAN
                            : 2 * (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

/// Half of peak to peak between each two of these times, the mean over them; over all records without two.
double amplitude(const std::vector<double>& strain, const std::vector<double>& angle,
                 const std::vector<double>& times) {
    const auto over = [&](double from, double to) {
        double low = INFINITY, high = -INFINITY;
        for (std::size_t i = 0; i < strain.size(); ++i)
            if (strain[i] >= from && strain[i] <= to) {
                low = std::min(low, angle[i]);
                high = std::max(high, angle[i]);
            }
        return high >= low ? (high - low) / 2 : 0;
    };
    if (times.size() < 2) return over(strain.front(), strain.back());
    std::vector<double> each;
    for (std::size_t i = 1; i < times.size(); ++i) each.push_back(over(times[i - 1], times[i]));
    return mean(each);
}

/// Mean strain between upward passages of the mean; a passage counts once the angle has been a quarter of the
/// amplitude below it, so that noise is none.
double swing_period(const std::vector<double>& strain, const std::vector<double>& angle, double middle,
                    double amplitude) {
    std::vector<double> times;
    bool below = false;
    for (std::size_t i = 1; i < angle.size(); ++i) {
        below = below || angle[i - 1] < middle - 0.25 * amplitude;
        if (!below || angle[i] < middle) continue;
        times.push_back(strain[i]);
        below = false;
    }
    return times.size() < 2 ? NAN : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

}  // namespace

const char* name_of(MotionMode mode) {
    switch (mode) {
        case MotionMode::tumbling:
            return "tumbling";
        case MotionMode::intermittent:
            return "intermittent";
        case MotionMode::swinging:
            return "swinging";
        case MotionMode::tank_treading:
            return "tank treading";
        case MotionMode::steady:
            break;
    }
    return "steady";
}

MotionHistory MotionHistory::window(double from, double to) const {
    MotionHistory part;
    for (std::size_t i = 0; i < strain.size(); ++i) {
        if (!(strain[i] >= from - 1e-9 && strain[i] <= to + 1e-9)) continue;
        part.strain.push_back(strain[i]);
        part.inclination_deg.push_back(inclination_deg[i]);
        part.material_deg.push_back(material_deg[i]);
    }
    return part;
}

CellMotion classify(const MotionHistory& h) {
    if (h.inclination_deg.size() != h.strain.size() || h.material_deg.size() != h.strain.size())
        throw std::length_error("classify: columns of different lengths");
    CellMotion m;
    m.tumbling_period = m.tank_treading_period = m.swing_period = m.inclination_deg = m.amplitude_deg = NAN;
    if (h.strain.size() < 2) return m;
    const std::vector<double> alpha = unwrapped(h.inclination_deg, 180);
    std::vector<double> phi = unwrapped(h.material_deg, 360);
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = alpha[i] - phi[i];

    const std::vector<double> flips = half_turns(h.strain, alpha), treads = half_turns(h.strain, phi);
    m.flips = static_cast<int>(flips.size()) - 1;
    m.treads = static_cast<int>(treads.size()) - 1;
    m.tumbling_period = period(flips);
    m.tank_treading_period = period(treads);
    if (m.flips > 0) {
        m.mode = m.treads > 0 ? MotionMode::intermittent : MotionMode::tumbling;
        return m;
    }
    m.inclination_deg = mean(alpha);
    m.amplitude_deg = amplitude(h.strain, alpha, treads);
    m.swing_period = swing_period(h.strain, alpha, m.inclination_deg, m.amplitude_deg);
    if (m.treads > 0)
        m.mode = m.amplitude_deg > swinging_threshold_deg ? MotionMode::swinging : MotionMode::tank_treading;
    return m;
}

}  // namespace hemoflux::coupling
