/// When things happen in a run: numbers of steps, and events at equal intervals of strain or time.
#pragma once

#include <cmath>

namespace hemoflux::apps {

/// A run from 0 to `end` in equal steps: the wished step, shortened so that a whole number of steps fits.
struct StepPlan {
    long long steps = 0;
    double step = 0;
    /// end and wished step in the same unit, positive.
    StepPlan(double end, double wished) {
        steps = static_cast<long long>(std::ceil(end / wished - 1e-9));
        if (steps < 1) steps = 1;
        step = end / static_cast<double>(steps);
    }
    /// Position after `done` steps.
    [[nodiscard]] double at(long long done) const { return step * static_cast<double>(done); }
};

/// True when a multiple of `interval` is reached on the way from one position to another. Never for interval <= 0.
inline bool due(double from, double to, double interval) {
    if (!(interval > 0)) return false;
    const auto events = [&](double at) { return std::floor(at / interval + 1e-6); };
    return events(to) > events(from);
}

/// The same for the step that ends at step number `done`; depends on the step number only, so that a restarted run does
/// the same.
inline bool due(const StepPlan& plan, long long done, double interval) {
    return due(plan.at(done - 1), plan.at(done), interval);
}

}  // namespace hemoflux::apps
