/// The page that `hemoflux report` writes.
#pragma once

#include <string>
#include <vector>

#include "apps/report/run_record.hpp"

namespace hemoflux::report {

/// One self-contained HTML document from one run, or from several side by side: results against references, animation,
/// plots, pictures, case, scales, environment. It loads nothing from elsewhere. FileError, InputError when a picture or
/// cell file cannot be read.
std::string build_page(const std::vector<RunRecord>& runs);

}  // namespace hemoflux::report
