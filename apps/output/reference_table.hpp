/// Tables of reference data: CSV with '#' comments before the header, numbers and words in the cells.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemoflux::output {

/// Cells of a CSV file as texts.
struct ReferenceTable {
    std::string name;  ///< of the file, for messages
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;

    /// Numbers of a column, NaN where a cell is empty. InputError naming the columns there are, or the cell that is no
    /// number.
    [[nodiscard]] std::vector<double> numbers(const std::string& column) const;
    /// The rows in which `column` holds `word`. InputError when there is no such column or no such row.
    [[nodiscard]] ReferenceTable where(const std::string& column, const std::string& word) const;

  private:
    [[nodiscard]] std::size_t index(const std::string& column) const;
};

/// FileError when unreadable, InputError naming a row whose length differs from the header's, or when there is no
/// header.
ReferenceTable read_reference_table(const std::filesystem::path& path);

}  // namespace hemoflux::output
