/// log.txt: what the program says, with times, and the same lines on the terminal.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace hemoflux::output {

/// Writes lines to a log file (with the time of day and the level) and to the terminal (bare): information to
/// standard output, warnings and errors to standard error. Copies share the same file. A text of several
/// lines is one entry.
class Log {
  public:
    /// Terminal only, no file. quiet: information is not shown on the terminal.
    explicit Log(bool quiet = false);
    /// Terminal and file; append continues an earlier file (restart). FileError when it cannot be opened.
    Log(const std::filesystem::path& file, bool quiet, bool append = false);

    /// Something to know.
    void info(const std::string& text) const;
    /// Something to look into; the run goes on.
    void warn(const std::string& text) const;
    /// Why the run ends.
    void error(const std::string& text) const;
    /// Goes into the file only.
    void detail(const std::string& text) const;

  private:
    std::shared_ptr<spdlog::logger> file_;  // null: terminal only
    bool quiet_;
};

}  // namespace hemoflux::output
