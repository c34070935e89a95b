/// `hemoflux report DIR [DIR ...]`.
#pragma once

#include <CLI/CLI.hpp>

namespace hemoflux::report {

/// Adds the command; errors leave as hemoflux::Error.
void add_report_command(CLI::App& program);

}  // namespace hemoflux::report
