/// What a run with several cells, or of cells in a channel, shows as a whole: speeds of cells and fluid, apparent
/// viscosity, the smallest gap between cells, the balance of momentum.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/coupled_run.hpp"
#include "apps/output/checkpoint.hpp"
#include "coupling/momentum.hpp"
#include "fluid/duct.hpp"

namespace hemoflux::apps {

/// Follows all cells of a suspension together.
class SuspensionObserver {
  public:
    /// Whether a case has anything to show.
    static bool wanted(const Case& c);

    /// `system` has its cells and must outlive it.
    SuspensionObserver(const Case& c, CoupledSystem& system);

    /// Names of the columns in history.csv: cell_speed_um_s and flow_speed_um_s (means along the flow), in channels and
    /// sheared boxes relative_viscosity (undisturbed over actual flow rate; stress at the walls over mu G), with several
    /// cells smallest_gap_um (as far as it is looked for), and momentum_error (MomentumStep::error, not for Runge-Kutta).
    [[nodiscard]] std::vector<std::string> columns() const;

    /// Call before the step that ends at a record.
    void before_step();
    /// Values of columns() now; `step`: length of the step since before_step(), 0 when there was none.
    std::vector<double> observe(double strain, double step);

    /// Means over the strain window, the smallest gap and the largest momentum error of the run, and the haematocrits of
    /// the box and, in a channel, of what flows out.
    [[nodiscard]] std::map<std::string, double> observables(double from, double to) const;

    /// State for a checkpoint, and back.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint);

  private:
    [[nodiscard]] double mean_cell_position() const;
    [[nodiscard]] double mean_flow() const;
    [[nodiscard]] double relative_viscosity(double flow, const std::array<Vec3d, 6>& flux) const;

    CoupledSystem& system_;
    std::optional<coupling::MomentumBalance> balance_;  ///< in a box, with one force a step
    std::optional<fluid::DuctFlow> channel_;
    std::size_t axis_ = 0;
    bool sheared_ = false, gaps_ = false;
    double rate_, haematocrit_ = 0;
    double last_strain_ = 0, last_position_ = 0;
    std::vector<double> strain_, records_;  ///< records: columns() side by side
};

}  // namespace hemoflux::apps
