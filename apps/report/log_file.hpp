/// log.txt read back: what a run said about itself, and when.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hemoflux::report {

/// One message of a run.
struct LogEntry {
    std::string date;   ///< "2026-11-25 22:34:53"
    std::string level;  ///< info, warning, error or debug
    std::string text;   ///< may have several lines
};

/// Names and values in the order in which they were printed.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// The messages of a log. Lines before the first date are left out.
std::vector<LogEntry> read_log(const std::string& text);

/// The summary printed at the start of a run (grid, cells, chosen numbers, conversion, ...), of the last start.
NamedTexts start_summary(const std::vector<LogEntry>& log);

/// The conversion between physical and computed units, of the start summary.
NamedTexts conversion(const NamedTexts& summary);

/// Version, backend, threads, cores and processor as a run wrote them; empty for logs without that line.
NamedTexts environment(const std::vector<LogEntry>& log);

}  // namespace hemoflux::report
