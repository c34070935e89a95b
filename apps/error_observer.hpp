/// How far a run is from its exact solution: norms and profiles at chosen times.
#pragma once

#include "apps/exact_flow.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/summary.hpp"
#include "apps/schedule.hpp"

namespace hemoflux::apps {

/// Compares a flow on a rectilinear grid with the exact solution of its case. Times are s.
class ErrorObserver {
  public:
    /// Throws InputError as exact_case(), and when two of the case's times fall on one step.
    ErrorObserver(const Case& c, const meshing::RectilinearGrid& grid, const Scales& scales,
                  const StepPlan& plan);

    /// The flow at t = 0 in lattice units.
    [[nodiscard]] fluid::FlowPoint at_start(const Vec3d& x) const { return exact_.flow(x, 0); }

    /// Whether step number `done` is nearest to one of the times (without times: the last step).
    [[nodiscard]] bool due(long long done) const;
    /// Takes norms and profiles.
    void observe(const fluid::Flow& flow, double time);
    /// Velocity in x in the middle of the box, computed and exact, um/s.
    [[nodiscard]] std::array<double, 2> centre(const fluid::Flow& flow, double time) const;

    /// State for a checkpoint, and back.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint);

    /// error_relative (volume-averaged, 3.21), error_total (3.22), error_largest, error_density of the last time;
    /// error_over_cycle_largest, the largest over all times of the error over the largest norm of a period.
    void report(output::Summary& summary) const;
    /// errors.csv and profile_*.csv; with pictures their plots. Returns a line to print when a plot failed.
    std::string write(const output::OutputFolder& folder, const std::string& title, bool pictures) const;

  private:
    /// A straight line of cells through the middle of the box and the velocity component shown on it.
    struct Line {
        std::size_t axis, component;
        std::vector<std::size_t> cells;
        std::vector<double> position;  ///< um
    };
    struct Observation {
        double time, clock, relative, total, largest, over_cycle, density;
    };
    [[nodiscard]] Line make_line(std::size_t axis, std::size_t component) const;
    [[nodiscard]] double largest_norm(const fluid::Flow& flow) const;
    [[nodiscard]] double exact_at(const fluid::Flow& flow, const Line& line, std::size_t i,
                                  double time) const;

    meshing::RectilinearGrid grid_;
    Scales scales_;
    ExactCase exact_;
    std::vector<long long> steps_;
    std::vector<Line> lines_;
    std::size_t centre_;
    std::vector<Observation> observations_;
    std::vector<double> profiles_;  ///< per observation and line: computed, then exact values, um/s
    double cycle_norm_ = 0;
};

}  // namespace hemoflux::apps
