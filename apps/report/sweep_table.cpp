#include "apps/report/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "apps/sweep.hpp"
#include "exchange/error.hpp"

namespace hemoflux::report {
namespace {

/// Cells of a line; those with commas or quotes stand in quotes, in which quotes are doubled.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    return cells;
}

/// Whether a case has a key such as "grid.cells" or "cell.0.nodes".
bool is_key(const toml::table& input, const std::string& name) {
    const toml::node* node = &input;
    std::istringstream steps(name);
    for (std::string step; std::getline(steps, step, '.');) {
        if (const toml::table* table = node->as_table())
            node = table->get(step);
        else if (const toml::array* array = node->as_array())
            node = step.size() == 1 && step[0] >= '0' && step[0] <= '9'
                       ? array->get(std::size_t(step[0] - '0'))
                       : nullptr;
        else
            node = nullptr;
        if (node == nullptr) return false;
    }
    return true;
}

}  // namespace

std::vector<double> SweepTable::abscissas() const {
    std::vector<double> x;
    for (const auto& row : rows) x.push_back(apps::abscissa(row.front(), rows.front().front()));
    const bool words = std::any_of(x.begin(), x.end(), [](double v) { return !std::isfinite(v); });
    for (std::size_t i = 0; words && i < x.size(); ++i) x[i] = static_cast<double>(i);
    return x;
}

std::vector<double> SweepTable::numbers(std::size_t column) const {
    std::vector<double> values;
    for (const auto& row : rows) {
        const std::string& cell = row[column];
        double value = NAN;
        const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        values.push_back(error == std::errc() && stop == cell.data() + cell.size() ? value : NAN);
    }
    return values;
}

std::size_t SweepTable::failed() const {
    return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [this](const auto& row) {
        return std::all_of(row.begin() + static_cast<std::ptrdiff_t>(keys), row.end(),
                           [](const std::string& cell) { return cell == "nan" || cell.empty(); });
    }));
}

SweepTable read_sweep_table(const std::filesystem::path& path, const toml::table& input) {
    std::istringstream text(output::read_file(path));
    SweepTable table;
    std::string line;
    std::getline(text, line);
    table.columns = cells_of(line);
    while (table.keys < table.columns.size() && is_key(input, table.columns[table.keys])) ++table.keys;
    for (std::size_t number = 2; std::getline(text, line); ++number) {
        auto& row = table.rows.emplace_back(cells_of(line));
        if (row.size() != table.columns.size())
            throw InputError(
                fmt::format("malformed table {}", path.string()),
                fmt::format("line {}: {} values for {} columns", number, row.size(), table.columns.size()),
                "Run the sweep again; finished runs are taken over");
    }
    return table;
}

}  // namespace hemoflux::report
