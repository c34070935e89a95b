/// Command line options that describe a cell, the same for every command that makes one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hemoflux::apps {

/// What the options hold; empty where they are not given.
struct CellOptions {
    std::string nodes, mesh, file, shape, route, reference, reference_file, law, bending, shear_modulus,
        spontaneous_curvature, area_difference;
    std::vector<std::string> sets;  ///< --set, any key of a case: table.key=value

    /// The overrides of a case (see parse_case()) that they amount to; --set goes last.
    [[nodiscard]] std::vector<std::string> overrides() const;
};

/// Adds the options to a command.
void add_cell_options(CLI::App& command, CellOptions& options);

}  // namespace hemoflux::apps
