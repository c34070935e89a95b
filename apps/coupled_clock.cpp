#include "apps/coupled_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/cell_surface.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// Where an adaptive run begins, and below what it has failed, over the longest step.
constexpr double first_share = 1.0 / 64, least_share = 1e-4;
/// Intervals of fewer than this many of the longest steps are not met exactly: that would cost steps.
constexpr double steps_between_milestones = 4;
/// Part of an interval that counts as none.
constexpr double rounding = 1e-6;

coupling::StepBounds bounds_of(const Case& c, const CoupledSystem& system) {
    const double longest = system.plan.step;
    return {longest, least_share * longest, first_share * longest,
            c.time.tolerance.value_or(default_tolerance)};
}

}  // namespace

OutputIntervals::OutputIntervals(const OutputInput& out, double clock)
    : frame(out.interval ? *out.interval * clock : out.interval_strain),
      row(out.history_interval ? *out.history_interval * clock : out.history_interval_strain),
      checkpoint(out.checkpoint_interval ? *out.checkpoint_interval * clock
                                         : out.checkpoint_interval_strain) {}

CoupledClock::CoupledClock(const Case& c, CoupledSystem& system)
    : system_(system),
      intervals_(c.output, system.clock),
      end_(strain_of(c)),
      error_per_change_(1 / (2 * system.numerics.rate * rest_state(c.cells.front()).radius())),
      taken_(system.plan.step),
      leg_(end_, system.plan.step) {
    if (!c.time.adaptive) return;
    control_.emplace(bounds_of(c, system));
    system_.loop->watch_velocities();
    start_leg(0);
    taken_ = leg_.step;
    shortest_ = system.plan.step;
}

double CoupledClock::position(long long steps) const {
    if (!control_) return system_.plan.at(done_ + steps);
    const long long at = leg_done_ + steps;
    return at == leg_.steps ? to_ : from_ + leg_.at(at);
}

double CoupledClock::end() const { return control_ ? end_ : system_.plan.at(system_.plan.steps); }

bool CoupledClock::ended() const { return control_ ? now() >= end_ : done_ >= system_.plan.steps; }

bool CoupledClock::last() const { return control_ ? next() >= end_ : done_ + 1 == system_.plan.steps; }

double CoupledClock::milestone_after(double strain) const {
    double milestone = end_;
    for (const double interval : {intervals_.frame, intervals_.row, intervals_.checkpoint}) {
        if (interval < steps_between_milestones * control_->bounds().longest) continue;
        const double next = interval * (std::floor(strain / interval + rounding) + 1);
        if (next < end_ - rounding * interval) milestone = std::min(milestone, next);
    }
    return milestone;
}

void CoupledClock::start_leg(double from) {
    from_ = from;
    to_ = milestone_after(from);
    leg_ = StepPlan(to_ - from_, control_->step());
    leg_done_ = 0;
}

void CoupledClock::step() {
    if (!control_) {
        system_.loop->step(system_.numerics.step);
        ++done_;
        return;
    }
    taken_ = leg_.step;
    system_.loop->step(taken_ / system_.numerics.rate);
    ++done_;
    ++leg_done_;
    adapt();
}

void CoupledClock::adapt() {
    shortest_ = std::min(shortest_, taken_);
    longest_ = std::max(longest_, taken_);
    const double before = control_->step();
    if (const auto change = system_.loop->velocity_change()) {
        const double error = *change * error_per_change_;
        largest_error_ = std::max(largest_error_, error);
        control_->observe(taken_, error);
        if (control_->failed())
            throw NumericalError(
                fmt::format("{} moves with an error of {:.3g} R0 per strain unit in steps of G dt = {:.3g}",
                            system_.loop->most_changed(), error, taken_),
                fmt::format("time.tolerance = {:.3g} would take steps shorter than G dt = {:.3g}",
                            control_->bounds().tolerance, control_->bounds().shortest),
                "Raise time.tolerance, or leave time.adaptive out");
    }
    const bool changed = control_->step() != before;
    if (changed) ++changes_;
    if (!ended() && (changed || leg_done_ == leg_.steps)) start_leg(now());
}

void CoupledClock::end_here() {
    if (control_)
        end_ = now();
    else
        system_.plan.steps = done_;
}

std::string CoupledClock::report() const {
    if (!control_ || done_ == 0) return "";
    return fmt::format(
        "adaptive steps: {}, G dt = {:.3g} to {:.3g}, changed {} times; largest position error {:.3g} R0 per "
        "strain unit (estimated; tolerance {:.3g})",
        done_, shortest_, longest_, changes_, largest_error_, control_->bounds().tolerance);
}

void CoupledClock::save(output::Checkpoint& checkpoint) const {
    if (!control_) return;
    checkpoint.put("clock.leg",
                   {from_, to_, static_cast<double>(leg_.steps), static_cast<double>(leg_done_)});
    checkpoint.put("clock.control",
                   {control_->step(), taken_, shortest_, longest_, largest_error_,
                    static_cast<double>(changes_), static_cast<double>(control_->waiting())});
    checkpoint.put("clock.velocities", system_.loop->velocities());
}

void CoupledClock::load(const output::Checkpoint& checkpoint, long long done) {
    done_ = done;
    if (!control_) return;
    const auto& leg = checkpoint.array("clock.leg", 4);
    const auto& control = checkpoint.array("clock.control", 7);
    from_ = leg[0], to_ = leg[1];
    leg_.steps = static_cast<long long>(leg[2]);
    leg_.step = (to_ - from_) / leg[2];
    leg_done_ = static_cast<long long>(leg[3]);
    control_->restore(control[0], static_cast<int>(control[6]));
    taken_ = control[1], shortest_ = control[2], longest_ = control[3];
    largest_error_ = control[4], changes_ = static_cast<long long>(control[5]);
    system_.loop->restore_velocities(checkpoint.array("clock.velocities"));
}

}  // namespace hemoflux::apps
