/// The clock of a coupled run, in strain: equal steps, or with time.adaptive steps that follow the error of the nodes' motion
/// (coupling/step_control.hpp) and meet the ends of the output's intervals and of the run exactly.
#pragma once

#include <optional>
#include <string>

#include "apps/case.hpp"
#include "apps/coupled_run.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/schedule.hpp"
#include "coupling/step_control.hpp"

namespace hemoflux::apps {

/// Intervals of the output in strain; 0: none.
struct OutputIntervals {
    double frame = 0, row = 0, checkpoint = 0;
    /// clock: strain units per second.
    OutputIntervals(const OutputInput& out, double clock);
};

/// Position error per strain unit over R0 that time.tolerance = "auto" allows.
inline constexpr double default_tolerance = 1e-3;

/// Advances the system and knows where it stands.
class CoupledClock {
  public:
    /// At the start of the run. Cells and bodies must have been added to the system, which must outlive the clock.
    CoupledClock(const Case& c, CoupledSystem& system);

    /// Steps done, where they have led, and where the run ends.
    [[nodiscard]] long long done() const { return done_; }
    [[nodiscard]] double now() const { return position(0); }
    [[nodiscard]] double end() const;
    [[nodiscard]] bool ended() const;
    /// Where the step to come leads, whether it is the last, and whether it reaches a multiple of an interval.
    [[nodiscard]] double next() const { return position(1); }
    [[nodiscard]] bool last() const;
    [[nodiscard]] bool reaches(double interval) const { return due(now(), next(), interval); }
    [[nodiscard]] const OutputIntervals& intervals() const { return intervals_; }

    /// One step of the system. NumericalError of the system's; also when the tolerance asks for steps that are too short.
    void step();
    /// Length of the last step in strain; before the first that of an equal one.
    [[nodiscard]] double taken() const { return taken_; }
    /// The run ends where it stands.
    void end_here();

    /// Of an adaptive run: how its steps went, for the log. Empty for equal steps.
    [[nodiscard]] std::string report() const;

    /// State for a checkpoint, and back to where `done` steps have led; equal steps store nothing.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint, long long done);

  private:
    /// The position some steps (0 or 1) from now.
    [[nodiscard]] double position(long long steps) const;
    [[nodiscard]] double milestone_after(double strain) const;
    void start_leg(double from);
    void adapt();

    CoupledSystem& system_;
    OutputIntervals intervals_;
    std::optional<coupling::StepControl> control_;  // in strain; none for equal steps
    long long done_ = 0, leg_done_ = 0;
    double end_, error_per_change_, taken_;
    double from_ = 0, to_ = 0;  // of the leg, whose steps are equal
    StepPlan leg_;
    // for the report
    double shortest_ = 0, longest_ = 0, largest_error_ = 0;
    long long changes_ = 0;
};

}  // namespace hemoflux::apps
