/// The line on the terminal that shows how far a run is.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace hemoflux::output {

/// What a progress line shows.
struct ProgressState {
    long long step = 0;
    double position = 0;  ///< where the run is, in the unit of Progress::unit (strain, time, iterations)
    double cell_residuals = 0;  ///< grid cells times residual evaluations since the run began
};

/// A line that is rewritten in place on standard error at most five times a second, with step, position, the
/// time left and grid-cell residuals per second. Silent when standard error is not a terminal or quiet is
/// set.
class Progress {
  public:
    /// From position begin (not 0 after a restart) to end, both in unit ("strain", "s", ...).
    Progress(double begin, double end, std::string unit, bool quiet);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// Clears the line.
    ~Progress() { finish(); }

    /// Call after every step; cheap when it is not yet time to draw.
    void update(const ProgressState& state);
    /// Clears the line, so that other text can follow.
    void finish();

    /// The line for a state after this many seconds of running; "--" where nothing can be said yet.
    [[nodiscard]] std::string line(const ProgressState& state, double seconds) const;

  private:
    using Clock = std::chrono::steady_clock;
    double begin_, end_;
    std::string unit_;
    bool shown_, drawn_ = false;
    Clock::time_point start_, next_;
};

/// A duration for people: "8 s", "3 min 05 s", "2 h 07 min"; "--" when not finite or negative.
std::string duration(double seconds);

}  // namespace hemoflux::output
