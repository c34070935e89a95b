/// Diagnostics of the cells of a coupled run: one record per cell and time, and what a whole run shows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/output/checkpoint.hpp"
#include "coupling/cell_motion.hpp"
#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::apps {

/// Names of one cell's columns in history.csv, without the "c." in front.
const std::vector<std::string>& cell_columns();

/// Follows the cells of a batch.
class CellObserver {
  public:
    /// Takes volume, area and centroid of every cell now as those at t = 0, and the angles of its vertices as those that
    /// tell how far its membrane has turned (membrane_turn).
    explicit CellObserver(const membrane::Batch& cells);

    /// Values of cell_columns() for every cell in turn, as the cells are now (forces are computed for the
    /// energies).
    std::vector<double> observe(membrane::Batch& cells, double strain);

    /// Observables over the strain window [from, to]; names carry their unit. For several cells the mean over
    /// cells.
    [[nodiscard]] std::map<std::string, double> observables(double from, double to) const;

    /// The motion of one cell over the window.
    [[nodiscard]] coupling::CellMotion motion(std::size_t cell, double from, double to) const;
    /// Its name under "mode" (of several cells "CELL.mode"); a sheared cell that has not done half a turn is called steady
    /// only where there was time for one.
    [[nodiscard]] std::map<std::string, std::string> modes(double from, double to, bool sheared) const;

    /// "axial_diameter_um" and "transverse_diameter_um" of the first cell in the last record.
    [[nodiscard]] std::map<std::string, double> final_diameters() const {
        return {{"axial_diameter_um", last_.axial}, {"transverse_diameter_um", last_.transverse}};
    }

    /// Largest |V/V(0) - 1|, |A/A(0) - 1| and distance of a centroid from its start (um) seen so far.
    [[nodiscard]] double volume_error() const { return volume_error_; }
    [[nodiscard]] double area_error() const { return area_error_; }
    [[nodiscard]] double centroid_distance() const { return centroid_distance_; }

    /// Volume (um^3) and area (um^2) of every cell at t = 0.
    [[nodiscard]] const std::vector<double>& first_volumes() const { return volume0_; }
    [[nodiscard]] const std::vector<double>& first_areas() const { return area0_; }

    /// Strain and inclination (degrees) of one cell over the run, for plots.
    [[nodiscard]] const std::vector<double>& strains() const { return strain_; }
    [[nodiscard]] std::vector<double> inclinations(std::size_t cell) const;

    /// State for a checkpoint, and back.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint);

  private:
    std::size_t cells_;
    std::vector<double> volume0_, area0_, start_;
    std::vector<double> labels_;  // of the vertices of all cells, rad
    std::vector<double> turned_;  // unwrapped membrane_turn, rad
    membrane::Diameters last_;
    double volume_error_ = 0, area_error_ = 0, centroid_distance_ = 0;
    // per record, cells side by side
    std::vector<double> strain_, inclination_, angle_, taylor_, taylor_volume_, taylor_extent_, index_,
        ellipse_;
};

}  // namespace hemoflux::apps
