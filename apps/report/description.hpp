/// What a run computes, in one paragraph.
#pragma once

#include <string>

#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// The kind of a run in words: "Coupled run", "Steady flow", ...
std::string kind_in_words(const RunRecord& run);

/// Sentences on the physical case and how it is computed, from the case file; plain text.
std::string description(const RunRecord& run);

}  // namespace hemoflux::report
