#include "apps/coupled_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "apps/output/plot.hpp"
#include "apps/output/progress.hpp"
#include "apps/suspension_observer.hpp"
#include "apps/watchdog.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

std::vector<std::string> history_columns(std::size_t cells, const std::vector<std::string>& more) {
    std::vector<std::string> columns{"step", "time_s", "strain"};
    for (std::size_t c = 0; c < cells; ++c)
        for (const std::string& name : cell_columns()) columns.push_back(fmt::format("{}.{}", c, name));
    columns.insert(columns.end(), more.begin(), more.end());
    columns.insert(columns.end(), {"mean_density", "residual", "dt_s"});
    return columns;
}

/// The run while it goes on.
class CoupledRun {
  public:
    CoupledRun(const Case& c, const RunOptions& options)
        : case_(c), options_(options), system_(c), files_(c, options) {}

    int go() {
        const auto start = std::chrono::steady_clock::now();
        begin();
        int code = static_cast<int>(Exit::done);
        try {
            code = watched(files_.log(), [this] { return march(); });
        } catch (const NumericalError&) {
            keep_last_good_state();
            throw;
        }
        wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        finish(code);
        return code;
    }

  private:
    void begin() {
        files_.log().info(fmt::format("{}: preparing the cells", case_.title));
        system_.add_cells(case_, files_.restart());
        observer_.emplace(*system_.cells);
        if (SuspensionObserver::wanted(case_)) suspension_.emplace(case_, system_);
        prepare_stop(options_);
        files_.log().info(describe(case_, system_));
        if (files_.restart()) {
            system_.load(*files_.restart());
            observer_->load(*files_.restart());
            if (suspension_) suspension_->load(*files_.restart());
            evaluations_before_ = files_.restart()->number("evaluations");
            first_density_ = files_.restart()->number("first_density");
        } else {
            first_density_ = system_.fluid->mean_density();
        }
        watchdog_.emplace(case_.watchdog, observer_->first_volumes(), observer_->first_areas());
        done_ = files_.first_step();
        std::vector<std::string> columns = history_columns(
            system_.cells->cells(), suspension_ ? suspension_->columns() : std::vector<std::string>{});
        if (system_.bodies) {
            body_column_ = columns.size();
            const auto more = system_.bodies->columns();
            columns.insert(columns.end(), more.begin(), more.end());
        }
        files_.start_history(columns);
        files_.start_series(system_.plan.at(done_));
        if (!files_.restart()) {
            record(0);
            frame();
        }
        if (files_.moved()) {
            system_.cells->compute_forces();
            frame();
            files_.write_checkpoint(checkpoint(), done_);
        }
        good_ = checkpoint();
        good_step_ = done_;
    }

    int march() {
        output::Progress progress(system_.plan.at(done_), system_.plan.at(system_.plan.steps), "strain",
                                  options_.quiet);
        const auto cells = static_cast<double>(system_.fluid->cells());
        while (done_ < system_.plan.steps) {
            const bool last = done_ + 1 == system_.plan.steps;
            const bool write = last || due(system_.plan, done_ + 1, frame_interval());
            const bool row = write || due(system_.plan, done_ + 1, row_interval());
            if (row && suspension_) suspension_->before_step();
            system_.loop->step(system_.numerics.step);
            ++done_;
            const bool save = last || due(system_.plan, done_, save_interval());
            const bool stop =
                stop_asked(options_, {done_, system_.plan.at(done_), system_.plan.at(system_.plan.steps)});
            if (row || save || stop || done_ % case_.watchdog.interval == 0) check();
            if (row) record(system_.numerics.step);
            if (write) frame();
            if (row || save) remember();
            if (save || stop) files_.write_checkpoint(checkpoint(), done_);
            progress.update(
                {done_, system_.plan.at(done_), cells * static_cast<double>(system_.fluid->evaluations())});
            if (row && settled()) {
                system_.plan.steps = done_;  // the run ends here
                files_.write_checkpoint(checkpoint(), done_);
                if (!write) frame();
            }
            if (stop && !last) return static_cast<int>(Exit::interrupted);
        }
        return static_cast<int>(Exit::done);
    }

    /// Whether the diameters of a pulled cell have come to rest: over the last two strain units neither has changed by
    /// more than tweezers.tolerance allows.
    [[nodiscard]] bool settled() const {
        if (!case_.tweezers) return false;
        constexpr double span = 2;
        const auto& rows = files_.rows();
        const double now = system_.plan.at(done_);
        const auto column = [](const char* name) {
            const auto& names = cell_columns();
            return 3 + static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
        };
        for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
            if ((*row)[2] > now - span) continue;
            const double allowed = case_.tweezers->tolerance * (now - (*row)[2]) / system_.clock;
            for (const std::size_t d : {column("axial_um"), column("transverse_um")})
                if (!(std::abs(rows.back()[d] - (*row)[d]) < allowed)) return false;
            return true;
        }
        return false;
    }

    /// Strain between two frames.
    [[nodiscard]] double frame_interval() const {
        return case_.output.interval ? *case_.output.interval * system_.clock : case_.output.interval_strain;
    }

    /// Strain between two rows of the history, and between two checkpoints.
    [[nodiscard]] double row_interval() const {
        const OutputInput& out = case_.output;
        return out.history_interval ? *out.history_interval * system_.clock : out.history_interval_strain;
    }
    [[nodiscard]] double save_interval() const {
        const OutputInput& out = case_.output;
        return out.checkpoint_interval ? *out.checkpoint_interval * system_.clock
                                       : out.checkpoint_interval_strain;
    }

    /// Throws NumericalError when fluid or cells have gone wrong.
    void check() const {
        system_.loop->check();
        check_density(case_.watchdog, *system_.fluid);
        watchdog_->check(*system_.cells);
    }

    /// step: length of the step that ends here, 0 at the start.
    void record(double step) {
        const double strain = system_.plan.at(done_);
        std::vector<double> row{static_cast<double>(done_), strain / system_.clock, strain};
        // before the cells' own observer, which computes the forces anew
        const auto all = suspension_ ? suspension_->observe(strain, step) : std::vector<double>{};
        const auto cells = observer_->observe(*system_.cells, strain);
        row.insert(row.end(), cells.begin(), cells.end());
        row.insert(row.end(), all.begin(), all.end());
        row.insert(row.end(), {system_.fluid->mean_density(), system_.fluid->residual_norm().density,
                               system_.numerics.step_seconds});
        if (system_.bodies) {
            const auto bodies = system_.bodies->row();
            row.insert(row.end(), bodies.begin(), bodies.end());
        }
        files_.add_row(row);
    }

    void frame() {
        const double at = system_.plan.at(done_);
        if (const fluid::Solver* box = system_.box_solver())
            files_.write_frame(case_, system_.scales, *box, system_.cells.get(), system_.bodies.get(), at);
        else
            files_.write_flow(case_, system_.scales, *system_.mesh_solver(), *system_.domain.mesh,
                              system_.cells.get(), system_.bodies.get(), system_.loop.get(), at);
    }

    /// Keeps the state in memory, as the last one known to be good.
    void remember() {
        good_ = checkpoint();
        good_step_ = done_;
    }

    void keep_last_good_state() {
        files_.write_checkpoint(good_, good_step_);
        files_.log().warn(fmt::format("the last good state (step {}, strain {:.4g}) is kept in {}",
                                      good_step_, system_.plan.at(good_step_),
                                      output::checkpoint_file(files_.folder().path(), good_step_).string()));
    }

    [[nodiscard]] output::Checkpoint checkpoint() const {
        output::Checkpoint cp;
        system_.save(cp);
        observer_->save(cp);
        if (suspension_) suspension_->save(cp);
        cp.put_number("evaluations", evaluations());
        cp.put_number("first_density", first_density_);
        return cp;
    }

    [[nodiscard]] double evaluations() const {
        return evaluations_before_ + static_cast<double>(system_.fluid->evaluations());
    }

    void finish(int code) {
        if (code == static_cast<int>(Exit::interrupted)) {
            files_.log().warn(
                fmt::format("interrupted at strain {:.4g}; continue with: hemoflux run --restart {}",
                            system_.plan.at(done_), files_.folder().path().string()));
            return;
        }
        const double strain = system_.plan.at(done_);
        output::Summary s = start_summary(case_);
        const auto window = case_.output.window_strain.value_or(std::array<double, 2>{0.4 * strain, strain});
        s.observables = observer_->observables(window[0], window[1]);
        s.labels = observer_->modes(window[0], window[1]);
        s.observables["strain"] = strain;
        if (suspension_)
            for (const auto& [name, value] : suspension_->observables(window[0], window[1]))
                s.observables[name] = value;
        if (case_.tweezers)
            for (const auto& [name, value] : observer_->final_diameters()) s.observables[name] = value;
        if (system_.bodies)
            s.observables.merge(system_.bodies->observables(*system_.fluid, files_.rows(), body_column_));
        s.conservation.volume = observer_->volume_error();
        s.conservation.area = observer_->area_error();
        s.conservation.mean_density_per_strain = (system_.fluid->mean_density() - first_density_) / strain;
        s.conservation.centroid_um = observer_->centroid_distance();
        const double here = strain - system_.plan.at(files_.first_step());
        s.performance.wall_s = wall_s_;
        s.performance.cpu_s = output::cpu_seconds();
        s.performance.steps = static_cast<double>(done_);
        s.performance.residuals_per_strain = evaluations() / strain;
        s.performance.cell_residuals_per_s = static_cast<double>(system_.fluid->evaluations()) *
                                             static_cast<double>(system_.fluid->cells()) / wall_s_;
        if (!(here > 0)) s.performance.cell_residuals_per_s = NAN;
        s.performance.peak_rss_mib = output::peak_rss_mib();
        s.errors_estimated = system_.numerics.errors;
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        plot_inclination();
        if (system_.domain.box) draw_pictures(case_, files_, "strain");
        files_.log().info(closing_line(files_.folder().path()));
    }

    void plot_inclination() const {
        if (!case_.output.pictures) return;
        output::PlotSpec spec{
            .title = case_.title, .x_label = "strain G t", .y_label = "inclination / degrees", .curves = {}};
        for (std::size_t c = 0; c < system_.cells->cells(); ++c)
            spec.curves.push_back({.label = fmt::format("cell {}", c),
                                   .x = observer_->strains(),
                                   .y = observer_->inclinations(c)});
        for (const ReferenceInput& r : case_.references)
            if (r.observable == "inclination_deg" && r.low && r.high)
                spec.bands.push_back({"reference", *r.low, *r.high});
        if (const auto message = output::plot(spec, files_.folder().path() / "plot_inclination"))
            files_.log().warn(*message);
    }

    const Case& case_;
    const RunOptions& options_;
    CoupledSystem system_;  // before the files: a case that it refuses leaves nothing behind
    RunFiles files_;
    std::optional<CellObserver> observer_;
    std::optional<SuspensionObserver> suspension_;
    std::optional<Watchdog> watchdog_;
    long long done_ = 0, good_step_ = 0;
    std::size_t body_column_ = 0;
    output::Checkpoint good_;
    double evaluations_before_ = 0, first_density_ = 1, wall_s_ = 0;
};

}  // namespace

int run_coupled(const Case& c, const RunOptions& options) {
    if (options.threads > 0) exchange::set_threads(options.threads);
    return CoupledRun(c, options).go();
}

}  // namespace hemoflux::apps
