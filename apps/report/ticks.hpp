/// Where the ticks of an axis stand and what is written beside them.
#pragma once

#include <string>
#include <vector>

namespace hemoflux::report {

/// One axis of a chart.
struct AxisTicks {
    double low = 0, high = 1;  ///< ends of the axis, in the values' own unit
    bool logarithmic = false;
    std::vector<double> at;
    std::vector<std::string> labels;  ///< one for each tick, UTF-8
    std::string factor;  ///< what the labels are to be multiplied with, "" for one: "10^-4" with superscripts

    /// Place of a value on the axis: 0 at low, 1 at high; NaN where a logarithmic axis has no place for it.
    [[nodiscard]] double place(double value) const;
};

/// About `count` ticks at round numbers for values from low to high, which are widened where they are equal. A
/// logarithmic axis needs low > 0 and ends at powers of ten or at 1, 2, 5 times such.
AxisTicks make_ticks(double low, double high, bool logarithmic, int count);

}  // namespace hemoflux::report
