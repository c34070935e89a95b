#include "apps/output/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <stdexcept>

#include "apps/output/atomic_file.hpp"
#include "exchange/error.hpp"

namespace hemoflux::output {
namespace {

std::string header(const std::vector<std::string>& columns) {
    return fmt::format("{}\n", fmt::join(columns, ","));
}

std::string line(const std::vector<double>& row) { return fmt::format("{}\n", fmt::join(row, ",")); }

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find(',', begin)) != std::string::npos; begin = end + 1)
        parts.push_back(text.substr(begin, end - begin));
    parts.push_back(text.substr(begin));
    return parts;
}

void check_columns(const std::vector<std::string>& columns) {
    if (columns.empty() || columns.front() != "step")
        throw std::invalid_argument("History: the first column must be step");
    if (std::set<std::string>(columns.begin(), columns.end()).size() != columns.size())
        throw std::invalid_argument("History: column names must differ");
}

InputError malformed(const std::filesystem::path& path, std::size_t number, const std::string& why) {
    return {fmt::format("malformed table {}", path.string()), fmt::format("line {}: {}", number, why),
            "Correct the line, or restore the file"};
}

}  // namespace

std::vector<double> Table::column(const std::string& name) const {
    const auto it = std::find(columns.begin(), columns.end(), name);
    if (it == columns.end())
        throw InputError("no column " + name, fmt::format("the table has {}", fmt::join(columns, ", ")),
                         "Choose one of these");
    const auto c = static_cast<std::size_t>(it - columns.begin());
    std::vector<double> values(rows.size());
    std::transform(rows.begin(), rows.end(), values.begin(), [c](const auto& row) { return row[c]; });
    return values;
}

Table read_table(const std::filesystem::path& path) {
    const std::string content = read_file(path);
    Table table;
    std::size_t number = 0, begin = 0;
    for (std::size_t end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
        ++number;
        if (content[begin] == '#') continue;
        const auto parts = split(content.substr(begin, end - begin));
        if (table.columns.empty()) {
            table.columns = parts;
            continue;
        }
        if (parts.size() != table.columns.size())
            throw malformed(path, number,
                            fmt::format("{} values for {} columns", parts.size(), table.columns.size()));
        auto& row = table.rows.emplace_back(parts.size());
        for (std::size_t c = 0; c < parts.size(); ++c) {
            const char* last = parts[c].data() + parts[c].size();
            const auto [stop, error] = std::from_chars(parts[c].data(), last, row[c]);
            if (error != std::errc() || stop != last)
                throw malformed(path, number, fmt::format("\"{}\" is not a number", parts[c]));
        }
    }
    if (table.columns.empty()) throw malformed(path, 1, "there is no header");
    return table;
}

void write_table(const std::filesystem::path& path, const Table& table) {
    std::string content = header(table.columns);
    for (const auto& row : table.rows) content += line(row);
    write_file(path, content);
}

History::History(std::filesystem::path path, std::vector<std::string> columns)
    : path_(std::move(path)), columns_(std::move(columns)) {
    check_columns(columns_);
    write_file(path_, header(columns_));
    file_.open(path_, std::ios::app);
    if (!file_)
        throw FileError("cannot write " + path_.string(), "it cannot be opened",
                        "Check that you may write there");
}

void History::add(const std::vector<double>& row) {
    if (row.size() != columns_.size())
        throw std::invalid_argument(
            fmt::format("History: {} values for {} columns", row.size(), columns_.size()));
    std::error_code unknown;
    const std::uintmax_t before = std::filesystem::file_size(path_, unknown);
    file_ << line(row) << std::flush;
    if (!file_) {
        file_.close();
        if (!unknown) std::filesystem::resize_file(path_, before, unknown);  // no half row stays behind
        throw FileError("cannot write " + path_.string(), "the system refused the next row (disk full?)",
                        "Free some space and continue with --restart");
    }
}

}  // namespace hemoflux::output
