#include "apps/report/quantity_name.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

namespace hemoflux::report {
namespace {

/// Ends of names and what they mean, longer ones before those they end with.
constexpr std::pair<std::string_view, std::string_view> units[] = {
    {"_cycles_per_strain", "cycles per strain unit"},
    {"_kg_per_m3", "kg/m\xC2\xB3"},
    {"_uN_per_m", "\xC2\xB5N/m"},
    {"_um_per_s", "\xC2\xB5m/s"},
    {"_um_s", "\xC2\xB5m/s"},
    {"_1_per_s", "1/s"},
    {"_per_strain", "per strain unit"},
    {"_per_um", "1/\xC2\xB5m"},
    {"_strain", "strain units"},
    {"_um2", "\xC2\xB5m\xC2\xB2"},
    {"_um3", "\xC2\xB5m\xC2\xB3"},
    {"_um", "\xC2\xB5m"},
    {"_deg", "degrees"},
    {"_aJ", "aJ"},
    {"_pN", "pN"},
    {"_pa", "Pa"},
    {"_Pa", "Pa"},
    {"_pct", "%"},
    {"_Nm", "N\xC2\xA0m"},
    {"_N", "N"},
    {"_s", "s"}};

/// Names that underscores turned to spaces would not explain.
const std::map<std::string, std::string, std::less<>> words{
    {"taylor_d", "Taylor deformation"},
    {"psi_min", "Least streamfunction"},
    {"error_relative", "Relative error"},
    {"error_total", "Total error"},
    {"error_density", "Error of the density"},
    {"error_largest", "Largest relative error"},
    {"chi2", "\xCF\x87\xC2\xB2"},
    {"chi2_per_degree_of_freedom", "\xCF\x87\xC2\xB2 per degree of freedom"},
    {"cpu", "Processor time"},
    {"wall", "Wall time"},
    {"residual", "Residual"},
    {"mean_density", "Mean density"},
    {"strain", "Strain"},
    {"step", "Step"}};

std::string in_words(std::string text) {
    if (const auto found = words.find(text); found != words.end()) return found->second;
    for (const auto& [start, meaning] : {std::pair{"order_", "Order of "}, {"limit_", "Limit of "}})
        if (text.starts_with(start)) {
            std::string rest = in_words(text.substr(6));
            if (rest.size() > 1 && rest[0] >= 'A' && rest[0] <= 'Z' && rest[1] != ' ') rest[0] += 'a' - 'A';
            return meaning + rest;
        }
    std::replace(text.begin(), text.end(), '_', ' ');
    // a velocity component or coordinate keeps its letter
    const bool letter = text.size() < 2 || text[1] == ' ';
    if (!letter && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

}  // namespace

QuantityName quantity_name(const std::string& key) {
    const auto dot = key.rfind('.');
    const bool prefixed = dot != std::string::npos && key.find(' ') == std::string::npos;
    std::string prefix = prefixed ? key.substr(0, dot) + ": " : "",
                name = prefixed ? key.substr(dot + 1) : key;
    // axial_um_at_100_pN: the unit stands before the condition, which has one of its own
    std::string behind;
    if (const auto at = name.find("_at_"); at != std::string::npos) {
        const QuantityName condition = quantity_name(name.substr(at + 4));
        behind = " at " + condition.text + (condition.unit.empty() ? "" : "\xC2\xA0" + condition.unit);
        name.resize(at);
    }
    std::string unit;
    for (const auto& [end, meaning] : units)
        if (name.size() > end.size() && name.ends_with(end)) {
            unit = meaning;
            name.resize(name.size() - end.size());
            break;
        }
    return {prefix + in_words(name) + behind, unit};
}

}  // namespace hemoflux::report
