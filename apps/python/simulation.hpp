/// A case that a caller advances as far as it likes between two looks at the fields.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/cell_observer.hpp"
#include "apps/coupled_run.hpp"
#include "apps/fluid_system.hpp"
#include "apps/output/checkpoint.hpp"

namespace hemoflux::python {

/// A coupled or fluid case in memory; nothing is written. Lengths in um, times in s, velocities in um/s, densities in
/// kg/m^3, forces in pN.
class Simulation {
  public:
    /// Sets the case up at t = 0; cells are relaxed, which may take a while. Throws InputError (also for a case of kind
    /// membrane), NumericalError, FileError.
    explicit Simulation(const apps::Case& c) : Simulation(c, nullptr) {}
    /// The state of the last checkpoint in the output folder of a run. InputError when it is of another version.
    static std::unique_ptr<Simulation> from_folder(const std::filesystem::path& folder);
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Advances by this many steps and looks for what is wrong. Throws NumericalError; InputError when the case is
    /// steady and has no time.
    void advance(long long steps);

    /// The case.
    [[nodiscard]] const apps::Case& input() const { return case_; }
    /// Steps done since t = 0.
    [[nodiscard]] long long done() const { return done_; }
    /// Steps from 0 to the end that the case names.
    [[nodiscard]] long long planned() const { return plan().steps; }
    /// Time, s.
    [[nodiscard]] double time_s() const;
    /// Shear rate times time; NaN where the case has no shear rate and no cells.
    [[nodiscard]] double strain() const;

    /// Cells of the fluid along z, y, x; on a mesh their number alone.
    [[nodiscard]] std::vector<long long> shape() const;
    /// Density and velocity of every cell of the fluid.
    [[nodiscard]] std::vector<double> density() const;
    [[nodiscard]] std::vector<Vec3d> velocity() const;
    /// Centres of the fluid's cells.
    [[nodiscard]] std::vector<Vec3d> centres() const;

    /// Number of membrane cells.
    [[nodiscard]] std::size_t cells() const { return coupled_ ? coupled_->cells->cells() : 0; }
    /// InputError when there is no such cell.
    [[nodiscard]] std::vector<Vec3d> nodes(std::size_t cell) const;
    /// Forces of the membrane on its nodes as they are now.
    [[nodiscard]] std::vector<Vec3d> forces(std::size_t cell);
    [[nodiscard]] const std::vector<meshing::Triangle>& triangles(std::size_t cell) const;

    /// Names and values of the observables, as in history.csv; each call to observe() adds a row.
    [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
    const std::vector<double>& observe();
    [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }

  private:
    Simulation(const apps::Case& c, const output::Checkpoint* checkpoint);
    void load(const output::Checkpoint& checkpoint);
    void check_fluid();
    [[nodiscard]] const membrane::Batch& batch(std::size_t cell) const;
    [[nodiscard]] const apps::StepPlan& plan() const { return coupled_ ? coupled_->plan : fluid_->plan; }
    [[nodiscard]] const apps::Scales& scales() const { return coupled_ ? coupled_->scales : fluid_->scales; }
    [[nodiscard]] fluid::Flow& flow() const;

    const apps::Case case_;  // before the systems, which refer to it
    std::optional<apps::CoupledSystem> coupled_;
    std::optional<apps::FluidSystem> fluid_;
    std::optional<apps::CellObserver> observer_;
    long long done_ = 0;
    std::vector<std::string> columns_;
    std::vector<std::vector<double>> rows_;
};

}  // namespace hemoflux::python
