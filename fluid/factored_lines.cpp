#include "fluid/factored_lines.hpp"

#include <algorithm>

namespace hemoflux::fluid {

namespace {

/// 1/s of two neighbouring cells, raised where the explicit flux is stiffer: s/(2 delta) times.
double conductance(double width, double next, double delta) {
    const double s = (width + next) / 2,
                 reach = delta < std::min(width, next) ? delta : std::min(width, next);
    return std::max(1.0, s / (2 * reach)) / s;
}

}  // namespace

LineOperator line_operator(const std::vector<double>& widths, std::size_t ghosts, double strength,
                           double delta, bool periodic, double low, double high) {
    const std::size_t n = widths.size() - 2 * ghosts;
    LineOperator line{{}, {}, periodic, low, high};
    if (n == 1 && periodic) strength = 0;  // a line of one cell has no neighbours
    for (std::size_t i = 0; i < n; ++i) {
        const double dx = widths[i + ghosts];
        line.down.push_back(strength / dx * conductance(dx, widths[i + ghosts - 1], delta));
        line.up.push_back(strength / dx * conductance(dx, widths[i + ghosts + 1], delta));
    }
    return line;
}

LineOperator density_operator(const std::vector<double>& widths, std::size_t ghosts, double dt,
                              double lateral, bool periodic, double low, double high) {
    const std::size_t n = widths.size() - 2 * ghosts;
    LineOperator line{{}, {}, periodic, low, high};
    for (std::size_t i = 0; i < n; ++i) {
        const double dx = widths[i + ghosts];
        const auto across = [&](double next) {
            const double streaming = std::min({lateral, dx, next});
            return n == 1 && periodic ? 0.0 : dt * streaming / 3 / ((dx + next) / 2) / dx;
        };
        line.down.push_back(across(widths[i + ghosts - 1]));
        line.up.push_back(across(widths[i + ghosts + 1]));
    }
    return line;
}

HostLine factor_line(const LineOperator& op) {
    const bool periodic = op.periodic;
    const double low = op.low, high = op.high;
    const std::size_t n = op.down.size();
    HostLine line;
    line.lower.assign(n, 0.0);
    line.pivot.assign(n, 1.0);
    line.upper.assign(n, 0.0);
    std::vector<double> diagonal(n, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
        line.lower[i] = -op.down[i];
        line.upper[i] = -op.up[i];
        diagonal[i] = 1 + op.down[i] + op.up[i];
    }
    double corner_low = 0, corner_high = 0, gamma = 0;
    if (periodic) {
        // A = T + u v^T with u = (gamma, .., corner_high), v = (1, .., corner_low / gamma)
        corner_low = line.lower[0];
        corner_high = line.upper[n - 1];
        gamma = -diagonal[0];
        diagonal[0] -= gamma;
        diagonal[n - 1] -= corner_low * corner_high / gamma;
    } else {
        diagonal[0] += line.lower[0] * low;
        diagonal[n - 1] += line.upper[n - 1] * high;
    }
    line.lower[0] = 0;
    line.upper[n - 1] = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double eliminated = i > 0 ? line.lower[i] * line.upper[i - 1] : 0.0;
        line.pivot[i] = 1 / (diagonal[i] - eliminated);
        line.upper[i] *= line.pivot[i];
    }
    if (periodic) {
        std::vector<double> z(n, 0.0);
        z[0] += gamma;
        z[n - 1] += corner_high;
        double previous = 0;
        for (std::size_t i = 0; i < n; ++i)
            previous = z[i] = (z[i] - line.lower[i] * previous) * line.pivot[i];
        for (std::size_t i = n - 1; i-- > 0;) z[i] -= line.upper[i] * z[i + 1];
        line.cyclic = z;
        line.cyclic_last = corner_low / gamma;
        line.cyclic_scale = 1 / (1 + z[0] + line.cyclic_last * z[n - 1]);
    }
    return line;
}

}  // namespace hemoflux::fluid
