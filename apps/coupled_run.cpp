#include "apps/coupled_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "apps/coupled_clock.hpp"
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
        clock_.emplace(case_, system_);
        if (files_.restart()) {
            system_.load(*files_.restart());
            clock_->load(*files_.restart(), files_.first_step());
            observer_->load(*files_.restart());
            if (suspension_) suspension_->load(*files_.restart());
            evaluations_before_ = files_.restart()->number("evaluations");
            first_density_ = files_.restart()->number("first_density");
        } else {
            first_density_ = system_.fluid->mean_density();
        }
        watchdog_.emplace(case_.watchdog, observer_->first_volumes(), observer_->first_areas());
        first_strain_ = clock_->now();
        std::vector<std::string> columns = history_columns(
            system_.cells->cells(), suspension_ ? suspension_->columns() : std::vector<std::string>{});
        if (system_.bodies) {
            body_column_ = columns.size();
            const auto more = system_.bodies->columns();
            columns.insert(columns.end(), more.begin(), more.end());
        }
        files_.start_history(columns);
        files_.start_series(clock_->now());
        if (!files_.restart()) {
            record(0);
            frame();
        }
        if (files_.moved()) {
            system_.cells->compute_forces();
            frame();
            files_.write_checkpoint(checkpoint(), clock_->done());
        }
        remember();
    }

    int march() {
        CoupledClock& clock = *clock_;
        output::Progress progress(clock.now(), clock.end(), "strain", options_.quiet);
        const auto cells = static_cast<double>(system_.fluid->cells());
        while (!clock.ended()) {
            const bool last = clock.last();
            const bool write = last || clock.reaches(clock.intervals().frame);
            const bool row = write || clock.reaches(clock.intervals().row);
            const bool save = last || clock.reaches(clock.intervals().checkpoint);
            if (row && suspension_) suspension_->before_step();
            clock.step();
            const bool stop = stop_asked(options_, {clock.done(), clock.now(), clock.end()});
            if (row || save || stop || clock.done() % case_.watchdog.interval == 0) check();
            if (row) record(clock.taken());
            if (write) frame();
            if (row || save) remember();
            if (save || stop) files_.write_checkpoint(checkpoint(), clock.done());
            progress.update(
                {clock.done(), clock.now(), cells * static_cast<double>(system_.fluid->evaluations())});
            if (row && settled()) {
                clock.end_here();
                files_.write_checkpoint(checkpoint(), clock.done());
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
        const double now = clock_->now();
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

    /// Throws NumericalError when fluid or cells have gone wrong.
    void check() const {
        system_.loop->check();
        check_density(case_.watchdog, *system_.fluid);
        watchdog_->check(*system_.cells);
    }

    /// step: length in strain of the step that ends here, 0 at the start.
    void record(double step) {
        const double strain = clock_->now();
        std::vector<double> row{static_cast<double>(clock_->done()), strain / system_.clock, strain};
        // before the cells' own observer, which computes the forces anew
        const auto all =
            suspension_ ? suspension_->observe(strain, step / system_.numerics.rate) : std::vector<double>{};
        const auto cells = observer_->observe(*system_.cells, strain);
        row.insert(row.end(), cells.begin(), cells.end());
        row.insert(row.end(), all.begin(), all.end());
        row.insert(row.end(), {system_.fluid->mean_density(), system_.fluid->residual_norm().density,
                               clock_->taken() / system_.clock});
        if (system_.bodies) {
            const auto bodies = system_.bodies->row();
            row.insert(row.end(), bodies.begin(), bodies.end());
        }
        files_.add_row(row);
    }

    void frame() {
        const double at = clock_->now();
        if (const fluid::Solver* box = system_.box_solver())
            files_.write_frame(case_, system_.scales, *box, system_.cells.get(), system_.bodies.get(), at);
        else
            files_.write_flow(case_, system_.scales, *system_.mesh_solver(), *system_.domain.mesh,
                              system_.cells.get(), system_.bodies.get(), system_.loop.get(), at);
    }

    /// Keeps the state in memory, as the last one known to be good.
    void remember() {
        good_ = checkpoint();
        good_step_ = clock_->done();
        good_strain_ = clock_->now();
    }

    void keep_last_good_state() {
        files_.write_checkpoint(good_, good_step_);
        files_.log().warn(fmt::format("the last good state (step {}, strain {:.4g}) is kept in {}",
                                      good_step_, good_strain_,
                                      output::checkpoint_file(files_.folder().path(), good_step_).string()));
    }

    [[nodiscard]] output::Checkpoint checkpoint() const {
        output::Checkpoint cp;
        system_.save(cp);
        clock_->save(cp);
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
                            clock_->now(), files_.folder().path().string()));
            return;
        }
        const double strain = clock_->now();
        output::Summary s = start_summary(case_);
        const auto window = case_.output.window_strain.value_or(std::array<double, 2>{0.4 * strain, strain});
        s.observables = observer_->observables(window[0], window[1]);
        s.labels = observer_->modes(window[0], window[1], case_.shear_rate.has_value());
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
        const double here = strain - first_strain_;
        s.performance.wall_s = wall_s_;
        s.performance.cpu_s = output::cpu_seconds() - cpu_before_;
        s.performance.steps = static_cast<double>(clock_->done());
        s.performance.residuals_per_strain = evaluations() / strain;
        s.performance.cell_residuals_per_s = static_cast<double>(system_.fluid->evaluations()) *
                                             static_cast<double>(system_.fluid->cells()) / wall_s_;
        if (!(here > 0)) s.performance.cell_residuals_per_s = NAN;
        s.performance.peak_rss_mib = output::peak_rss_mib();
        s.errors_estimated = system_.numerics.errors;
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        if (const std::string steps = clock_->report(); !steps.empty()) files_.log().info(steps);
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
    const double cpu_before_ = output::cpu_seconds();  // a sweep makes many runs in one process
    CoupledSystem system_;  // before the files: a case that it refuses leaves nothing behind
    RunFiles files_;
    std::optional<CoupledClock> clock_;
    std::optional<CellObserver> observer_;
    std::optional<SuspensionObserver> suspension_;
    std::optional<Watchdog> watchdog_;
    long long good_step_ = 0;
    double good_strain_ = 0, first_strain_ = 0;
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
