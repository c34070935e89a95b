/// The tasks of a case of kind membrane, one file each, and what they share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/case.hpp"
#include "apps/output/folder.hpp"
#include "apps/output/gallery.hpp"
#include "apps/output/log.hpp"
#include "apps/output/plot.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "membrane/batch.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::apps {

using membrane::attojoule_per_unit, membrane::piconewton;
inline constexpr double micronewton_per_unit = 10;  ///< uN/m of 1e-5 N/m
inline constexpr double second = 1e5;               ///< 1 s in 1e-5 s
inline constexpr double pascal_second = 1e4;        ///< 1 Pa s in 1e-4 Pa s

/// One run while it goes on.
struct MembraneRun {
    const Case& input;
    const output::OutputFolder& folder;
    const output::Log& log;
    output::Summary& summary;
    membrane::RelaxOptions relaxation;
    output::PvdSeries series;

    /// What tables and pictures call a cell, and what its observables begin with: nothing where it is alone.
    [[nodiscard]] std::string label(std::size_t cell) const;
    [[nodiscard]] std::string prefix(std::size_t cell) const;

    /// A batch of the cell, relaxed; logs what that took.
    membrane::Batch rest(const CellInput& cell, const std::string& name);
    /// Writes the batch's cell with its references and fields as the next frame, ordered by `position`.
    std::filesystem::path frame(const membrane::Batch& batch, double position);
    /// Puts the measures of a relaxed cell and its energies into the summary.
    void describe(const membrane::Batch& batch, const std::string& prefix);

    /// Draws, unless the case wants no pictures; what goes wrong is a warning.
    void plot(const output::PlotSpec& spec, const std::string& stem) const;
    void gallery(const output::GallerySpec& spec, const std::string& stem) const;
};

/// Relaxes every cell, each into a frame; a gallery of them.
void run_relax(MembraneRun& run);
/// Pulls every cell with every force: stretch.csv, plot_stretch, picture_stretch, distance from measurements.
void run_stretch(MembraneRun& run);
/// Every cell at every c0 and M0: shapes.csv, gallery, a table of what they are.
void run_shapes(MembraneRun& run);
/// Moduli of a flat sheet under every law: moduli.csv, plot_moduli.
void run_moduli(MembraneRun& run);
/// Lets a stretched cell go: recovery.csv, plot_recovery, time constants.
void run_recovery(MembraneRun& run);
/// Fits K_S and c0 to stretch measurements: calibration.csv, plot_calibration, optimum and confidence.
void run_calibration(MembraneRun& run);

}  // namespace hemoflux::apps
