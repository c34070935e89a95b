#include "apps/report/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "apps/output/atomic_file.hpp"
#include "apps/output/folder.hpp"
#include "apps/toml_input.hpp"
#include "exchange/error.hpp"

namespace hemoflux::report {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> files_in(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->is_regular_file(error)) files.push_back(it->path());
    if (error)
        throw FileError("cannot read " + folder.string(), error.message(),
                        "Give the folder that a run has written (its --output)");
    std::sort(files.begin(), files.end());
    return files;
}

/// The overview stands for the single pictures of a series.
void read_pictures(RunRecord& run, const std::vector<fs::path>& files) {
    const auto numbered = [](const std::string& name) {
        return name.size() == 14 && name[8] >= '0' && name[8] <= '9' && name[9] >= '0' && name[9] <= '9';
    };
    const bool series = fs::exists(run.folder / "picture_series.png");
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        if (name.starts_with("plot_") && name.ends_with(".svg")) run.plots.push_back(file);
        if (name.starts_with("picture_") && name.ends_with(".png") && !(series && numbered(name)))
            run.pictures.push_back(file);
    }
}

void read_tables(RunRecord& run, const std::vector<fs::path>& files) {
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        if (name.ends_with(".csv") && output::is_run_file(name)) run.tables[name] = output::read_table(file);
    }
}

void read_frames(RunRecord& run) {
    const fs::path series = run.folder / "cells.pvd";
    if (!fs::exists(series)) return;
    std::size_t lost = 0;
    for (const output::Frame& frame : output::read_pvd(series)) {
        if (fs::exists(run.folder / frame.file))
            run.frames.push_back(frame);
        else
            ++lost;
    }
    if (lost > 0)
        run.missing.push_back(fmt::format("{} of the {} cell files that cells.pvd names are no longer there",
                                          lost, lost + run.frames.size()));
}

/// The table of a sweep, and the logs of its first and last run, which say when and where it was computed.
void read_sweep(RunRecord& run) {
    if (fs::exists(run.folder / "sweep.csv"))
        run.sweep = read_sweep_table(run.folder / "sweep.csv", run.input);
    std::vector<fs::path> logs;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(run.folder, error))
        if (entry.path().filename().string().starts_with("run_") && fs::exists(entry.path() / "log.txt"))
            logs.push_back(entry.path() / "log.txt");
    if (logs.empty()) return;
    const auto [first, last] = std::minmax_element(logs.begin(), logs.end());
    run.log = read_log(output::read_file(*first));
    const auto end = read_log(output::read_file(*last));
    if (first != last) run.log.insert(run.log.end(), end.begin(), end.end());
}

std::string kind_of(const RunRecord& run) {
    if (fs::exists(run.folder / "sweep.toml")) return "sweep";
    const std::string kind = run.text("kind");
    return kind == "fluid" && run.input.contains("steady") ? "steady" : kind;
}

std::string progress(const RunRecord& run) {
    const output::Table* history = run.table("history.csv");
    if (history == nullptr || history->rows.empty()) return "No step is recorded.";
    std::string text;
    for (const char* name : {"step", "strain", "time_s"}) {
        const auto found = std::find(history->columns.begin(), history->columns.end(), name);
        if (found == history->columns.end()) continue;
        text += fmt::format("{}{} {:.6g}{}", text.empty() ? "The last record is of " : ", ",
                            std::string(name) == "time_s" ? "time" : name, history->column(name).back(),
                            std::string(name) == "time_s" ? " s" : "");
    }
    return text + ".";
}

bool has_checkpoint(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (entry.path().filename().string().starts_with("checkpoint_")) return true;
    return false;
}

Status sweep_status(const RunRecord& run) {
    const auto& done = run.sweep;
    if (run.summary && done && done->failed() == 0) return {Ending::finished, "finished", ""};
    if (run.summary && done)
        return {Ending::failed, "failed in part",
                fmt::format("{} of the {} runs have no results; each says why in its log.txt.",
                            done->failed(), done->rows.size())};
    std::size_t finished = 0, begun = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(run.folder, error)) {
        if (!entry.path().filename().string().starts_with("run_")) continue;
        ++begun;
        finished += fs::exists(entry.path() / "summary.json") ? 1 : 0;
    }
    return {Ending::open, "unfinished",
            fmt::format(
                "{} runs are finished and {} begun; it still runs or was stopped. The same hemoflux sweep "
                "command continues it.",
                finished, begun - finished)};
}

Status status_of(const RunRecord& run) {
    if (run.is_sweep()) return sweep_status(run);
    if (run.summary) return {Ending::finished, "finished", ""};
    // what was written since the run was last started or continued
    for (auto entry = run.log.rbegin(); entry != run.log.rend() && entry->level != "info"; ++entry) {
        if (entry->level == "warning" && entry->text.starts_with("interrupted"))
            return {Ending::interrupted, "interrupted", "The run was " + entry->text + ". " + progress(run)};
        // errors are sentences, what else is noted in the file alone is none
        if (entry->level == "debug" && entry->text.ends_with('.'))
            return {Ending::failed, "failed", "It stopped with: " + entry->text + " " + progress(run)};
    }
    const bool restartable = run.kind != "membrane" && run.kind != "steady" && has_checkpoint(run.folder);
    return {Ending::open, "unfinished",
            "There is no summary.json: the run goes on, or was killed. " + progress(run) +
                (restartable ? " If it no longer runs, hemoflux run --restart " + run.folder.string() +
                                   " continues it."
                             : "")};
}

}  // namespace

const output::Table* RunRecord::table(const std::string& name_) const {
    const auto found = tables.find(name_);
    return found == tables.end() ? nullptr : &found->second;
}

std::string RunRecord::text(const std::string& path) const {
    const auto node = input.at_path(path);
    if (const auto words = node.value<std::string>()) return *words;
    return node ? apps::value_text(*node.node()) : "";
}

RunRecord read_run(const fs::path& folder) {
    RunRecord run;
    run.folder = folder;
    const auto files = files_in(folder);
    const bool sweep = fs::exists(folder / "sweep.toml");
    const fs::path marker = folder / (sweep ? "sweep.toml" : "resolved.toml");
    if (!fs::exists(marker))
        throw InputError(folder.string() + " is not an output folder of hemoflux",
                         "it has neither resolved.toml (of a run) nor sweep.toml (of a sweep)",
                         "Give the folder that a run has written (its --output)");
    run.resolved = output::read_file(marker);
    run.input = apps::parse_toml(run.resolved, marker.string());
    run.kind = kind_of(run);
    run.title = run.text("title");
    const fs::path plain = fs::absolute(folder).lexically_normal();
    run.name = (plain.has_filename() ? plain : plain.parent_path()).filename().string();
    if (fs::exists(folder / "summary.json")) run.summary = output::read_summary(folder / "summary.json");
    if (fs::exists(folder / "log.txt")) run.log = read_log(output::read_file(folder / "log.txt"));
    read_tables(run, files);
    read_pictures(run, files);
    read_frames(run);
    if (sweep) read_sweep(run);
    run.status = status_of(run);
    return run;
}

std::vector<RunRecord> read_runs(const std::vector<fs::path>& folders) {
    std::vector<RunRecord> runs;
    for (const fs::path& folder : folders) runs.push_back(read_run(folder));
    std::map<std::string, int> seen;
    for (const RunRecord& run : runs) ++seen[run.name];
    for (RunRecord& run : runs)
        if (seen[run.name] > 1) run.name = run.folder.lexically_normal().string();
    return runs;
}

}  // namespace hemoflux::report
