#include "apps/output/reference_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

std::vector<std::string> split(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

}  // namespace

std::size_t ReferenceTable::index(const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end())
        throw InputError(fmt::format("{} has no column \"{}\"", name, column),
                         fmt::format("it has {}", fmt::join(columns, ", ")), "choose one of these");
    return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> ReferenceTable::numbers(const std::string& column) const {
    const std::size_t c = index(column);
    std::vector<double> values;
    for (const auto& row : rows) {
        double value = NAN;
        const char* last = row[c].data() + row[c].size();
        const auto [stop, error] = std::from_chars(row[c].data(), last, value);
        if (!row[c].empty() && (error != std::errc() || stop != last))
            throw InputError(fmt::format("column \"{}\" of {}", column, name),
                             fmt::format("\"{}\" is not a number", row[c]), "choose a column of numbers");
        values.push_back(value);
    }
    return values;
}

ReferenceTable ReferenceTable::where(const std::string& column, const std::string& word) const {
    const std::size_t c = index(column);
    ReferenceTable chosen{name, columns, {}};
    for (const auto& row : rows)
        if (row[c] == word) chosen.rows.push_back(row);
    if (chosen.rows.empty())
        throw InputError(fmt::format("{} has no row with {} = {}", name, column, word),
                         "there is nothing to compare with", "choose a word of that column");
    return chosen;
}

ReferenceTable read_reference_table(const std::filesystem::path& path) {
    std::istringstream text(read_file(path));
    ReferenceTable table{path.string(), {}, {}};
    std::size_t number = 0;
    for (std::string line; std::getline(text, line);) {
        ++number;
        if (line.empty() || line[0] == '#') continue;
        auto cells = split(line);
        if (table.columns.empty()) {
            table.columns = std::move(cells);
            continue;
        }
        if (cells.size() != table.columns.size())
            throw InputError(fmt::format("{}, line {}", table.name, number),
                             fmt::format("{} values for {} columns", cells.size(), table.columns.size()),
                             "restore the file");
        table.rows.push_back(std::move(cells));
    }
    if (table.rows.empty()) throw InputError(table.name, "it has no rows", "restore the file");
    return table;
}

}  // namespace hemoflux::output
