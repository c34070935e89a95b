#include "apps/error_observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/history.hpp"
#include "apps/output/plot.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

constexpr const char* component_names[] = {"density", "u", "v", "w"};

}  // namespace

ErrorObserver::ErrorObserver(const Case& c, const meshing::RectilinearGrid& grid, const Scales& scales,
                             const StepPlan& plan)
    : grid_(grid), scales_(scales), exact_(exact_case(c, grid, scales)) {
    for (const double t : c.analytical->times) {
        const long long step = std::llround(t * exact_.clock_s / plan.step);
        if (!steps_.empty() && steps_.back() == step)
            throw InputError(fmt::format("analytical.times has {} beside its neighbour", t),
                             "both fall on the same time step",
                             "Give times further apart, or shorten time.step");
        steps_.push_back(step);
    }
    if (steps_.empty()) steps_.push_back(plan.steps);
    lines_.push_back(make_line(1, 1));
    if (c.analytical->solution == ExactSolution::taylor_green) lines_.push_back(make_line(0, 2));
    const Line& line = lines_.front();
    centre_ = line.cells[line.cells.size() / 2];
}

ErrorObserver::Line ErrorObserver::make_line(std::size_t axis, std::size_t component) const {
    Line line{axis, component, {}, {}};
    std::array<std::size_t, 3> at{};
    for (std::size_t a = 0; a < 3; ++a) at[a] = grid_.axes[a].cells() / 2;
    for (at[axis] = 0; at[axis] < grid_.axes[axis].cells(); ++at[axis]) {
        line.cells.push_back(at[0] + grid_.axes[0].cells() * (at[1] + grid_.axes[1].cells() * at[2]));
        line.position.push_back(grid_.axes[axis].centres()[at[axis]]);
    }
    return line;
}

bool ErrorObserver::due(long long done) const {
    return std::find(steps_.begin(), steps_.end(), done) != steps_.end();
}

double ErrorObserver::exact_at(const fluid::Flow& flow, const Line& line, std::size_t i, double time) const {
    const fluid::FlowPoint p = exact_.flow(flow.centre(line.cells[i]), time / scales_.time_s());
    return (line.component == 1 ? p.velocity.x : p.velocity.y) * scales_.velocity_um_per_s;
}

/// The largest volume-averaged norm of the exact velocity over a period; the period is sampled.
double ErrorObserver::largest_norm(const fluid::Flow& flow) const {
    constexpr int samples = 200;
    double largest = 0;
    for (int i = 0; i < samples; ++i) {
        const double t = exact_.clock_s / scales_.time_s() * i / samples;
        largest = std::max(largest, fluid::velocity_error(flow, exact_.flow, t).norm);
    }
    return largest;
}

void ErrorObserver::observe(const fluid::Flow& flow, double time) {
    const double t = time / scales_.time_s();
    if (exact_.periodic && cycle_norm_ == 0) cycle_norm_ = largest_norm(flow);
    const fluid::VelocityError e = fluid::velocity_error(flow, exact_.flow, t);
    const double clock = exact_.clock_s > 0 ? time / exact_.clock_s : NAN;
    observations_.push_back({time, clock, e.relative, e.total, e.largest,
                             exact_.periodic ? e.absolute / cycle_norm_ : NAN,
                             fluid::density_error(flow, exact_.flow, t)});
    for (const Line& line : lines_) {
        const auto values = flow.values(static_cast<int>(line.component));
        for (const std::size_t cell : line.cells)
            profiles_.push_back(values[cell] * scales_.velocity_um_per_s);
        for (std::size_t i = 0; i < line.cells.size(); ++i)
            profiles_.push_back(exact_at(flow, line, i, time));
    }
}

std::array<double, 2> ErrorObserver::centre(const fluid::Flow& flow, double time) const {
    const Vec3d at = flow.centre(centre_);
    return {flow.values(1)[centre_] * scales_.velocity_um_per_s,
            exact_.flow(at, time / scales_.time_s()).velocity.x * scales_.velocity_um_per_s};
}

void ErrorObserver::save(output::Checkpoint& checkpoint) const {
    std::vector<double> rows;
    for (const Observation& o : observations_)
        rows.insert(rows.end(), {o.time, o.clock, o.relative, o.total, o.largest, o.over_cycle, o.density});
    checkpoint.put("exact.errors", std::move(rows));
    checkpoint.put("exact.profiles", profiles_);
}

void ErrorObserver::load(const output::Checkpoint& checkpoint) {
    const auto& rows = checkpoint.array("exact.errors");
    observations_.clear();
    for (std::size_t i = 0; i + 7 <= rows.size(); i += 7)
        observations_.push_back(
            {rows[i], rows[i + 1], rows[i + 2], rows[i + 3], rows[i + 4], rows[i + 5], rows[i + 6]});
    profiles_ = checkpoint.array("exact.profiles");
}

void ErrorObserver::report(output::Summary& summary) const {
    if (observations_.empty()) return;
    const Observation& last = observations_.back();
    summary.observables["error_relative"] = last.relative;
    summary.observables["error_total"] = last.total;
    summary.observables["error_largest"] = last.largest;
    if (std::isfinite(last.density)) summary.observables["error_density"] = last.density;
    if (!exact_.periodic) return;
    double worst = 0;
    for (const Observation& o : observations_) worst = std::max(worst, o.over_cycle);
    summary.observables["error_over_cycle_largest"] = worst;
}

std::string ErrorObserver::write(const output::OutputFolder& folder, const std::string& title,
                                 bool pictures) const {
    output::Table table{{"time_s", "clock", "relative", "total", "largest", "over_cycle", "density"}, {}};
    for (const Observation& o : observations_)
        table.rows.push_back({o.time, o.clock, o.relative, o.total, o.largest, o.over_cycle, o.density});
    output::write_table(folder.path() / "errors.csv", table);
    std::string failed;
    std::size_t per_observation = 0, before = 0;
    for (const Line& line : lines_) per_observation += 2 * line.cells.size();
    for (const Line& line : lines_) {
        const std::string axis(1, "xyz"[line.axis]), component = component_names[line.component];
        output::PlotSpec plot{
            .title = title, .x_label = axis + " / um", .y_label = component + " / um/s", .curves = {}};
        output::Table profile{{axis + "_um"}, {}};
        for (const double position : line.position) profile.rows.push_back({position});
        for (std::size_t o = 0; o < observations_.size(); ++o) {
            const auto at = profiles_.begin() + static_cast<std::ptrdiff_t>(o * per_observation + before);
            const auto n = static_cast<std::ptrdiff_t>(line.cells.size());
            const std::string when = std::isfinite(observations_[o].clock)
                                         ? fmt::format("{:.4g}", observations_[o].clock)
                                         : fmt::format("{:.4g} s", observations_[o].time);
            profile.columns.push_back(fmt::format("{}_um_per_s at {}", component, when));
            profile.columns.push_back(fmt::format("exact at {}", when));
            for (std::size_t i = 0; i < line.cells.size(); ++i) {
                const auto k = static_cast<std::ptrdiff_t>(i);
                profile.rows[i].push_back(at[k]);
                profile.rows[i].push_back(at[n + k]);
            }
            plot.curves.push_back(
                {.label = "exact, t = " + when, .x = line.position, .y = {at + n, at + 2 * n}});
            plot.curves.push_back(
                {.label = "computed", .x = line.position, .y = {at, at + n}, .points = true});
        }
        before += 2 * line.cells.size();
        const std::string name = fmt::format("{}_along_{}", component, axis);
        output::write_table(folder.path() / fmt::format("profile_{}.csv", name), profile);
        if (!pictures) continue;
        if (const auto message = output::plot(plot, folder.path() / ("plot_" + name))) failed = *message;
    }
    return failed;
}

}  // namespace hemoflux::apps
