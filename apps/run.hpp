/// Running a case.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/case.hpp"

namespace hemoflux::apps {

/// How far a run is.
struct RunPoint {
    long long step = 0;            ///< or iteration
    double position = 0, end = 0;  ///< strain, time in s, or iterations of at most `end`
};

/// What the command line, or a program that runs cases, says besides the case.
struct RunOptions {
    std::filesystem::path output;   ///< folder for everything the run writes
    int threads = 0;                ///< 0: HEMOFLUX_THREADS or the default of the backend
    std::filesystem::path restart;  ///< folder of the run to continue; empty: start anew
    bool quiet = false;             ///< print nothing but errors
    std::vector<std::string> sets;  ///< overrides as typed, applied when the case is read
    /// Called after every step; where it returns false the run stops as on an interrupt. Signals are then left to the
    /// caller.
    std::function<bool(const RunPoint&)> watch = {};
};

/// Lets SIGINT and SIGTERM stop a run of these options, unless it has a watcher.
void prepare_stop(const RunOptions& options);

/// Whether a signal or the watcher asks the run to stop.
bool stop_asked(const RunOptions& options, const RunPoint& point);

/// Refuses, before anything is written, what check_case() does not see: numbers and conditions that the
/// solvers do not take, measurements that cannot be read. Throws InputError, FileError.
void check_run(const Case& c);

/// Refuses measurements to compare with that cannot be read or lack a column. Throws InputError, FileError.
void check_experiment(const MembraneInput& in);

/// Runs a case of kind coupled or fluid that check_case() has passed and writes its output folder. Returns
/// the exit code. Throws InputError, NumericalError, FileError.
int run_case(const Case& c, const RunOptions& options);

/// Relaxes or stretches the cell of a case of kind membrane and writes its output folder. Returns the exit
/// code.
int run_membrane(const Case& c, const RunOptions& options);

}  // namespace hemoflux::apps
