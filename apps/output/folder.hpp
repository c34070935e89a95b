/// The output folder of a run and the names of the files in it.
#pragma once

#include <filesystem>
#include <string>

namespace hemoflux::output {

/// What an output folder may already hold.
enum class Folder {
    fresh,    ///< nothing, or an earlier run, whose files are removed
    restart,  ///< the run that is continued; nothing is removed
};

/// The folder into which one run writes; made and proved writable before any time step.
class OutputFolder {
  public:
    /// Makes the folder and its parents and proves that a file can be written in it. A folder that exists is
    /// accepted when it is empty or holds a run of Hemoflux (a resolved.toml); with Folder::fresh the files
    /// of that run (and only files with the names of a run) are removed, so that series never mix. InputError
    /// when the folder holds something else, or, for Folder::restart, no run. FileError when it cannot be
    /// made or written.
    OutputFolder(std::filesystem::path path, Folder mode);

    /// The folder itself.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

    /// The case with every default filled in; its presence marks the folder as a run.
    [[nodiscard]] std::filesystem::path resolved() const { return path_ / "resolved.toml"; }
    /// Time series of the observables.
    [[nodiscard]] std::filesystem::path history() const { return path_ / "history.csv"; }
    /// Results and their distance from the references.
    [[nodiscard]] std::filesystem::path summary() const { return path_ / "summary.json"; }
    /// What was printed, with times.
    [[nodiscard]] std::filesystem::path log() const { return path_ / "log.txt"; }
    /// Index of the fluid files for ParaView.
    [[nodiscard]] std::filesystem::path fluid_series() const { return path_ / "fluid.pvd"; }
    /// Index of the cell files for ParaView.
    [[nodiscard]] std::filesystem::path cell_series() const { return path_ / "cells.pvd"; }
    /// Name of the fluid file of one frame, fluid_0012.vtr.
    [[nodiscard]] std::filesystem::path fluid_file(int frame) const;
    /// Name of the cell file of one frame, cells_0012.vtp.
    [[nodiscard]] std::filesystem::path cell_file(int frame) const;

  private:
    std::filesystem::path path_;
};

/// Whether a run writes files of this name (without folder) into its output folder.
bool is_run_file(const std::string& name);

}  // namespace hemoflux::output
