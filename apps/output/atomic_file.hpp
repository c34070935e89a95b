/// Files that are either the old one or the whole new one, whatever kills the program in between.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hemoflux::output {

/// Writes content to path: into a temporary file beside it, flushed to the disk (fsync), then renamed over
/// path. FileError naming path and the system's reason; the old file is then still there and the temporary
/// one is gone.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The whole content of a file. FileError naming path and the system's reason.
std::string read_file(const std::filesystem::path& path);

}  // namespace hemoflux::output
