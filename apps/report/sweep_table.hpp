/// sweep.csv: the runs of a sweep with the values of the swept keys and their observables.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hemoflux::report {

/// The cells of a sweep's table as texts; the first `keys` columns are keys of the case.
struct SweepTable {
    std::vector<std::string> columns;
    std::size_t keys = 0;
    std::vector<std::vector<std::string>> rows;

    /// Place of each run on an axis: the number of the first key's value, of a list its largest; 0, 1, ... for words.
    [[nodiscard]] std::vector<double> abscissas() const;
    /// The values of a column, NaN where a cell is no number.
    [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
    /// How many runs have no observables.
    [[nodiscard]] std::size_t failed() const;
};

/// Reads sweep.csv; `input` is the case, in which the swept keys are found. FileError when it cannot be read, InputError
/// naming the line whose length differs from the header's.
SweepTable read_sweep_table(const std::filesystem::path& path, const toml::table& input);

}  // namespace hemoflux::report
