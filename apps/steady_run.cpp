#include "apps/steady_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "apps/output/convergence_plot.hpp"
#include "coupling/held_bodies.hpp"
#include "exchange/error.hpp"
#include "fluid/cell_report.hpp"
#include "fluid/probe.hpp"
#include "fluid/steady.hpp"

namespace hemoflux::apps {
namespace {

/// Iterations between two rows of the history when they are many.
constexpr std::size_t row_interval = 10;

fluid::SteadyOptions steady_options(const SteadyInput& in, const std::optional<int>& patience) {
    fluid::SteadyOptions o;
    o.method =
        in.method == SteadyMethod::implicit ? fluid::SteadyMethod::newton : fluid::SteadyMethod::local_steps;
    o.criterion = in.criterion == SteadyCriterion::momentum   ? fluid::SteadyCriterion::momentum_x
                  : in.criterion == SteadyCriterion::residual ? fluid::SteadyCriterion::residual
                                                              : fluid::SteadyCriterion::velocity_change;
    o.tolerance = in.tolerance;
    o.most_iterations = static_cast<std::size_t>(in.iterations);
    o.sigma = in.sigma;
    o.c = in.viscous_weight;
    if (patience) o.patience = o.newton_patience = static_cast<std::size_t>(*patience);
    return o;
}

/// The flow of another run, interpolated and in this one's units.
void start_from(const std::filesystem::path& folder, FluidSystem& system) {
    const Case c = read_case(folder / "resolved.toml");
    if (c.kind != CaseKind::fluid)
        throw InputError(fmt::format("steady.start = {}", folder.string()),
                         "it is not a run of kind \"fluid\"", "Give the folder of a run of the same flow");
    const FluidSystem other(c);
    load_flow(*other.flow, output::latest_checkpoint(folder).checkpoint);
    const auto probe = fluid::make_probe(*other.flow);
    const double speed = other.scales.velocity_um_per_s / system.scales.velocity_um_per_s;
    const double pressure = other.options().gamma * other.scales.pressure_pa /
                            (system.options().gamma * system.scales.pressure_pa);
    system.flow->initialise([&](const Vec3d& x) {
        const auto [density, u, v, w] = (*probe)(x);
        return fluid::FlowPoint{1 + pressure * (density - 1), {speed * u, speed * v, speed * w}};
    });
}

class SteadyRun {
  public:
    SteadyRun(const Case& c, const RunOptions& options)
        : case_(c),
          options_(options),
          system_(started(c)),
          held_(hold()),
          observer_(make_observer()),
          files_(c, options) {}

    int go() {
        prepare_stop(options_);
        files_.log().info(describe(case_, system_));
        if (!system_.reasoning.empty()) files_.log().info(system_.reasoning);
        files_.start_history({"step", "measure", "residual_density", "residual_u", "residual_v", "residual_w",
                              "evaluations", "cpu_s", "krylov", "courant"});
        files_.start_series(0);
        const auto start = std::chrono::steady_clock::now();
        int code = static_cast<int>(Exit::done);
        try {
            code = watched(files_.log(), [this] { return iterate(); });
        } catch (const NumericalError&) {
            keep_last_good_state();
            throw;
        }
        wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        keep();
        if (code != static_cast<int>(Exit::done)) {
            files_.log().warn("interrupted; start another run from here with --set steady.start=" +
                              files_.folder().path().string());
            return code;
        }
        report();
        if (result_.end == fluid::SteadyEnd::stalled)
            watched(files_.log(), [this] { return report_stall(); });
        return code;
    }

  private:
    static FluidSystem started(const Case& c) {
        FluidSystem system(c);
        if (!c.steady->start.empty()) start_from(c.steady->start, system);
        return system;
    }

    std::unique_ptr<coupling::HeldBodies> hold() {
        if (!system_.bodies) return nullptr;
        return std::make_unique<coupling::HeldBodies>(dynamic_cast<fluid::Solver&>(*system_.flow),
                                                      kernel_of(case_.coupling.kernel),
                                                      system_.bodies->all());
    }

    std::optional<FlowObserver> make_observer() {
        if (!case_.observables) return std::nullopt;
        return FlowObserver(case_, system_.scales, system_.domain.bounds, system_.options().gamma,
                            *system_.flow);
    }

    int iterate() {
        const fluid::SteadyOptions options = steady_options(*case_.steady, case_.watchdog.patience);
        const auto each = [&](const fluid::SteadyRecord& r) {
            if (options.method == fluid::SteadyMethod::newton || r.iteration % row_interval == 1) {
                record(r);
                good_ = state();
                good_iteration_ = r.iteration;
            }
            const auto iteration = static_cast<long long>(r.iteration);
            return !stop_asked(options_, {iteration, static_cast<double>(iteration),
                                          static_cast<double>(options.most_iterations)});
        };
        result_ = fluid::find_steady_state(*system_.flow, options, each, held_.get());
        if (held_) held_->settle();
        if (options.method != fluid::SteadyMethod::newton) record(result_.last);
        files_.log().info(fmt::format("{}: {} iterations, {} residual evaluations, measure {:.3g}",
                                      fluid::describe(result_.end), result_.last.iteration,
                                      result_.last.evaluations, result_.last.measure));
        return static_cast<int>(result_.end == fluid::SteadyEnd::interrupted ? Exit::interrupted
                                                                             : Exit::done);
    }

    void record(const fluid::SteadyRecord& r) {
        const fluid::ResidualNorm& n = r.residual;
        files_.add_row({static_cast<double>(r.iteration), r.measure, n.density, n.momentum[0], n.momentum[1],
                        n.momentum[2], static_cast<double>(r.evaluations), r.seconds,
                        static_cast<double>(r.krylov), r.courant});
    }

    [[nodiscard]] output::Checkpoint state() const {
        output::Checkpoint checkpoint;
        save_flow(*system_.flow, checkpoint);
        if (system_.bodies) system_.bodies->save(checkpoint);
        return checkpoint;
    }

    void keep() {
        write_frame(files_, case_, system_, 0);
        files_.write_checkpoint(state(), static_cast<long long>(result_.last.iteration));
    }

    void keep_last_good_state() {
        if (good_iteration_ == 0) return;
        files_.write_checkpoint(good_, static_cast<long long>(good_iteration_));
        files_.log().warn(
            fmt::format("the state of iteration {} is kept; start another run from there with --set "
                        "steady.start={}",
                        good_iteration_, files_.folder().path().string()));
    }

    /// Ends a run whose residual no longer falls; the results are written, but they are not those of a steady flow.
    [[noreturn]] int report_stall() const {
        throw NumericalError(
            fmt::format("the residual stalls at {:.3g} of its first value, the largest part in {}",
                        result_.lowest,
                        fluid::describe_cell(*system_.flow, fluid::least_steady_cell(*system_.flow))),
            "it no longer falls, so the flow is not steady: it may oscillate by itself, or a corner or a "
            "limit on tau "
            "feeds it; the last state is kept",
            "raise steady.tolerance or watchdog.patience, choose another steady.method, or go on in time "
            "with [time] in "
            "place of [steady]");
    }

    void report() {
        if (result_.end != fluid::SteadyEnd::converged)
            files_.log().warn(
                fmt::format("the steady state is not reached: {}", fluid::describe(result_.end)));
        output::Summary s = start_summary(case_);
        s.observables["converged"] = result_.end == fluid::SteadyEnd::converged;
        s.observables["iterations"] = static_cast<double>(result_.last.iteration);
        s.observables["residual_evaluations"] = static_cast<double>(result_.last.evaluations);
        s.observables["residual"] = result_.last.measure;
        s.observables["gamma"] = system_.options().gamma;
        s.observables["cells"] = static_cast<double>(system_.flow->cells());
        s.observables["largest_speed_um_per_s"] =
            system_.flow->largest_speed() * system_.scales.velocity_um_per_s;
        const auto warn = [this](const std::string& text) {
            if (!text.empty()) files_.log().warn(text);
        };
        if (observer_) warn(observer_->observe(s, files_.folder()));
        if (system_.bodies) s.observables.merge(system_.bodies->observables(*system_.flow, {}, 0));
        if (system_.errors) {
            system_.errors->observe(*system_.flow, 0);
            system_.errors->report(s);
            warn(system_.errors->write(files_.folder(), case_.title, case_.output.pictures));
        }
        add_performance(s, system_, static_cast<double>(result_.last.iteration), wall_s_,
                        output::cpu_seconds() - cpu_before_);
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        draw();
        files_.log().info(closing_line(files_.folder().path()));
    }

    void draw() {
        if (!case_.output.pictures) return;
        const auto warn = [this](const std::string& text) {
            if (!text.empty()) files_.log().warn(text);
        };
        const output::OutputFolder& folder = files_.folder();
        warn(output::plot_convergence(folder.history(), folder.path() / "plot_convergence", case_.title)
                 .value_or(""));
        if (observer_)
            warn(observer_->draw(folder));
        else if (system_.domain.box)
            draw_pictures(case_, files_, "steady");
    }

    const Case& case_;
    const RunOptions& options_;
    const double cpu_before_ = output::cpu_seconds();  // a sweep makes many runs in one process
    FluidSystem system_;
    std::unique_ptr<coupling::HeldBodies> held_;  ///< where the case has bodies
    std::optional<FlowObserver> observer_;
    RunFiles files_;
    fluid::SteadyResult result_;
    output::Checkpoint good_;
    std::size_t good_iteration_ = 0;
    double wall_s_ = 0;
};

}  // namespace

int run_steady(const Case& c, const RunOptions& options) {
    if (!options.restart.empty())
        throw InputError("--restart with [steady]",
                         "its residual is measured against that of the first iteration",
                         "Run it anew from there: --set steady.start=" + options.restart.string());
    return SteadyRun(c, options).go();
}

void write_frame(RunFiles& files, const Case& c, const FluidSystem& system, double position) {
    if (const fluid::Solver* box = system.box_solver())
        files.write_frame(c, system.scales, *box, nullptr, system.bodies.get(), position);
    else
        files.write_flow(c, system.scales, dynamic_cast<const fluid::HexSolver&>(*system.flow),
                         *system.domain.mesh, nullptr, system.bodies.get(), system.loop.get(), position);
}

}  // namespace hemoflux::apps
