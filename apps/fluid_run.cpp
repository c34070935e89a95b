#include "apps/fluid_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "apps/flow_observer.hpp"
#include "apps/fluid_system.hpp"
#include "apps/interrupt.hpp"
#include "apps/output/convergence_plot.hpp"
#include "apps/output/progress.hpp"
#include "apps/run_files.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

constexpr long long watch_interval = 25;

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
        const auto& [x, y, z] = system_.grid.axes;
        const FlowBox box{{x.lower(), y.lower(), z.lower()}, {x.upper(), y.upper(), z.upper()}};
        return FlowObserver(case_, system_.scales, box, system_.solver.options().gamma, system_.solver);
    }

    [[nodiscard]] double interval(double strain) const {
        if (case_.output.interval) return *case_.output.interval;
        return case_.shear_rate ? strain / *case_.shear_rate : system_.plan.at(system_.plan.steps) / 20;
    }

    void begin() {
        catch_interrupts();
        files_.log().info(
            fmt::format("{}\n  grid          {} x {} x {} cells, smallest {:.4g} um\n"
                        "  fluid         nu/h = {:.3g}, Ma = {:.3g} at {:.4g} um/s\n"
                        "  step          {} steps of {:.4g} s\n"
                        "  conversion    length 1 um; velocity c = {:.4g} um/s; lattice time = {:.4g} s; "
                        "stress = {:.4g} Pa",
                        case_.title, system_.grid.axes[0].cells(), system_.grid.axes[1].cells(),
                        system_.grid.axes[2].cells(), system_.grid.smallest(),
                        system_.solver.options().nu / system_.grid.smallest(), system_.mach, system_.speed,
                        system_.plan.steps, system_.plan.step, system_.scales.velocity_um_per_s,
                        system_.scales.time_s(), system_.scales.pressure_pa));
        if (files_.restart()) {
            for (int q = 0; q < 4; ++q)
                system_.solver.state().set_interior(
                    system_.solver.state().view().q[q],
                    files_.restart()->array(names[q], system_.solver.grid().view().layout.cells()));
            first_density_ = files_.restart()->number("first_density");
        } else {
            first_density_ = system_.solver.mean_density();
        }
        done_ = files_.first_step();
        evaluations_before_ = files_.restart() ? files_.restart()->number("evaluations") : 0;
        files_.start_history(
            {"step", "time_s", "largest_speed_um_per_s", "mean_density", "residual", "dt_s"});
        files_.start_series(system_.plan.at(done_));
        if (!files_.restart()) {
            record();
        }
        if (!files_.restart() || files_.moved())
            files_.write_frame(case_, system_.scales, system_.solver, nullptr, system_.plan.at(done_));
        if (files_.moved()) files_.write_checkpoint(checkpoint(), done_);
    }

    int march() {
        output::Progress progress(system_.plan.at(done_), system_.plan.at(system_.plan.steps), "s",
                                  options_.quiet);
        const auto cells = static_cast<double>(system_.solver.grid().view().layout.cells());
        const double frames = interval(case_.output.interval_strain);
        const double rows =
            case_.shear_rate ? case_.output.history_interval_strain / *case_.shear_rate : frames / 10;
        const double saves =
            case_.shear_rate ? case_.output.checkpoint_interval_strain / *case_.shear_rate : frames;
        output::Checkpoint good = checkpoint();
        long long good_step = done_;
        while (done_ < system_.plan.steps) {
            system_.solver.step(system_.plan.step / system_.scales.time_s());
            ++done_;
            const bool last = done_ == system_.plan.steps, frame = last || due(system_.plan, done_, frames);
            const bool row = frame || due(system_.plan, done_, rows), stop = interrupted();
            if (row || stop || done_ % watch_interval == 0) check(good, good_step);
            if (row) record();
            if (frame) {
                files_.write_frame(case_, system_.scales, system_.solver, nullptr, system_.plan.at(done_));
                good = checkpoint();
                good_step = done_;
            }
            if (last || stop || due(system_.plan, done_, saves)) files_.write_checkpoint(checkpoint(), done_);
            progress.update(
                {done_, system_.plan.at(done_), cells * static_cast<double>(system_.solver.evaluations())});
            if (stop && !last) return static_cast<int>(Exit::interrupted);
        }
        return static_cast<int>(Exit::done);
    }

    void check(const output::Checkpoint& good, long long good_step) {
        const std::size_t bad = system_.solver.first_bad_cell();
        if (bad == system_.solver.grid().view().layout.cells()) return;
        files_.write_checkpoint(good, good_step);
        const Vec3d at = system_.solver.centre(bad);
        throw NumericalError(
            fmt::format("fluid cell {} at ({:.3f}, {:.3f}, {:.3f}) um", bad, at.x, at.y, at.z),
            fmt::format("its density or velocity is no longer a sound number at {:.4g} s; the last "
                        "good state (step {}) is kept",
                        system_.plan.at(done_), good_step),
            "Shorten time.step or lower numerics.mach");
    }

    void record() {
        const fluid::ResidualNorm r = system_.solver.residual_norm();
        files_.add_row({static_cast<double>(done_), system_.plan.at(done_),
                        system_.solver.largest_speed() * system_.scales.velocity_um_per_s,
                        system_.solver.mean_density(), r.density, system_.plan.step});
    }

    [[nodiscard]] output::Checkpoint checkpoint() const {
        output::Checkpoint cp;
        for (int q = 0; q < 4; ++q)
            cp.put(names[q], system_.solver.state().interior(system_.solver.state().view().q[q]));
        cp.put_number("first_density", first_density_);
        cp.put_number("evaluations", evaluations());
        return cp;
    }

    [[nodiscard]] double evaluations() const {
        return evaluations_before_ + static_cast<double>(system_.solver.evaluations());
    }

    void finish(int code) {
        if (code == static_cast<int>(Exit::interrupted)) {
            files_.log().warn(fmt::format("interrupted at {:.4g} s; continue with: hemoflux run --restart {}",
                                          system_.plan.at(done_), files_.folder().path().string()));
            return;
        }
        output::Summary s = start_summary(case_);
        s.observables["largest_speed_um_per_s"] =
            system_.solver.largest_speed() * system_.scales.velocity_um_per_s;
        s.observables["time_s"] = system_.plan.at(done_);
        if (observer_) {
            const std::string failed = observer_->observe(s, files_.folder());
            if (!failed.empty()) files_.log().warn(failed);
        }
        if (case_.shear_rate) {
            const double strain = system_.plan.at(done_) * *case_.shear_rate;
            s.conservation.mean_density_per_strain =
                (system_.solver.mean_density() - first_density_) / strain;
            s.performance.residuals_per_strain = evaluations() / strain;
        }
        s.performance.wall_s = wall_s_;
        s.performance.cpu_s = output::cpu_seconds();
        s.performance.steps = static_cast<double>(done_);
        s.performance.cell_residuals_per_s =
            static_cast<double>(system_.solver.evaluations()) *
            static_cast<double>(system_.solver.grid().view().layout.cells()) / wall_s_;
        s.performance.peak_rss_mib = output::peak_rss_mib();
        s.errors_estimated["compressibility"] = system_.mach * system_.mach;
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        draw();
        files_.log().info(fmt::format("results are in {}", files_.folder().path().string()));
    }

    void draw() {
        if (!observer_ || !case_.output.pictures) {
            draw_pictures(case_, files_, "time in s");
            return;
        }
        const auto stem = files_.folder().path() / "plot_convergence";
        for (const auto& failed :
             {observer_->draw(files_.folder()),
              output::plot_convergence(files_.folder().history(), stem, case_.title).value_or("")})
            if (!failed.empty()) files_.log().warn(failed);
    }

    static constexpr const char* names[4] = {"fluid.density", "fluid.u", "fluid.v", "fluid.w"};
    const Case& case_;
    const RunOptions& options_;
    FluidSystem system_;  // before the files: a case that it refuses leaves nothing behind
    std::optional<FlowObserver> observer_;
    RunFiles files_;
    long long done_ = 0;
    double evaluations_before_ = 0, first_density_ = 1, wall_s_ = 0;
};

}  // namespace

int run_fluid(const Case& c, const RunOptions& options) {
    if (options.threads > 0) exchange::set_threads(options.threads);
    return FluidRun(c, options).go();
}

}  // namespace hemoflux::apps
