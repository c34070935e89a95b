#include "apps/output/folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace fs = std::filesystem;
namespace {

void make(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!fs::is_directory(path))
        throw FileError("cannot make the output folder " + path.string(),
                        error ? error.message() : "there is a file of that name",
                        "Choose another folder with --output");
}

void prove_writable(const fs::path& path) {
    const fs::path probe = path / fmt::format(".probe-{}", ::getpid());
    try {
        write_file(probe, "probe\n");
    } catch (const FileError& error) {
        const std::string why = error.what();
        throw FileError("the output folder " + path.string() + " is not writable",
                        why.substr(0, why.find(". ")),
                        "Choose another folder with --output, or free some space");
    }
    fs::remove(probe);
}

void remove_run(const fs::path& path) {
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(path))
        if (entry.is_regular_file() && is_run_file(entry.path().filename().string()))
            old.push_back(entry.path());
    // the marker goes last: a folder that is only half cleared is still known as a run
    const fs::path marker = path / "resolved.toml";
    std::error_code error;
    for (const fs::path& file : old)
        if (file != marker) fs::remove(file, error);
    fs::remove(marker, error);
}

/// A file that a run was writing when it was killed.
bool is_unfinished(const std::string& name) {
    return name.starts_with('.') && (name.ends_with(".tmp") || name.starts_with(".probe-"));
}

/// Whether a folder holds nothing but unfinished files: of a run that was killed before it had written its case.
bool begun(const fs::path& path) {
    std::error_code error;
    if (!fs::is_directory(path, error) || fs::is_empty(path, error)) return false;
    return std::all_of(fs::directory_iterator(path), fs::directory_iterator(),
                       [](const fs::directory_entry& entry) {
                           return entry.is_regular_file() && is_unfinished(entry.path().filename().string());
                       });
}

}  // namespace

bool is_run_file(const std::string& name) {
    constexpr std::string_view fixed[] = {
        "resolved.toml", "summary.json",     "history.csv",      "stretch.csv",   "shapes.csv", "moduli.csv",
        "recovery.csv",  "errors.csv",       "calibration.csv",  "thickness.csv", "log.txt",    "fluid.pvd",
        "cells.pvd",     "centreline_u.csv", "centreline_v.csv", "wall.csv",      "report.html"};
    if (std::find(std::begin(fixed), std::end(fixed), name) != std::end(fixed)) return true;
    if (is_unfinished(name)) return true;

    const auto dot = name.rfind('.'), bar = name.rfind('_');
    if (dot == std::string::npos || bar == std::string::npos || bar + 1 >= dot) return false;
    const std::string kind = name.substr(0, bar), end = name.substr(dot);
    const bool numbered = std::all_of(name.begin() + static_cast<std::ptrdiff_t>(bar) + 1,
                                      name.begin() + static_cast<std::ptrdiff_t>(dot),
                                      [](char c) { return c >= '0' && c <= '9'; });
    if (numbered && kind == "checkpoint") return end == ".bin";
    if (name.starts_with("profile_")) return end == ".csv";
    if (numbered && (kind == "fluid" || kind == "cells"))
        return end == ".vtr" || end == ".vtu" || end == ".vtp";
    return (name.starts_with("picture_") || name.starts_with("plot_")) && (end == ".png" || end == ".svg");
}

OutputFolder::OutputFolder(fs::path path, Folder mode) : path_(std::move(path)) {
    const bool run = fs::exists(resolved()) || (mode == Folder::fresh && begun(path_));
    if (mode == Folder::restart && !run)
        throw InputError("cannot restart from " + path_.string(), "it holds no run (no resolved.toml)",
                         "Give the output folder of the run that is to be continued");
    std::error_code error;
    if (mode == Folder::fresh && !run && fs::is_directory(path_, error) && !fs::is_empty(path_, error))
        throw InputError(
            "the output folder " + path_.string() + " is not empty",
            "it holds files that are not of a Hemoflux run and could be mixed up with its results",
            "Choose another folder with --output, or empty this one");
    make(path_);
    prove_writable(path_);
    if (mode == Folder::fresh && run) remove_run(path_);
}

fs::path OutputFolder::fluid_file(int frame) const { return path_ / fmt::format("fluid_{:04}.vtr", frame); }
fs::path OutputFolder::cell_file(int frame) const { return path_ / fmt::format("cells_{:04}.vtp", frame); }

}  // namespace hemoflux::output
