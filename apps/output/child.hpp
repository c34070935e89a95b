/// Child processes for the programs that draw pictures.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hemoflux::output {

/// How a child process ended and what it printed.
struct ChildResult {
    /// The four ways to end.
    enum class End { exited, signalled, timed_out, not_started } end;
    int code = 0;        ///< exit status or signal
    std::string output;  ///< standard output and standard error together
    /// Whether it ran and exited with 0.
    [[nodiscard]] bool ok() const noexcept { return end == End::exited && code == 0; }
    /// "it exited with 1: last line of its output", "it was ended by signal 6", ...
    [[nodiscard]] std::string why() const;
};

/// Runs a program (found through PATH) with arguments, input on its standard input; waits, and kills it with
/// all its own children when the time is up.
ChildResult run_child(const std::vector<std::string>& command, const std::string& input,
                      std::chrono::seconds limit);

/// Where a program lies on PATH; nothing when it does not.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace hemoflux::output
