#include "apps/fluid_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "apps/flow_observer.hpp"
#include "apps/fluid_system.hpp"
#include "apps/output/convergence_plot.hpp"
#include "apps/output/plot.hpp"
#include "apps/output/progress.hpp"
#include "apps/run_files.hpp"
#include "apps/steady_run.hpp"
#include "apps/watchdog.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "fluid/cell_report.hpp"

namespace hemoflux::apps {
namespace {

/// Names in a checkpoint of the velocity that the next look for the steady state compares with.
constexpr const char* looked_at[] = {"steady.u", "steady.v", "steady.w"};

class FluidRun {
  public:
    FluidRun(const Case& c, const RunOptions& options)
        : case_(c), options_(options), system_(c), observer_(make_observer()), files_(c, options) {}

    int go() {
        const auto start = std::chrono::steady_clock::now();
        begin();
        const int code = watched(files_.log(), [this] { return march(); });
        wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        finish(code);
        return code;
    }

  private:
    std::optional<FlowObserver> make_observer() {
        if (!case_.observables) return std::nullopt;
        return FlowObserver(case_, system_.scales, system_.domain.bounds, system_.options().gamma,
                            *system_.flow);
    }

    [[nodiscard]] double interval(double strain) const {
        if (case_.output.interval) return *case_.output.interval;
        return case_.shear_rate ? strain / *case_.shear_rate : system_.plan.at(system_.plan.steps) / 20;
    }

    void begin() {
        prepare_stop(options_);
        files_.log().info(fmt::format("{}\n  step          {} steps of {:.4g} s", describe(case_, system_),
                                      system_.plan.steps, system_.plan.step));
        if (files_.restart()) {
            load_flow(*system_.flow, *files_.restart());
            first_density_ = files_.restart()->number("first_density");
            if (system_.errors) system_.errors->load(*files_.restart());
            if (case_.time.steady)
                for (std::size_t q = 0; q < 3; ++q) velocity_[q] = files_.restart()->array(looked_at[q]);
            if (system_.bodies) {
                system_.bodies->load(*files_.restart());
                system_.loop->restore({});
            }
        } else {
            first_density_ = system_.flow->mean_density();
        }
        done_ = files_.first_step();
        evaluations_before_ = files_.restart() ? files_.restart()->number("evaluations") : 0;
        std::vector<std::string> columns{"step",         "time_s",   "largest_speed_um_per_s",
                                         "mean_density", "residual", "dt_s"};
        if (system_.errors) columns.insert(columns.end(), {"centre_u_um_per_s", "centre_exact_um_per_s"});
        body_column_ = columns.size();
        if (system_.bodies) {
            const auto more = system_.bodies->columns();
            columns.insert(columns.end(), more.begin(), more.end());
        }
        files_.start_history(columns);
        files_.start_series(system_.plan.at(done_));
        if (!files_.restart()) {
            record();
            observe();
        }
        if (!files_.restart() || files_.moved()) write_frame(files_, case_, system_, system_.plan.at(done_));
        if (files_.moved()) files_.write_checkpoint(checkpoint(), done_);
    }

    int march() {
        output::Progress progress(system_.plan.at(done_), system_.plan.at(system_.plan.steps), "s",
                                  options_.quiet);
        const auto cells = static_cast<double>(system_.flow->cells());
        const double frames = interval(case_.output.interval_strain);
        const OutputInput& out = case_.output;
        const double rows = out.history_interval.value_or(
            case_.shear_rate ? out.history_interval_strain / *case_.shear_rate : frames / 10);
        const double saves = out.checkpoint_interval.value_or(
            case_.shear_rate ? out.checkpoint_interval_strain / *case_.shear_rate : frames);
        output::Checkpoint good = checkpoint();
        long long good_step = done_;
        while (done_ < system_.plan.steps) {
            system_.flow->set_time(system_.plan.at(done_) / system_.scales.time_s());
            system_.step(system_.plan.step / system_.scales.time_s());
            ++done_;
            observe();
            const bool last = done_ == system_.plan.steps || settled(),
                       frame = last || due(system_.plan, done_, frames);
            const bool row = frame || due(system_.plan, done_, rows),
                       stop = stop_asked(
                           options_, {done_, system_.plan.at(done_), system_.plan.at(system_.plan.steps)});
            if (row || stop || done_ % case_.watchdog.interval == 0) check(good, good_step);
            if (row) record();
            if (frame) {
                write_frame(files_, case_, system_, system_.plan.at(done_));
                good = checkpoint();
                good_step = done_;
            }
            if (last || stop || due(system_.plan, done_, saves)) files_.write_checkpoint(checkpoint(), done_);
            progress.update(
                {done_, system_.plan.at(done_), cells * static_cast<double>(system_.flow->evaluations())});
            if (stop && !last) return static_cast<int>(Exit::interrupted);
            if (last) break;
        }
        return static_cast<int>(Exit::done);
    }

    /// Whether the run may end early: looked at a hundred times in its length.
    bool settled() {
        if (!case_.time.steady || !due(system_.plan, done_, system_.plan.at(system_.plan.steps) / 100))
            return false;
        double change = 0, sum = 0;
        for (std::size_t q = 0; q < 3; ++q) {
            std::vector<double> now = system_.flow->values(static_cast<int>(q) + 1);
            if (velocity_[q].size() != now.size()) velocity_[q].assign(now.size(), 0.0);
            for (std::size_t i = 0; i < now.size(); ++i) {
                change += (now[i] - velocity_[q][i]) * (now[i] - velocity_[q][i]);
                sum += now[i] * now[i];
            }
            velocity_[q] = std::move(now);
        }
        if (!(change < *case_.time.steady * *case_.time.steady * sum)) return false;
        files_.log().info(fmt::format("steady at {:.4g} s", system_.plan.at(done_)));
        return true;
    }

    void check(const output::Checkpoint& good, long long good_step) {
        try {
            const std::size_t bad = system_.flow->first_bad_cell();
            if (bad < system_.flow->cells())
                throw NumericalError(
                    fluid::describe_cell(*system_.flow, bad),
                    fmt::format("its density or velocity is no longer a sound number at {:.4g} s",
                                system_.plan.at(done_)),
                    "Shorten time.step or lower numerics.mach");
            check_density(case_.watchdog, *system_.flow);
            if (system_.loop) system_.loop->check();
        } catch (const NumericalError&) {
            files_.write_checkpoint(good, good_step);
            files_.log().warn(
                fmt::format("the last good state (step {}) is kept in {}", good_step,
                            output::checkpoint_file(files_.folder().path(), good_step).string()));
            throw;
        }
    }

    void record() {
        const fluid::ResidualNorm r = system_.flow->residual_norm();
        std::vector<double> row{static_cast<double>(done_),
                                system_.plan.at(done_),
                                system_.flow->largest_speed() * system_.scales.velocity_um_per_s,
                                system_.flow->mean_density(),
                                r.density,
                                system_.plan.step};
        if (system_.errors) {
            const auto centre = system_.errors->centre(*system_.flow, system_.plan.at(done_));
            row.insert(row.end(), centre.begin(), centre.end());
        }
        if (system_.bodies) {
            const auto bodies = system_.bodies->row();
            row.insert(row.end(), bodies.begin(), bodies.end());
        }
        files_.add_row(row);
    }

    void observe() {
        if (system_.errors && system_.errors->due(done_))
            system_.errors->observe(*system_.flow, system_.plan.at(done_));
    }

    [[nodiscard]] output::Checkpoint checkpoint() const {
        output::Checkpoint cp;
        save_flow(*system_.flow, cp);
        cp.put_number("first_density", first_density_);
        cp.put_number("evaluations", evaluations());
        if (system_.errors) system_.errors->save(cp);
        if (system_.bodies) system_.bodies->save(cp);
        if (case_.time.steady)
            for (std::size_t q = 0; q < 3; ++q) cp.put(looked_at[q], velocity_[q]);
        return cp;
    }

    [[nodiscard]] double evaluations() const {
        return evaluations_before_ + static_cast<double>(system_.flow->evaluations());
    }

    void finish(int code) {
        if (code == static_cast<int>(Exit::interrupted)) {
            files_.log().warn(fmt::format("interrupted at {:.4g} s; continue with: hemoflux run --restart {}",
                                          system_.plan.at(done_), files_.folder().path().string()));
            return;
        }
        output::Summary s = start_summary(case_);
        s.observables["largest_speed_um_per_s"] =
            system_.flow->largest_speed() * system_.scales.velocity_um_per_s;
        s.observables["time_s"] = system_.plan.at(done_);
        if (observer_) {
            const std::string failed = observer_->observe(s, files_.folder());
            if (!failed.empty()) files_.log().warn(failed);
        }
        if (system_.errors) compare(s);
        if (system_.bodies)
            s.observables.merge(system_.bodies->observables(*system_.flow, files_.rows(), body_column_));
        if (case_.shear_rate) {
            const double strain = system_.plan.at(done_) * *case_.shear_rate;
            s.conservation.mean_density_per_strain = (system_.flow->mean_density() - first_density_) / strain;
            s.performance.residuals_per_strain = evaluations() / strain;
        }
        add_performance(s, system_, static_cast<double>(done_), wall_s_, output::cpu_seconds() - cpu_before_);
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        draw();
        files_.log().info(closing_line(files_.folder().path()));
    }

    void draw() {
        if (!observer_ || !case_.output.pictures) {
            if (system_.domain.box) draw_pictures(case_, files_, "time in s");
            return;
        }
        const auto stem = files_.folder().path() / "plot_convergence";
        for (const auto& failed :
             {observer_->draw(files_.folder()),
              output::plot_convergence(files_.folder().history(), stem, case_.title).value_or("")})
            if (!failed.empty()) files_.log().warn(failed);
    }

    void compare(output::Summary& s) {
        system_.errors->report(s);
        const bool pictures = case_.output.pictures;
        const std::string failed = system_.errors->write(files_.folder(), case_.title, pictures);
        if (!failed.empty()) files_.log().warn(failed);
        if (!pictures) return;
        output::PlotSpec plot{
            .title = case_.title, .x_label = "t / s", .y_label = "u in the middle / um/s", .curves = {}};
        output::Curve computed, exact;
        computed.label = "computed";
        exact.label = "exact";
        for (const auto& row : files_.rows()) {
            computed.x.push_back(row[1]);
            exact.x.push_back(row[1]);
            computed.y.push_back(row[body_column_ - 2]);  // the columns of bodies come behind
            exact.y.push_back(row[body_column_ - 1]);
        }
        plot.curves = {exact, computed};
        if (const auto message = output::plot(plot, files_.folder().path() / "plot_centre"))
            files_.log().warn(*message);
    }

    const Case& case_;
    const RunOptions& options_;
    const double cpu_before_ = output::cpu_seconds();  // a sweep makes many runs in one process
    FluidSystem system_;  // before the files: a case that it refuses leaves nothing behind
    std::optional<FlowObserver> observer_;
    RunFiles files_;
    long long done_ = 0;
    std::size_t body_column_ = 0;
    std::array<std::vector<double>, 3> velocity_;  ///< when settled() looked last
    double evaluations_before_ = 0, first_density_ = 1, wall_s_ = 0;
};

}  // namespace

int run_fluid(const Case& c, const RunOptions& options) {
    if (options.threads > 0) exchange::set_threads(options.threads);
    if (c.steady) return run_steady(c, options);
    return FluidRun(c, options).go();
}

}  // namespace hemoflux::apps
