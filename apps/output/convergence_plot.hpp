/// How the residual of a flow falls.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hemoflux::output {

/// Draws stem.svg and stem.png: every column of a history.csv whose name begins with "residual" against its first
/// column, logarithmic. Returns nothing on success and when there is nothing to draw (no such column, fewer than three
/// rows), else one line saying why there is no plot.
std::optional<std::string> plot_convergence(const std::filesystem::path& history,
                                            const std::filesystem::path& stem, const std::string& title);

}  // namespace hemoflux::output
