#include "apps/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/case_check.hpp"
#include "apps/output/atomic_file.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "apps/run_files.hpp"
#include "apps/sweep_report.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = "sweep.toml";

std::vector<std::string> assignments(const SweepInput& sweep, const SweepPoint& point) {
    std::vector<std::string> sets;
    for (std::size_t k = 0; k < point.size(); ++k) sets.push_back(sweep.keys[k] + "=" + point[k]);
    return sets;
}

std::string label(const SweepInput& sweep, const SweepPoint& point) {
    std::string text;
    for (const std::string& set : assignments(sweep, point)) text += (text.empty() ? "" : ", ") + set;
    return text;
}

/// A folder of an earlier sweep, an empty or a new one.
void take_folder(const fs::path& folder, const std::string& text) {
    std::error_code error;
    if (fs::is_directory(folder, error) && !fs::is_empty(folder, error) && !fs::exists(folder / marker))
        throw InputError("the output folder " + folder.string() + " is not empty",
                         "it holds files that are not of a sweep",
                         "Choose another folder with --output, or empty this one");
    fs::create_directories(folder, error);
    output::write_file(folder / marker, text);
}

/// Whether the folder holds a run of this case; finished: with its summary.
bool holds(const fs::path& folder, const Case& c, bool finished) {
    if (!fs::exists(folder / "resolved.toml") || output::read_file(folder / "resolved.toml") != c.resolved)
        return false;
    if (finished) return fs::exists(folder / "summary.json");
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("checkpoint_")) return true;
    return false;
}

/// Relative L2 distance of the final velocities of two runs on one grid; NaN when they cannot be compared.
double difference(const fs::path& run, const fs::path& reference) {
    const output::Checkpoint a = output::latest_checkpoint(run).checkpoint;
    const output::Checkpoint b = output::latest_checkpoint(reference).checkpoint;
    double sum = 0, norm = 0;
    for (const char* name : {"fluid.u", "fluid.v", "fluid.w"}) {
        const auto &x = a.array(name), &y = b.array(name);
        if (x.size() != y.size()) return NAN;
        for (std::size_t i = 0; i < x.size(); ++i) {
            sum += (x[i] - y[i]) * (x[i] - y[i]);
            norm += y[i] * y[i];
        }
    }
    return std::sqrt(sum / norm);
}

int run_point(const Case& c, RunOptions options) {
    if (holds(options.output, c, true)) return static_cast<int>(Exit::done);
    if (c.kind != CaseKind::membrane && !c.steady && holds(options.output, c, false))
        options.restart = options.output;
    return c.kind == CaseKind::membrane ? run_membrane(c, options) : run_case(c, options);
}

}  // namespace

std::vector<SweepPoint> sweep_points(const SweepInput& sweep) {
    std::size_t count = sweep.values.front().size();
    if (sweep.product) {
        count = 1;
        for (const auto& list : sweep.values) count *= list.size();
    }
    std::vector<SweepPoint> points(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t rest = i;
        for (const auto& list : sweep.values) {
            points[i].push_back(sweep.product ? list[rest % list.size()] : list[i]);
            if (sweep.product) rest /= list.size();
        }
    }
    return points;
}

int run_sweep(const fs::path& file, const RunOptions& options, bool check_only) {
    const Case base = read_case(file, options.sets);
    if (!base.sweep)
        throw InputError(fmt::format("{} has no [sweep]", file.string()), "there is nothing to vary",
                         "Add [sweep.values] with lists, or use hemoflux run");
    const SweepInput& sweep = *base.sweep;
    const std::vector<SweepPoint> points = sweep_points(sweep);
    std::vector<Case> cases;
    for (const SweepPoint& point : points) {
        std::vector<std::string> sets = options.sets;
        for (const std::string& set : assignments(sweep, point)) sets.push_back(set);
        Case& c = cases.emplace_back(read_case(file, sets));
        c.references.clear();       // they hold for the case as it stands
        c.output.pictures = false;  // the sweep has its own plot
        check_case(c);
        check_run(c);
    }
    for (const MeasuredInput& m : sweep.measured) {
        const output::Table table = output::read_table(m.file);
        static_cast<void>(table.column(m.x));
        static_cast<void>(table.column(m.y));
    }
    if (check_only) {
        for (const SweepPoint& point : points) fmt::print("{}\n", label(sweep, point));
        fmt::print("# The {} runs of the sweep can be run.\n", points.size());
        return static_cast<int>(Exit::done);
    }
    take_folder(options.output, base.resolved);

    SweepResults results{sweep, points, std::vector<std::map<std::string, double>>(points.size()),
                         std::vector<std::map<std::string, std::string>>(points.size())};
    const auto folder = [&](std::size_t i) { return options.output / fmt::format("run_{:02}", i); };
    int worst = static_cast<int>(Exit::done);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!options.quiet) fmt::print("run {} of {}: {}\n", i + 1, points.size(), label(sweep, points[i]));
        std::fflush(stdout);
        RunOptions one = options;
        one.output = folder(i);
        one.quiet = true;
        try {
            const int code = run_point(cases[i], one);
            if (code == static_cast<int>(Exit::interrupted)) {
                if (!options.quiet) fmt::print("interrupted; the same command continues the sweep\n");
                return code;
            }
        } catch (const NumericalError& error) {
            fmt::print(stderr, "error: run {}: {}\n", i + 1, error.what());
            worst = static_cast<int>(error.code());
            continue;
        }
        const output::Summary summary = output::read_summary(folder(i) / "summary.json");
        results.rows[i] = summary.observables;
        results.labels[i] = summary.labels;
        results.rows[i]["wall_s"] = summary.performance.wall_s;
        results.rows[i]["cpu_s"] = summary.performance.cpu_s;
    }
    if (sweep.difference && !results.rows.back().empty())
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            if (!results.rows[i].empty())
                results.rows[i]["difference"] = difference(folder(i), folder(points.size() - 1));
    report(base, results, options);
    return worst;
}

}  // namespace hemoflux::apps
