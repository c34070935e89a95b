#include "apps/fluid_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "apps/flow_setup.hpp"
#include "apps/interrupt.hpp"
#include "apps/output/progress.hpp"
#include "apps/run_files.hpp"
#include "apps/schedule.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// Mach number of the fastest wall (or estimated stream) where the case gives none.
constexpr double default_mach = 0.1;
/// Share of the largest stable step that is used where the case gives none.
constexpr double step_share = 0.9;
constexpr long long watch_interval = 25;

/// Largest speed that the boundary conditions, the shear or the driving force suggest, um/s. A driven stream
/// is taken as plane Poiseuille flow between the closest sides that are not periodic: u = f w^2/(8 mu).
double fastest(const Case& c, const meshing::RectilinearGrid& grid) {
    double speed = c.shear_rate ? *c.shear_rate * shear_reach(grid) : 0;
    double width = 1e300, low = 1e300, high = -1e300;
    for (std::size_t a = 0; a < 3; ++a) {
        for (const PatchInput& p : c.boundary[a]) {
            if (p.velocity == VelocityCondition::vector)
                speed = std::max(speed, std::hypot(p.vector[0], p.vector[1], p.vector[2]));
            if (p.density == DensityCondition::pressure)
                low = std::min(low, p.value), high = std::max(high, p.value);
        }
        if (!c.periodic(a)) width = std::min(width, grid.axes[a].length());
    }
    const double acceleration = std::hypot(c.acceleration[0], c.acceleration[1], c.acceleration[2]);
    if (width < 1e300) {
        constexpr double per_um = 1e-6;                          // m
        double drive = c.fluid.density * acceleration * per_um;  // Pa/um
        if (high > low) drive += (high - low) / grid.axes[0].length();
        speed = std::max(speed, drive * width * width / (8 * c.fluid.viscosity));
    }
    if (!(speed > 0))
        throw InputError("the flow",
                         "no side moves, no pressure differs and no force acts, so nothing will flow",
                         "give a velocity, a pressure difference, [shear] or [body_force]");
    return speed;
}

class FluidRun {
  public:
    FluidRun(const Case& c, const RunOptions& options)
        : case_(c),
          options_(options),
          files_(c, options),
          grid_(make_grid(c.grid)),
          scales_(make_scales()),
          solver_(make_solver()),
          plan_(duration(), step()) {}

    int go() {
        const auto start = std::chrono::steady_clock::now();
        begin();
        const int code = march();
        wall_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        finish(code);
        return code;
    }

  private:
    [[nodiscard]] double duration() const {
        return case_.time.duration ? *case_.time.duration : *case_.time.strain / *case_.shear_rate;
    }

    Scales make_scales() {
        speed_ = fastest(case_, grid_);
        mach_ = case_.numerics.mach.value_or(default_mach);
        Scales s;
        s.velocity_um_per_s = std::sqrt(3.0) * speed_ / mach_;
        const double metres_per_s = s.velocity_um_per_s * 1e-6;
        s.density = case_.fluid.density;
        s.pressure_pa = s.density * metres_per_s * metres_per_s;
        s.viscosity_pa_s = s.density * metres_per_s * 1e-6;
        return s;
    }

    [[nodiscard]] double rate() const { return case_.shear_rate.value_or(0) / scales_.velocity_um_per_s; }

    fluid::Solver make_solver() const {
        fluid::SolverOptions o;
        o.nu = case_.fluid.viscosity / scales_.viscosity_pa_s;
        o.with_force = case_.acceleration != Triple{};
        o.gamma = case_.numerics.gamma;
        o.tau_floor = case_.numerics.tau_floor;
        o.scheme = scheme_of(case_.time.scheme);
        fluid::Solver solver(grid_, make_patches(case_, scales_, rate()), o);
        solver.initialise(initial_flow(case_, rate()));
        if (o.with_force) {
            // rho a in lattice units: um/s^2 over c^2/um
            const double factor = 1e6 / (scales_.velocity_um_per_s * scales_.velocity_um_per_s);
            const std::size_t cells = solver.grid().view().layout.cells();
            for (std::size_t a = 0; a < 3; ++a)
                solver.state().set_interior(solver.state().view().force[a],
                                            std::vector<double>(cells, factor * case_.acceleration[a]));
        }
        return solver;
    }

    [[nodiscard]] double step() const {
        if (case_.time.step) return *case_.time.step;
        if (case_.numerics.step_strain) return *case_.numerics.step_strain / *case_.shear_rate;
        return step_share * scales_.time_s() *
               fluid::stable_step(solver_.grid(), solver_.options().scheme, solver_.options().nu,
                                  mach_ / std::sqrt(3.0));
    }

    [[nodiscard]] double interval(double strain) const {
        if (case_.output.interval) return *case_.output.interval;
        return case_.shear_rate ? strain / *case_.shear_rate : duration() / 20;
    }

    void begin() {
        files_.log().info(
            fmt::format("{}\n  grid          {} x {} x {} cells, smallest {:.4g} um\n"
                        "  fluid         nu/h = {:.3g}, Ma = {:.3g} at {:.4g} um/s\n"
                        "  step          {} steps of {:.4g} s\n"
                        "  conversion    length 1 um; velocity c = {:.4g} um/s; lattice time = {:.4g} s; "
                        "stress = {:.4g} Pa",
                        case_.title, grid_.axes[0].cells(), grid_.axes[1].cells(), grid_.axes[2].cells(),
                        grid_.smallest(), solver_.options().nu / grid_.smallest(), mach_, speed_, plan_.steps,
                        plan_.step, scales_.velocity_um_per_s, scales_.time_s(), scales_.pressure_pa));
        if (files_.restart()) {
            for (int q = 0; q < 4; ++q)
                solver_.state().set_interior(
                    solver_.state().view().q[q],
                    files_.restart()->array(names[q], solver_.grid().view().layout.cells()));
            first_density_ = files_.restart()->number("first_density");
        } else {
            first_density_ = solver_.mean_density();
        }
        done_ = files_.first_step();
        files_.start_history(
            {"step", "time_s", "largest_speed_um_per_s", "mean_density", "residual", "dt_s"});
        files_.start_series(plan_.at(done_));
        if (!files_.restart()) {
            record();
            files_.write_frame(case_, scales_, solver_, nullptr, 0);
        }
    }

    int march() {
        output::Progress progress(plan_.at(done_), plan_.at(plan_.steps), "s", options_.quiet);
        const auto cells = static_cast<double>(solver_.grid().view().layout.cells());
        const double frames = interval(case_.output.interval_strain), rows = frames / 10;
        output::Checkpoint good = checkpoint();
        long long good_step = done_;
        while (done_ < plan_.steps) {
            solver_.step(plan_.step / scales_.time_s());
            ++done_;
            const bool last = done_ == plan_.steps, frame = last || due(plan_, done_, frames);
            const bool row = frame || due(plan_, done_, rows), stop = interrupted();
            if (row || stop || done_ % watch_interval == 0) check(good, good_step);
            if (row) record();
            if (frame) {
                files_.write_frame(case_, scales_, solver_, nullptr, plan_.at(done_));
                good = checkpoint();
                good_step = done_;
            }
            if (last || stop || due(plan_, done_, frames)) files_.write_checkpoint(checkpoint(), done_);
            progress.update({done_, plan_.at(done_), cells * static_cast<double>(solver_.evaluations())});
            if (stop && !last) return static_cast<int>(Exit::interrupted);
        }
        return static_cast<int>(Exit::done);
    }

    void check(const output::Checkpoint& good, long long good_step) {
        const std::size_t bad = solver_.first_bad_cell();
        if (bad == solver_.grid().view().layout.cells()) return;
        files_.write_checkpoint(good, good_step);
        const Vec3d at = solver_.centre(bad);
        throw NumericalError(
            fmt::format("fluid cell {} at ({:.3f}, {:.3f}, {:.3f}) um", bad, at.x, at.y, at.z),
            fmt::format("its density or velocity is no longer a sound number at {:.4g} s; the last "
                        "good state (step {}) is kept",
                        plan_.at(done_), good_step),
            "shorten time.step or lower numerics.mach");
    }

    void record() {
        const fluid::ResidualNorm r = solver_.residual_norm();
        files_.add_row({static_cast<double>(done_), plan_.at(done_),
                        solver_.largest_speed() * scales_.velocity_um_per_s, solver_.mean_density(),
                        r.density, plan_.step});
    }

    [[nodiscard]] output::Checkpoint checkpoint() const {
        output::Checkpoint cp;
        for (int q = 0; q < 4; ++q) cp.put(names[q], solver_.state().interior(solver_.state().view().q[q]));
        cp.put_number("first_density", first_density_);
        return cp;
    }

    void finish(int code) {
        if (code == static_cast<int>(Exit::interrupted)) {
            files_.log().warn(fmt::format("interrupted at {:.4g} s; continue with: hemoflux run --restart {}",
                                          plan_.at(done_), files_.folder().path().string()));
            return;
        }
        output::Summary s = start_summary(case_);
        s.observables["largest_speed_um_per_s"] = solver_.largest_speed() * scales_.velocity_um_per_s;
        s.observables["time_s"] = plan_.at(done_);
        if (case_.shear_rate)
            s.conservation.mean_density_per_strain =
                (solver_.mean_density() - first_density_) / (plan_.at(done_) * *case_.shear_rate);
        s.performance.wall_s = wall_s_;
        s.performance.cpu_s = output::cpu_seconds();
        s.performance.steps = static_cast<double>(done_);
        s.performance.cell_residuals_per_s = static_cast<double>(solver_.evaluations()) *
                                             static_cast<double>(solver_.grid().view().layout.cells()) /
                                             wall_s_;
        s.performance.peak_rss_mib = output::peak_rss_mib();
        s.errors_estimated["compressibility"] = mach_ * mach_;
        output::write_summary(files_.folder().summary(), s);
        files_.log().info(output::to_table(s));
        draw_pictures(case_, files_);
        files_.log().info(fmt::format("results are in {}", files_.folder().path().string()));
    }

    static constexpr const char* names[4] = {"fluid.density", "fluid.u", "fluid.v", "fluid.w"};
    const Case& case_;
    const RunOptions& options_;
    RunFiles files_;
    meshing::RectilinearGrid grid_;
    double speed_ = 0, mach_ = 0;
    Scales scales_;
    fluid::Solver solver_;
    StepPlan plan_;
    long long done_ = 0;
    double first_density_ = 1, wall_s_ = 0;
};

}  // namespace

int run_fluid(const Case& c, const RunOptions& options) {
    catch_interrupts();
    if (options.threads > 0) exchange::set_threads(options.threads);
    return FluidRun(c, options).go();
}

}  // namespace hemoflux::apps
