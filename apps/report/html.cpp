#include "apps/report/html.hpp"

#include <fmt/format.h>
#include <vtkBase64Utilities.h>

#include <cmath>
#include <cstdlib>

#include "apps/output/atomic_file.hpp"

namespace hemoflux::report {
namespace {

constexpr const char *minus = "\xE2\x88\x92", *dash = "\xE2\x80\x93", *replacement = "\xEF\xBF\xBD";

/// Length of the UTF-8 sequence at i; 0 when it is none.
std::size_t sequence(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char lead = byte(i);
    const std::size_t length = lead < 0x80                    ? 1
                               : lead >= 0xC2 && lead <= 0xDF ? 2
                               : (lead & 0xF0) == 0xE0        ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xC0) != 0x80) return 0;
    // overlong forms, surrogates and what lies beyond the last code point
    if (length > 2) {
        const unsigned char second = byte(i + 1);
        if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
            (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
            return 0;
    }
    return length;
}

std::string entity(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return std::string(1, c);
    }
}

/// Digits with a true minus sign.
std::string signed_digits(const std::string& digits) {
    return digits.starts_with('-') ? minus + digits.substr(1) : digits;
}

}  // namespace

std::string escape(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = sequence(text, i);
        const bool control = length == 1 && (static_cast<unsigned char>(text[i]) < 0x20 || text[i] == 0x7F) &&
                             text[i] != '\n' && text[i] != '\t';
        if (length == 0 || control)
            out += replacement;
        else if (length == 1)
            out += entity(text[i]);
        else
            out += text.substr(i, length);
        i += length == 0 ? 1 : length;
    }
    return out;
}

std::string number(double value, int digits) {
    if (!std::isfinite(value)) return dash;
    const double size = std::abs(value);
    if (size < 1e9 && value == std::round(value)) return signed_digits(fmt::format("{:.0f}", value));
    std::string text = fmt::format("{:.{}e}", value, digits - 1);
    const auto e = text.find('e');
    const int exponent = std::atoi(text.c_str() + e + 1);
    if (exponent >= -3 && exponent < 6)
        return signed_digits(exponent >= digits ? fmt::format("{:.0f}", value)
                                                : fmt::format("{:.{}g}", value, digits));
    text.resize(e);
    while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) text.pop_back();
    return fmt::format("{}&nbsp;\xC3\x97&nbsp;10<sup>{}</sup>", signed_digits(text),
                       signed_digits(std::to_string(exponent)));
}

std::string percentage(double relative) {
    if (!std::isfinite(relative)) return dash;
    const double percent = 100 * relative;
    const std::string digits = std::abs(percent) < 1000 ? fmt::format("{:.2f}", std::abs(percent))
                                                        : fmt::format("{:.3g}", std::abs(percent));
    return (percent < 0 ? minus : "+") + digits + "&nbsp;%";
}

std::string base64(std::string_view bytes) {
    std::string text(4 * (bytes.size() / 3 + 1), '\0');
    const auto length =
        vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                                   reinterpret_cast<unsigned char*>(text.data()), 0);
    text.resize(length);
    return text;
}

std::string data_url(const std::filesystem::path& file, std::string_view media_type) {
    return fmt::format("data:{};base64,{}", media_type, base64(output::read_file(file)));
}

std::string pairs(std::string_view heading, const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    std::string text = fmt::format("<table class=\"pairs\"><caption>{}</caption><tbody>\n", escape(heading));
    for (const Row& row : rows)
        text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(row.name), row.value);
    return text + "</tbody></table>\n";
}

}  // namespace hemoflux::report
