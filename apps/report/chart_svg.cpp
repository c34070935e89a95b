#include "apps/report/chart_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/report/html.hpp"
#include "apps/report/ticks.hpp"

namespace hemoflux::report {
namespace {

using output::Curve;

constexpr double width = 420, height = 264, top = 26, bottom = 40, right = 12, character = 6.4;
constexpr std::size_t colours = 7, most_points = 500;

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void include(double value, bool positive) {
        if (!std::isfinite(value) || (positive && !(value > 0))) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] bool empty() const { return low > high; }
    /// Some air at both ends.
    void widen(double part, bool logarithmic) {
        if (empty()) return;
        if (logarithmic) {
            const double factor = std::pow(high / low, part);
            low /= factor;
            high *= factor;
        } else {
            const double air = part * (high - low);
            low -= air;
            high += air;
        }
    }
};

std::array<double, 2> bar(const Curve& c, std::size_t i) {
    if (i < c.y_low.size() && i < c.y_high.size()) return {c.y_low[i], c.y_high[i]};
    const double e = i < c.y_error.size() ? c.y_error[i] : 0.0;
    return {c.y[i] - e, c.y[i] + e};
}

bool has_bars(const Curve& c) { return !c.y_low.empty() || !c.y_error.empty(); }

std::size_t colour_of(const Curve& c, std::size_t i) {
    return (c.colour < 0 ? i : static_cast<std::size_t>(c.colour)) % colours;
}

/// Maps data to the drawing.
struct Frame {
    AxisTicks x, y;
    double left = 0;
    [[nodiscard]] double wide() const { return width - left - right; }
    [[nodiscard]] double high() const { return height - top - bottom; }
    [[nodiscard]] double px(double v) const { return left + wide() * x.place(v); }
    [[nodiscard]] double py(double v) const { return top + high() * (1 - y.place(v)); }
};

Frame frame_of(const Chart& chart) {
    const auto& plot = chart.plot;
    Range x, y;
    for (const Curve& c : plot.curves)
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            if (!std::isfinite(c.y[i])) continue;
            x.include(c.x[i], plot.log_x);
            y.include(c.y[i], plot.log_y);
            if (has_bars(c))
                for (const double end : bar(c, i)) y.include(end, plot.log_y);
        }
    for (const auto& band : plot.bands) {
        y.include(band.low, plot.log_y);
        y.include(band.high, plot.log_y);
    }
    const bool points =
        std::any_of(plot.curves.begin(), plot.curves.end(), [](const Curve& c) { return c.points; });
    if (points) x.widen(0.04, plot.log_x);
    y.widen(0.06, plot.log_y);
    if (plot.y_low) y.low = *plot.y_low;
    if (plot.y_high) y.high = *plot.y_high;
    Frame frame{make_ticks(x.low, x.high, plot.log_x, 5), make_ticks(y.low, y.high, plot.log_y, 5), 0};
    std::size_t longest = 1;
    for (const std::string& label : frame.y.labels)
        // bytes that continue a character take no room
        longest =
            std::max(longest, static_cast<std::size_t>(std::count_if(
                                  label.begin(), label.end(), [](char c) { return (c & 0xC0) != 0x80; })));
    frame.left = 14 + character * static_cast<double>(longest);
    return frame;
}

/// The points to draw: all, or of each of many equal parts of the curve its first, lowest, highest and last.
std::vector<std::size_t> thinned(const Curve& c) {
    std::vector<std::size_t> kept;
    const std::size_t n = c.x.size(), parts = n <= most_points ? n : most_points / 4;
    for (std::size_t p = 0; p < parts; ++p) {
        const std::size_t first = p * n / parts, last = (p + 1) * n / parts - 1;
        std::size_t low = first, high = first;
        for (std::size_t i = first; i <= last; ++i) {
            if (!(c.y[i] >= c.y[low])) low = i;
            if (!(c.y[i] <= c.y[high])) high = i;
        }
        for (const std::size_t i : {first, std::min(low, high), std::max(low, high), last})
            if (kept.empty() || i > kept.back()) kept.push_back(i);
    }
    return kept;
}

std::string line(const Frame& f, const Curve& c) {
    std::string path;
    bool pen = false;
    for (const std::size_t i : thinned(c)) {
        const double x = f.px(c.x[i]), y = f.py(c.y[i]);
        if (!std::isfinite(x) || !std::isfinite(y)) {
            pen = false;
            continue;
        }
        path += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x, y);
        pen = true;
    }
    return path;
}

std::string symbol(std::size_t which, double x, double y) {
    constexpr double r = 3.2;
    switch (which % 3) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>", x, y, r);
        case 1:
            return fmt::format("<path d=\"M{:.1f} {:.1f}h{}v{}h-{}z\"/>", x - r, y - r, 2 * r, 2 * r, 2 * r);
        default:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l{} {}h-{}z\"/>", x, y - 1.2 * r, 1.2 * r, 2.2 * r,
                               2.4 * r);
    }
}

std::string points(const Frame& f, const Curve& c, std::size_t which) {
    std::string marks;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
        const double x = f.px(c.x[i]), y = f.py(c.y[i]);
        if (!std::isfinite(x) || !std::isfinite(y)) continue;
        if (const auto [low, high] = bar(c, i); has_bars(c) && std::isfinite(low) && std::isfinite(high))
            marks +=
                fmt::format("<path class=\"bar\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x, f.py(low), f.py(high));
        marks += symbol(which, x, y);
    }
    return marks;
}

/// How the line or the symbols of curve i look: its colour, and what tells it apart without one.
struct Style {
    std::size_t colour, symbol;
    std::string dashes;
};

Style style_of(const Chart& chart, std::size_t i) {
    const auto& curves = chart.plot.curves;
    Style style{colour_of(curves[i], i), i, ""};
    // points without a name belong to those before
    while (style.symbol > 0 && curves[style.symbol].label.empty() && curves[style.symbol - 1].points)
        --style.symbol;
    if (curves[i].dashed) style.dashes = " dashed";
    const bool chosen = std::any_of(curves.begin(), curves.end(), [](const Curve& c) { return c.dashed; });
    if (chosen || curves[i].points) return style;
    const auto before = std::count_if(curves.begin(), curves.begin() + static_cast<std::ptrdiff_t>(i),
                                      [](const Curve& c) { return !c.points; });
    style.dashes = fmt::format(" d{}", before % 4);
    return style;
}

std::string curve(const Frame& f, const Curve& c, const Style& style) {
    if (c.points)
        return fmt::format("<g class=\"points c{}\">{}</g>\n", style.colour, points(f, c, style.symbol));
    return fmt::format("<path class=\"line c{}{}\" d=\"{}\"/>\n", style.colour, style.dashes, line(f, c));
}

std::string axes(const Frame& f, const output::PlotSpec& plot) {
    std::string text;
    const double base = height - bottom;
    for (std::size_t i = 0; i < f.y.at.size(); ++i) {
        const double y = f.py(f.y.at[i]);
        text +=
            fmt::format("<path class=\"gridline\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", f.left, y, width - right);
        text += fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                            f.left - 6, y + 4, f.y.labels[i]);
    }
    double free = -1e9;  // labels that would touch the one before are left out
    for (std::size_t i = 0; i < f.x.at.size(); ++i) {
        const double x = f.px(f.x.at[i]), half = character * static_cast<double>(f.x.labels[i].size()) / 2;
        text += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}v4\"/>", x, base);
        if (x - half < free) continue;
        free = x + half + character;
        text +=
            fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                        x, base + 17, f.x.labels[i]);
    }
    const auto with_factor = [](const std::string& label, const std::string& factor) {
        return escape(factor.empty() ? label : label + " (\xC3\x97 " + factor + ")");
    };
    text += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", f.left, base, width - right);
    text += fmt::format("<text class=\"label\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                        f.left + f.wide() / 2, height - 5, with_factor(plot.x_label, f.x.factor));
    text += fmt::format("<text class=\"label\" x=\"2\" y=\"13\">{}</text>\n",
                        with_factor(plot.y_label, f.y.factor));
    return text;
}

std::string bands(const Frame& f, const Chart& chart) {
    std::string text;
    if (chart.window) {
        const double from = std::max(f.px((*chart.window)[0]), f.left),
                     to = std::min(f.px((*chart.window)[1]), width - right);
        if (to > from)
            text +=
                fmt::format("<rect class=\"window\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>\n",
                            from, top, to - from, f.high());
    }
    for (const auto& band : chart.plot.bands) {
        if (band.low < band.high)
            text += fmt::format(
                "<rect class=\"band\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                f.left, f.py(band.high), f.wide(), f.py(band.low) - f.py(band.high));
        else
            text += fmt::format("<path class=\"reference\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", f.left,
                                f.py(band.low), width - right);
    }
    return text;
}

std::string entry(const std::string& drawing, const std::string& label) {
    return fmt::format(
        "<li><svg class=\"swatch\" viewBox=\"0 0 24 12\" aria-hidden=\"true\">{}</svg>{}</li>\n", drawing,
        escape(label));
}

std::string legend(const Chart& chart) {
    std::string items;
    const auto& curves = chart.plot.curves;
    const auto named =
        std::count_if(curves.begin(), curves.end(), [](const Curve& c) { return !c.label.empty(); });
    for (std::size_t i = 0; named > 1 && i < curves.size(); ++i) {
        const Curve& c = curves[i];
        if (c.label.empty()) continue;
        const Style style = style_of(chart, i);
        items += entry(
            c.points
                ? fmt::format("<g class=\"points c{}\">{}</g>", style.colour, symbol(style.symbol, 12, 6))
                : fmt::format("<path class=\"line c{}{}\" d=\"M0 6H24\"/>", style.colour, style.dashes),
            c.label);
    }
    for (const auto& band : chart.plot.bands)
        items += entry(band.low < band.high ? "<rect class=\"band\" width=\"24\" height=\"12\"/>"
                                            : "<path class=\"reference\" d=\"M0 6H24\"/>",
                       band.label);
    if (chart.window) items += entry("<rect class=\"window\" width=\"24\" height=\"12\"/>", "averaged over");
    return items.empty() ? "" : "<ul class=\"legend\">" + items + "</ul>\n";
}

}  // namespace

bool has_data(const Chart& chart) {
    for (const Curve& c : chart.plot.curves)
        for (std::size_t i = 0; i < c.x.size(); ++i)
            if (std::isfinite(c.y[i]) && (!chart.plot.log_x || c.x[i] > 0) &&
                (!chart.plot.log_y || c.y[i] > 0))
                return true;
    return false;
}

std::string chart_svg(const Chart& chart) {
    const Frame f = frame_of(chart);
    std::string text = fmt::format(
        "<figure class=\"chart\" data-chart=\"{}\">\n<figcaption>{}</figcaption>\n<svg role=\"img\" "
        "aria-label=\"{}\" "
        "viewBox=\"0 0 {} {}\">\n",
        escape(chart.key), escape(chart.plot.title), escape(chart.plot.title), width, height);
    text += bands(f, chart) + axes(f, chart.plot);
    // a drawing of its own cuts off what lies outside the axes
    text += fmt::format(
        "<svg x=\"{0:.1f}\" y=\"{1}\" width=\"{2:.1f}\" height=\"{3:.1f}\" viewBox=\"{0:.1f} {1} {2:.1f} "
        "{3:.1f}\">\n",
        f.left, top - 2, f.wide(), f.high() + 4);
    for (std::size_t i = 0; i < chart.plot.curves.size(); ++i)
        text += curve(f, chart.plot.curves[i], style_of(chart, i));
    text += "</svg>\n</svg>\n" + legend(chart);
    if (!chart.note.empty()) text += fmt::format("<p class=\"note\">{}</p>\n", escape(chart.note));
    return text + "</figure>\n";
}

}  // namespace hemoflux::report
