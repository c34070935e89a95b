#include "apps/report/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hemoflux::report {
namespace {

/// 10 to this power with superscript digits.
std::string power_of_ten(int exponent) {
    static const char* const digits[] = {"\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",
                                         "\xE2\x81\xB4", "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7",
                                         "\xE2\x81\xB8", "\xE2\x81\xB9"};
    std::string text = "10";
    for (const char c : std::to_string(exponent)) text += c == '-' ? "\xE2\x81\xBB" : digits[c - '0'];
    return text;
}

std::string with_minus(const std::string& digits) {
    return digits.starts_with('-') ? "\xE2\x88\x92" + digits.substr(1) : digits;
}

double round_step(double rough) {
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double m : {1.0, 2.0, 2.5, 5.0})
        if (m * decade >= rough * (1 - 1e-9)) return m * decade;
    return 10 * decade;
}

void linear(AxisTicks& axis, int count) {
    const double step = round_step((axis.high - axis.low) / count);
    const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
    const int order = static_cast<int>(std::floor(std::log10(largest)));
    const int shift = order < -2 || order > 4 ? order : 0;
    if (shift != 0) axis.factor = power_of_ten(shift);
    const double unit = std::pow(10.0, shift), shown = step / unit;
    // as many decimals as the step has
    int decimals = 0;
    for (double s = shown; decimals < 12 && std::abs(s - std::round(s)) > 1e-6 * s; s *= 10) ++decimals;
    const double first = std::ceil(axis.low / step - 1e-9), last = std::floor(axis.high / step + 1e-9);
    for (double k = first; k <= last; ++k) {
        axis.at.push_back(k * step);
        axis.labels.push_back(with_minus(fmt::format("{:.{}f}", k == 0 ? 0.0 : k * shown, decimals)));
    }
}

void logarithmic(AxisTicks& axis, int count) {
    const int first = static_cast<int>(std::floor(std::log10(axis.low) + 1e-9));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high) - 1e-9));
    const int stride = std::max(1, (last - first + count) / (count + 1));
    // within a decade all its digits, within two or three 1, 2 and 5, else powers of ten alone
    const double decades = std::log10(axis.high / axis.low);
    const bool plain = first >= -2 && last <= 4;
    for (int e = first; e <= last; ++e)
        for (int m = 1; m <= 9; ++m) {
            const double value = m * std::pow(10.0, e);
            if (value < axis.low * (1 - 1e-9) || value > axis.high * (1 + 1e-9)) continue;
            if (decades > 1 && m != 1 && m != 2 && m != 5) continue;
            if (decades > 2.5 && (m != 1 || (e - first) % stride != 0)) continue;
            axis.at.push_back(value);
            axis.labels.push_back(plain    ? fmt::format("{:g}", value)
                                  : m == 1 ? power_of_ten(e)
                                           : fmt::format("{}\xC2\xB7{}", m, power_of_ten(e)));
        }
}

}  // namespace

double AxisTicks::place(double value) const {
    if (!logarithmic) return (value - low) / (high - low);
    return value > 0 ? std::log(value / low) / std::log(high / low) : NAN;
}

AxisTicks make_ticks(double low, double high, bool log_axis, int count) {
    AxisTicks axis{.low = low, .high = high, .logarithmic = log_axis, .at = {}, .labels = {}, .factor = ""};
    if (log_axis) {
        if (!(high > low * 1.001)) axis.low = low / 2, axis.high = high * 2;
        logarithmic(axis, count);
        return axis;
    }
    const double least = 1e-9 * std::max(std::abs(low), std::abs(high));
    if (!(high - low > least)) {
        const double air = low == 0 && high == 0 ? 1 : 0.1 * std::max(std::abs(low), std::abs(high));
        axis.low = low - air;
        axis.high = high + air;
    }
    linear(axis, count);
    return axis;
}

}  // namespace hemoflux::report
