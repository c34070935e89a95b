#include "apps/report/log_file.hpp"

#include <cctype>
#include <sstream>

#include "apps/run_files.hpp"

namespace hemoflux::report {
namespace {

/// Whether a line begins with a date such as "2026-11-25 22:34:53.567 ".
bool dated(const std::string& line) {
    constexpr std::string_view form = "0000-00-00 00:00:00.000 ";
    if (line.size() < form.size()) return false;
    for (std::size_t i = 0; i < form.size(); ++i)
        if (form[i] == '0' ? !std::isdigit(static_cast<unsigned char>(line[i])) : line[i] != form[i])
            return false;
    return true;
}

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The parts of a text between semicolons.
std::vector<std::string> parts(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ';');)
        if (part = trimmed(part); !part.empty()) out.push_back(part);
    return out;
}

/// Lines of the form "  name          value", and those that continue the one above; empty unless "grid" is among them.
NamedTexts table_of(const std::string& text) {
    constexpr std::size_t indent = 2, column = 16;
    NamedTexts rows;
    bool grid = false;
    std::istringstream stream(text);
    std::string line;
    std::getline(stream, line);  // the title
    while (std::getline(stream, line)) {
        if (line.size() <= column || line.substr(0, indent) != "  ") break;
        const std::string name = trimmed(line.substr(0, column)), value = trimmed(line.substr(column));
        if (!name.empty())
            rows.emplace_back(name, value);
        else if (!rows.empty())
            rows.back().second += " " + value;
        grid = grid || name == "grid";
    }
    return grid ? rows : NamedTexts{};
}

}  // namespace

std::vector<LogEntry> read_log(const std::string& text) {
    std::vector<LogEntry> log;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        const auto colon = dated(line) ? line.find(": ", 24) : std::string::npos;
        if (colon != std::string::npos)
            log.push_back({line.substr(0, 19), line.substr(24, colon - 24), line.substr(colon + 2)});
        else if (!log.empty())
            log.back().text += "\n" + line;
    }
    return log;
}

NamedTexts start_summary(const std::vector<LogEntry>& log) {
    NamedTexts last;
    for (const LogEntry& entry : log)
        if (NamedTexts rows = table_of(entry.text); !rows.empty()) last = std::move(rows);
    return last;
}

NamedTexts conversion(const NamedTexts& summary) {
    NamedTexts out;
    for (const auto& [name, value] : summary) {
        if (name != "conversion") continue;
        for (const std::string& part : parts(value)) {
            // "length 1 um", "velocity c = 476.2 um/s", "membrane force 1e-11 N = 0.1283 lattice units"
            const auto equals = part.find(" = "), digit = part.find_first_of("0123456789");
            const auto cut = equals != std::string::npos ? equals + 3 : digit;
            const std::string what = trimmed(part.substr(0, equals != std::string::npos ? equals : digit));
            out.emplace_back(what, cut == std::string::npos ? "" : part.substr(cut));
        }
    }
    return out;
}

NamedTexts environment(const std::vector<LogEntry>& log) {
    NamedTexts out;
    for (const LogEntry& entry : log) {
        if (!entry.text.starts_with(apps::environment_word)) continue;
        out.clear();
        for (const std::string& part : parts(entry.text.substr(apps::environment_word.size()))) {
            const auto space = part.find(' ');
            out.emplace_back(part.substr(0, space), space == std::string::npos ? "" : part.substr(space + 1));
        }
    }
    return out;
}

}  // namespace hemoflux::report
