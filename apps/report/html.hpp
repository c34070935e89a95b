/// Pieces of HTML: escaped texts, numbers as readers expect them, files as data.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hemoflux::report {

/// The text with & < > " ' as entities, so that it can stand in elements and attributes; bytes that are not UTF-8 and
/// control characters become U+FFFD.
std::string escape(std::string_view text);

/// A number for reading: up to so many significant digits, a true minus sign, powers of ten as superscripts
/// ("1.69 x 10^-4" in HTML), a dash for NaN and infinity. Whole numbers keep all digits.
std::string number(double value, int digits = 5);

/// A relative number as a signed percentage, "+1.69 %".
std::string percentage(double relative);

/// Bytes as base64 text.
std::string base64(std::string_view bytes);

/// A file as a data: URL of this media type ("image/png"). FileError when it cannot be read.
std::string data_url(const std::filesystem::path& file, std::string_view media_type);

/// A row of a two-column table; `value` is HTML, `name` is text.
struct Row {
    std::string name, value;
};

/// A two-column table under a small heading, "" when it has no rows.
std::string pairs(std::string_view heading, const std::vector<Row>& rows);

}  // namespace hemoflux::report
