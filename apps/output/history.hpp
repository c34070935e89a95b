/// history.csv: one row of numbers per recorded step, with every digit of a double.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hemoflux::output {

/// Numbers by column and row, as read back from a CSV file.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;

    /// All values of one column; InputError naming the columns there are when it is none of them.
    [[nodiscard]] std::vector<double> column(const std::string& name) const;
};

/// Reads a CSV file of numbers with one header line; lines that begin with # are comments. A last line without its line
/// end (the program was killed while writing it) is left out. FileError when unreadable, InputError naming the line
/// that is malformed.
Table read_table(const std::filesystem::path& path);

/// Writes a CSV file of numbers, whole at once (atomically); every digit of the doubles. FileError.
void write_table(const std::filesystem::path& path, const Table& table);

/// The growing CSV file of a run. The first column is the step number; numbers are printed in the shortest
/// form that reads back as the same double, NaN and infinity as nan and inf.
class History {
  public:
    /// Starts a file with these columns ("step" first, names unique). FileError when it cannot be written.
    History(std::filesystem::path path, std::vector<std::string> columns);

    /// Appends one row, flushed to the operating system; one value per column. FileError when the disk is
    /// full.
    void add(const std::vector<double>& row);

  private:
    std::filesystem::path path_;
    std::vector<std::string> columns_;
    std::ofstream file_;
};

}  // namespace hemoflux::output
