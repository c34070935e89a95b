/// Names of observables and columns as readers want them: "inclination_deg" is "Inclination" in degrees.
#pragma once

#include <string>

namespace hemoflux::report {

/// A quantity in words and its unit, "" for a pure number.
struct QuantityName {
    std::string text, unit;
    /// "Inclination, degrees".
    [[nodiscard]] std::string with_unit() const { return unit.empty() ? text : text + ", " + unit; }
};

/// What the name of an observable or of a column means; the unit is the end of the name. A prefix that ends with a dot
/// (the cell or body it belongs to) is kept in front.
QuantityName quantity_name(const std::string& key);

}  // namespace hemoflux::report
