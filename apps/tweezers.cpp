#include "apps/tweezers.hpp"

#include <algorithm>
#include <cmath>

#include "apps/output/history.hpp"

namespace hemoflux::apps {
namespace {

Experiment::Diameter diameter(const output::Table& table, const std::string& name) {
    const auto optional = [&](const std::string& column) {
        const auto& names = table.columns;
        return std::find(names.begin(), names.end(), column) == names.end() ? std::vector<double>()
                                                                            : table.column(column);
    };
    return {table.column(name + "_um"), optional(name + "_lo"), optional(name + "_hi")};
}

bool has_bars(const Experiment::Diameter& d) { return !d.low.empty() && !d.high.empty(); }

}  // namespace

Experiment read_experiment(const std::filesystem::path& file) {
    const output::Table table = output::read_table(file);
    return {table.column("F_pN"), diameter(table, "DA"), diameter(table, "DT")};
}

Distance distance(const DiameterCurve& computed, const std::vector<double>& force,
                  const Experiment::Diameter& measured) {
    Distance d;
    d.with_bars = has_bars(measured);
    double sum = 0;
    const auto& f = computed.force;
    for (std::size_t m = 0; m < force.size(); ++m) {
        const auto upper = std::lower_bound(f.begin(), f.end(), force[m]);
        if (upper == f.end() || (upper == f.begin() && *upper != force[m])) continue;
        const auto i = static_cast<std::size_t>(upper - f.begin());
        const double t = i == 0 ? 0 : (force[m] - f[i - 1]) / (f[i] - f[i - 1]);
        const double before = i == 0 ? 0 : computed.value[i - 1];
        const double value = i == 0 ? computed.value[0] : before + t * (computed.value[i] - before);
        sum += (value - measured.value[m]) * (value - measured.value[m]);
        ++d.points;
        if (d.with_bars && value >= measured.low[m] && value <= measured.high[m]) ++d.inside;
    }
    d.rms_um = d.points > 0 ? std::sqrt(sum / d.points) : NAN;
    return d;
}

output::Curve measured_curve(const std::string& label, const std::vector<double>& force,
                             const Experiment::Diameter& measured) {
    output::Curve curve{.label = label, .x = force, .y = measured.value, .points = true, .colour = 6};
    if (has_bars(measured)) {
        curve.y_low = measured.low;
        curve.y_high = measured.high;
    }
    return curve;
}

}  // namespace hemoflux::apps
