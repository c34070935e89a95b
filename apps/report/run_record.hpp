/// Everything an output folder holds, read for a report.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/history.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "apps/report/log_file.hpp"
#include "apps/report/sweep_table.hpp"

namespace hemoflux::report {

/// How a run ended. open: it still runs, or was killed.
enum class Ending { finished, interrupted, failed, open };

/// What became of a run, in the words of the page.
struct Status {
    Ending ending = Ending::finished;
    std::string word;     ///< "finished", "interrupted", ...
    std::string message;  ///< why and what to do; empty for a finished run
};

/// One output folder.
struct RunRecord {
    std::filesystem::path folder;
    std::string name;      ///< short, of the folder; differs between the runs of one page
    std::string title;     ///< of the case
    std::string kind;      ///< coupled, fluid, steady, membrane or sweep
    std::string resolved;  ///< the case file with every default
    toml::table input;     ///< the same, parsed
    Status status;
    std::optional<output::Summary> summary;
    std::map<std::string, output::Table> tables;  ///< CSV files of numbers by name, "history.csv"
    std::optional<SweepTable> sweep;
    std::vector<LogEntry> log;
    std::vector<std::filesystem::path> pictures;  ///< picture_*.png; of a series its overview alone
    std::vector<std::filesystem::path> plots;     ///< plot_*.svg
    std::vector<output::Frame> frames;            ///< cell files of cells.pvd that are there
    std::vector<std::string> missing;             ///< pieces that are not there, in words

    /// A table, nullptr where the run has none of that name.
    [[nodiscard]] const output::Table* table(const std::string& name) const;
    /// A text of the case by its path ("membrane.task"), "" where there is none.
    [[nodiscard]] std::string text(const std::string& path) const;
    /// Whether the folder is that of a sweep.
    [[nodiscard]] bool is_sweep() const { return kind == "sweep"; }
};

/// Reads an output folder of any kind of run. InputError when it is none (no resolved.toml and no sweep.toml) or a file in
/// it is malformed, FileError when it or a file in it cannot be read.
RunRecord read_run(const std::filesystem::path& folder);

/// Reads several and gives them names that differ.
std::vector<RunRecord> read_runs(const std::vector<std::filesystem::path>& folders);

}  // namespace hemoflux::report
