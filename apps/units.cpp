#include "apps/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

constexpr const char* known_units =
    "Write for example \"12 um\", \"22 mPa s\", \"160 pN\", \"6.1 uN/m\", \"1.6 1/s\" or \"1000 kg/m^3\"";

/// UDUNITS keeps its state in statics: one lock for every call into it.
std::mutex& udunits_lock() {
    static std::mutex lock;
    return lock;
}

/// The system of units, read once from the database UDUNITS was installed with or UDUNITS2_XML_PATH names.
ut_system* unit_system() {
    static const std::unique_ptr<ut_system, decltype(&ut_free_system)> system = [] {
        ut_set_error_message_handler(ut_ignore);
        return std::unique_ptr<ut_system, decltype(&ut_free_system)>(ut_read_xml(nullptr), &ut_free_system);
    }();
    if (!system) {
        throw FileError(
            "The units database of UDUNITS-2 cannot be read", "quantities cannot be converted",
            "Install libudunits2-0 and libudunits2-data, or set UDUNITS2_XML_PATH to udunits2.xml");
    }
    return system.get();
}

/// What a message shows of a text, which may be absurdly long.
std::string shown(std::string_view text) {
    constexpr std::size_t most = 60;
    return text.size() <= most ? std::string(text) : std::string(text.substr(0, most)) + "...";
}

Unit parse_unit(const std::string& text, const std::string& whole) {
    Unit unit(ut_parse(unit_system(), text.c_str(), UT_UTF8), &ut_free);
    if (!unit) {
        throw InputError(fmt::format("\"{}\"", shown(whole)),
                         fmt::format("\"{}\" is not a unit UDUNITS-2 knows", shown(text)), known_units);
    }
    return unit;
}

double convert(double value, const std::string& from, const std::string& to, const std::string& whole) {
    if (from == to) {
        return value;  // keeps the number as typed, to the last bit
    }
    const std::lock_guard guard(udunits_lock());
    const Unit source = parse_unit(from, whole);
    const Unit target = parse_unit(to, to);
    const Converter converter(ut_get_converter(source.get(), target.get()), &cv_free);
    if (!converter) {
        throw InputError(
            fmt::format("\"{}\"", shown(whole)),
            fmt::format("\"{}\" cannot be converted to \"{}\", it measures something else", shown(from), to),
            fmt::format("Write the value in \"{}\" or a multiple of it", to));
    }
    return cv_convert_double(converter.get(), value);
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

double quantity(std::string_view text, const std::string& unit) {
    const std::string whole(trimmed(text));
    const char* begin = whole.data() + (!whole.empty() && whole.front() == '+' ? 1 : 0);
    const char* end = whole.data() + whole.size();
    double value = 0;
    const auto [rest, status] = std::from_chars(begin, end, value);
    if (status != std::errc() || !std::isfinite(value)) {
        throw InputError(fmt::format("\"{}\"", shown(text)), "it does not start with a finite number",
                         known_units);
    }
    const std::string own(trimmed(std::string_view(rest, static_cast<std::size_t>(end - rest))));
    if (own.empty()) {
        throw InputError(
            fmt::format("\"{}\"", shown(text)), "the unit is missing",
            fmt::format("Write the unit after the number, for example \"{} {}\"", shown(whole), unit));
    }
    const double converted = convert(value, own, unit, whole);
    if (!std::isfinite(converted)) {
        throw InputError(fmt::format("\"{}\"", shown(text)),
                         fmt::format("it is not a finite number of {}", unit), "Check the exponent");
    }
    return converted;
}

double conversion(const std::string& from, const std::string& to) { return convert(1.0, from, to, from); }

}  // namespace hemoflux::apps
