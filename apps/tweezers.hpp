/// Measured diameters of a stretched cell, and how far computed ones are from them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/output/plot.hpp"
#include "membrane/stretch.hpp"

namespace hemoflux::apps {

/// Diameters against force; the ends of the error bars are empty where the file has none.
struct Experiment {
    std::vector<double> force;  ///< pN
    /// Measured values with the ends of their error bars.
    struct Diameter {
        std::vector<double> value, low, high;  ///< um
    } axial, transverse;
};

/// Reads columns F_pN, DA_um, DT_um and, if there are any, DA_lo, DA_hi, DT_lo, DT_hi. FileError when the
/// file cannot be read, InputError when a column is missing.
Experiment read_experiment(const std::filesystem::path& file);

/// A computed diameter against force.
struct DiameterCurve {
    std::vector<double> force, value;  ///< pN ascending, um
};

/// Distance of a computed curve, interpolated linearly, from the measured points it spans.
struct Distance {
    double rms_um = 0;       ///< NaN without points
    int points = 0;          ///< measured points that it spans
    int inside = 0;          ///< of them, those in whose error bar the curve lies
    bool with_bars = false;  ///< whether there are error bars
};
Distance distance(const DiameterCurve& computed, const std::vector<double>& force,
                  const Experiment::Diameter& measured);

/// Measured points with their error bars for a plot.
output::Curve measured_curve(const std::string& label, const std::vector<double>& force,
                             const Experiment::Diameter& measured);

}  // namespace hemoflux::apps
