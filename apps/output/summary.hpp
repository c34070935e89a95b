/// summary.json: the results of a run of any kind in one shape, and the table printed at its end.
#pragma once

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hemoflux::output {

/// What one observable is compared with. A reference may be a value, an interval, or both.
struct Reference {
    std::optional<double> reference;  ///< the published or exact value
    std::optional<double> low, high;  ///< the accepted interval, in the observable's unit
    std::string source;               ///< where it comes from
};

/// Everything a run reports. Units stand in the names (inclination_deg, axial_diameter_um). A number that the
/// run did not produce is NaN and is written as null.
struct Summary {
    std::string case_name;
    std::string version;
    std::string backend;
    int threads = 1;
    std::map<std::string, double> observables;
    std::map<std::string, std::string> labels;    ///< what is no number: how a cell moves
    std::map<std::string, Reference> references;  ///< by the name of the observable

    /// How well volume, area, mass and place are kept.
    struct Conservation {
        double volume = NAN;                   ///< largest |V/V(0) - 1| of any cell over the run
        double area = NAN;                     ///< largest |A/A(0) - 1| of any cell over the run
        double mean_density_per_strain = NAN;  ///< drift of the mean density per strain unit, relative
        double centroid_um = NAN;              ///< largest distance of a centroid from its start, um
    } conservation;

    /// What the run cost.
    struct Performance {
        double wall_s = NAN;
        double cpu_s = NAN;
        double steps = NAN;
        double residuals_per_strain = NAN;  ///< residual evaluations of the whole grid per strain unit
        double cell_residuals_per_s = NAN;  ///< evaluations of one cell's residual per second of wall time
        double peak_rss_mib = NAN;
    } performance;

    std::map<std::string, double> errors_estimated;  ///< relative, by cause
};

/// The summary as JSON text; all keys of the shape are always there, numbers keep every digit.
std::string to_json(const Summary& summary);

/// Writes summary.json atomically. FileError.
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// Reads a summary.json back. FileError when unreadable, InputError when it is not JSON of this shape.
Summary read_summary(const std::filesystem::path& path);

/// One line of the comparison with the references.
struct Comparison {
    std::string name;
    double value;
    Reference reference;
    std::optional<double> relative;  ///< value / reference - 1, where there is a reference that is not 0
    enum class Verdict { inside, outside, reported } verdict;  ///< reported: no interval is given
};

/// Every referenced observable with its distance from the reference; an observable without a value is
/// outside.
std::vector<Comparison> compare(const Summary& summary);

/// The table printed at the end of a run: observables, how far each is from its reference, conservation,
/// performance.
std::string to_table(const Summary& summary);

/// Peak resident memory of this process so far, MiB.
double peak_rss_mib();
/// Processor time of this process so far, all threads, s.
double cpu_seconds();

}  // namespace hemoflux::output
