#include "apps/suspension_observer.hpp"

#include <algorithm>
#include <cmath>

#include "apps/case_suspension.hpp"
#include "membrane/diagnostics.hpp"

namespace hemoflux::apps {
namespace {

/// Between walls that shear what is periodic along them.
bool plain_shear(const Case& c) {
    const auto shears = [](const PatchInput& side) { return side.velocity == VelocityCondition::shear; };
    return c.periodic(0) && c.periodic(2) && !c.periodic(1) && shears(c.boundary[1][0]) &&
           shears(c.boundary[1][1]);
}

}  // namespace

bool SuspensionObserver::wanted(const Case& c) { return c.cells.size() > 1 || undisturbed_flow(c); }

SuspensionObserver::SuspensionObserver(const Case& c, CoupledSystem& system)
    : system_(system),
      channel_(undisturbed_flow(c)),
      axis_(channel_ ? channel_->axis() : 0),
      sheared_(plain_shear(c)),
      gaps_(c.cells.size() > 1),
      rate_(c.shear_rate.value_or(0)) {
    if (system.box_solver() && c.time.scheme != TimeScheme::rk4)
        balance_.emplace(*system.box_solver(), *system.loop);
    double cells = 0, box = 0;
    for (std::size_t i = 0; i < system.cells->cells(); ++i)
        cells +=
            membrane::shape_moments(system.cells->topology().triangles(), system.cells->positions(i)).volume;
    for (std::size_t i = 0; i < system.fluid->cells(); ++i) box += system.fluid->volume(i);
    haematocrit_ = cells / box;
}

std::vector<std::string> SuspensionObserver::columns() const {
    std::vector<std::string> names{"cell_speed_um_s", "flow_speed_um_s"};
    if (channel_ || sheared_) names.emplace_back("relative_viscosity");
    if (gaps_) names.emplace_back("smallest_gap_um");
    if (balance_) names.emplace_back("momentum_error");
    return names;
}

void SuspensionObserver::before_step() {
    if (balance_) balance_->before();
}

double SuspensionObserver::mean_cell_position() const {
    const membrane::Batch& cells = *system_.cells;
    double sum = 0;
    for (std::size_t i = 0; i < cells.cells(); ++i)
        sum += component(membrane::shape_moments(cells.topology().triangles(), cells.positions(i)).centroid,
                         axis_);
    return sum / static_cast<double>(cells.cells());
}

double SuspensionObserver::mean_flow() const {
    const std::vector<double> u = system_.fluid->values(1 + static_cast<int>(axis_));
    double sum = 0, volume = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double v = system_.fluid->volume(i);
        sum += v * u[i];
        volume += v;
    }
    return sum / volume * system_.scales.velocity_um_per_s;
}

double SuspensionObserver::relative_viscosity(double flow, const std::array<Vec3d, 6>& flux) const {
    if (channel_) return channel_->mean_speed() / flow;
    const auto& axes = system_.domain.box->axes;
    const double area = axes[0].length() * axes[2].length();
    return (flux[2].x - flux[3].x) / (2 * area * system_.numerics.nu * system_.numerics.rate);
}

std::vector<double> SuspensionObserver::observe(double strain, double step) {
    const double position = mean_cell_position(), flow = mean_flow();
    const double seconds = (strain - last_strain_) / rate_;
    std::vector<double> row{strain_.empty() ? NAN : (position - last_position_) / seconds, flow};
    last_strain_ = strain;
    last_position_ = position;
    coupling::MomentumStep balance;
    if (balance_ && step > 0)
        balance = balance_->after(step);
    else if (sheared_)
        balance.flux = system_.box_solver()->border_momentum();
    if (channel_ || sheared_) row.push_back(relative_viscosity(flow, balance.flux));
    if (gaps_)
        row.push_back(
            std::min(system_.loop->cells()->smallest_gap().distance, system_.loop->cells()->gap_reach()));
    if (balance_) row.push_back(step > 0 ? balance.error() : 0);
    strain_.push_back(strain);
    records_.insert(records_.end(), row.begin(), row.end());
    return row;
}

std::map<std::string, double> SuspensionObserver::observables(double from, double to) const {
    const std::vector<std::string> names = columns();
    std::map<std::string, double> result{{"tube_haematocrit", haematocrit_}};
    for (std::size_t k = 0; k < names.size(); ++k) {
        double sum = 0, count = 0, least = INFINITY, most = 0;
        for (std::size_t i = 0; i < strain_.size(); ++i) {
            const double value = records_[i * names.size() + k];
            least = std::min(least, value);
            most = std::max(most, value);
            if (!(strain_[i] >= from - 1e-9 && strain_[i] <= to + 1e-9) || std::isnan(value)) continue;
            sum += value;
            ++count;
        }
        result[names[k]] = names[k] == "smallest_gap_um"  ? least
                           : names[k] == "momentum_error" ? most
                                                          : sum / count;
    }
    if (channel_)
        result["discharge_haematocrit"] =
            haematocrit_ * result["cell_speed_um_s"] / result["flow_speed_um_s"];
    return result;
}

void SuspensionObserver::save(output::Checkpoint& checkpoint) const {
    checkpoint.put("suspension.strain", strain_);
    checkpoint.put("suspension.records", records_);
    checkpoint.put("suspension.last", {last_strain_, last_position_, haematocrit_});
}

void SuspensionObserver::load(const output::Checkpoint& checkpoint) {
    strain_ = checkpoint.array("suspension.strain");
    records_ = checkpoint.array("suspension.records", strain_.size() * columns().size());
    const auto& last = checkpoint.array("suspension.last", 3);
    last_strain_ = last[0], last_position_ = last[1], haematocrit_ = last[2];
}

}  // namespace hemoflux::apps
