/// The numbers of one run as HTML tables.
#pragma once

#include <string>

#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// "inside", "OUTSIDE" or "reported" with its sign and colour.
std::string verdict(output::Comparison::Verdict verdict);

/// The accepted interval of a reference, "18.5 to 21.5"; a dash where there is none.
std::string interval(const output::Reference& reference);

/// Every observable with its unit; those with a reference first, with their distance from it and whether they are inside
/// the accepted interval. Labels (what is no number) among them.
std::string observables_table(const output::Summary& summary);

/// Conservation, estimated errors and speed, side by side.
std::string quality_tables(const output::Summary& summary);

/// The runs of a sweep and their observables, "" for other runs.
std::string sweep_runs_table(const RunRecord& run);

/// Grid, cells, chosen numbers and the conversion between physical and computed units, as the run printed them.
std::string scales_table(const RunRecord& run);

/// Version, processor, threads, backend and when it ran.
std::string environment_table(const RunRecord& run);

}  // namespace hemoflux::report
