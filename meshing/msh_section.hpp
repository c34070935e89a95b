/// The sections of an MSH file, and numbers taken off one of them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "meshing/file_text.hpp"
#include "meshing/format_error.hpp"

namespace hemoflux::meshing {

/// What stands between the lines $NAME and $EndNAME, by name. FormatError where something stands between sections, a section
/// has no end, stands there twice, in an order gmsh does not read, or is none of those a whole mesh has.
std::map<std::string, std::string_view> msh_sections(const std::string& text);

/// Takes numbers off a section, written as text or as bytes; FormatError with the section and, of text, the line.
class MshNumbers {
  public:
    /// The text or bytes between the section's first and last line, its name without $, and whether it is bytes.
    MshNumbers(std::string_view section, std::string name, bool binary)
        : all_(section), rest_(section), name_(std::move(name)), binary_(binary) {}

    /// Throws FormatError for what was taken last, with its line in the section, counted from 1.
    [[noreturn]] void refuse(const std::string& why) const { refuse_at(all_.size() - rest_.size(), why); }

    /// A whole number that gmsh keeps in 32 bits.
    long long integer() {
        const long long value = binary_ ? bytes<std::int32_t>() : word<long long>();
        if (value > std::numeric_limits<std::int32_t>::max() ||
            value < -std::numeric_limits<std::int32_t>::max())
            refuse(fmt::format("{} is too large for a number of 32 bits", value));
        return value;
    }
    /// A number of things, or the number of a thing.
    std::uint64_t size() { return binary_ ? bytes<std::uint64_t>() : word<std::uint64_t>(); }
    /// A finite number.
    double real() {
        const double value = binary_ ? bytes<double>() : word<double>();
        if (!std::isfinite(value)) refuse(fmt::format("{} is not a finite number", value));
        return value;
    }
    /// A number of things of which each takes at least `least` bytes.
    std::uint64_t count(std::uint64_t n, std::uint64_t least) const {
        if (n > rest_.size() / least + 1)
            refuse(fmt::format("it claims {} entries, more than the file holds", n));
        return n;
    }
    /// Takes this word of text if it is the next; whether it was.
    bool skip(std::string_view expected) {
        const std::size_t begin = rest_.find_first_not_of(blank);
        if (begin == std::string_view::npos || !rest_.substr(begin).starts_with(expected)) return false;
        rest_.remove_prefix(begin + expected.size());
        return true;
    }
    /// The rest of the line, taken without its end; of bytes nothing.
    std::string_view line() {
        if (binary_) return {};
        const std::string_view text = rest_.substr(0, rest_.find('\n'));
        rest_.remove_prefix(text.size());
        return text;
    }
    /// Refuses more on the line, where gmsh reads line by line.
    void end_line() {
        const std::string_view more = line();
        if (more.find_first_not_of(blank) != std::string_view::npos)
            refuse(fmt::format("\"{}\" stands behind what belongs on the line", more.substr(0, 40)));
    }
    /// Refuses more in the section.
    void end() const {
        if (const std::size_t more = rest_.find_first_not_of(blank); more != std::string_view::npos)
            refuse_at(all_.size() - rest_.size() + more, "more stands there than it claims to hold");
    }

  private:
    [[noreturn]] void refuse_at(std::size_t at, const std::string& why) const {
        const auto line = std::count(all_.begin(), all_.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw FormatError(binary_ ? fmt::format("section ${}: {}", name_, why)
                                  : fmt::format("section ${}, its line {}: {}", name_, line + 1, why));
    }

    template <class T>
    T bytes() {
        if (rest_.size() < sizeof(T)) refuse("it breaks off");
        T value;
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        return value;
    }
    template <class T>
    T word() {
        const std::size_t begin = rest_.find_first_not_of(blank);
        if (begin == std::string_view::npos) refuse("it breaks off");
        rest_.remove_prefix(begin);
        const std::string_view text = rest_.substr(0, rest_.find_first_of(blank));
        T value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size())
            refuse(fmt::format("\"{}\" is not a number", text.substr(0, 40)));
        rest_.remove_prefix(text.size());
        return value;
    }

    std::string_view all_, rest_;
    std::string name_;
    bool binary_;
};

}  // namespace hemoflux::meshing
