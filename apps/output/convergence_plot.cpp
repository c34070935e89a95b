#include "apps/output/convergence_plot.hpp"

#include <cmath>
#include <exception>

#include "apps/output/history.hpp"
#include "apps/output/plot.hpp"

namespace hemoflux::output {

std::optional<std::string> plot_convergence(const std::filesystem::path& history,
                                            const std::filesystem::path& stem, const std::string& title) {
    try {
        const Table table = read_table(history);
        PlotSpec spec;
        spec.title = title;
        spec.x_label = table.columns.front() == "step" ? "iteration" : table.columns.front();
        spec.y_label = "residual (root mean square)";
        spec.log_y = true;
        for (const std::string& name : table.columns) {
            if (!name.starts_with("residual")) continue;
            Curve curve;
            curve.label = name;
            const auto x = table.column(table.columns.front()), y = table.column(name);
            for (std::size_t i = 0; i < x.size(); ++i)
                if (y[i] > 0 && std::isfinite(y[i])) curve.x.push_back(x[i]), curve.y.push_back(y[i]);
            if (curve.x.size() >= 3) spec.curves.push_back(std::move(curve));
        }
        if (spec.curves.empty()) return std::nullopt;
        return plot(spec, stem);
    } catch (const std::exception& error) {
        return "no plot " + stem.filename().string() + ": " + error.what();
    }
}

}  // namespace hemoflux::output
