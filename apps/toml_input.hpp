/// From a TOML file to a table in which every key is known, checked, in range and filled in: the resolved
/// case.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/schema.hpp"

namespace hemoflux::apps {

/// Reads and parses a TOML file. Throws FileError when it cannot be read, InputError with line and column
/// when it is malformed.
toml::table read_toml(const std::filesystem::path& file);

/// Parses TOML text; `name` stands for the file in messages.
toml::table parse_toml(const std::string& text, const std::string& name);

/// Applies "table.key=value" (`--set`): the value is TOML, or a bare text; numbers address tables of an array
/// ("cell.0.nodes"). Throws InputError when the assignment cannot be read or its address does not exist.
void override_value(toml::table& values, const std::string& assignment);

/// Checks `values` against `schema` and returns them with all defaults filled in. Relative paths become
/// absolute, seen from `folder`. Throws InputError naming file and line: unknown key, missing key, wrong
/// type, wrong unit, out of range.
toml::table resolve(const Table& schema, const toml::table& values, const std::filesystem::path& folder);

/// A value as TOML text on one line.
std::string value_text(const toml::node& node);

/// The resolved case as TOML text in the order of the schema; reading it gives the same case.
std::string to_toml(const Table& schema, const toml::table& resolved);

/// Typed access to a resolved table; quantities arrive in the unit of the schema. Keys must be in the schema.
class Section {
  public:
    /// values: resolved by this schema; both must outlive the section.
    Section(const Table& schema, const toml::table& values) : schema_(&schema), values_(&values) {}

    /// Whether the key is there.
    [[nodiscard]] bool has(const std::string& key) const { return values_->contains(key); }
    /// A quantity or number; throws std::logic_error when the key has no such value.
    [[nodiscard]] double number(const std::string& key) const;
    /// The same, nullopt when the key is absent or one of its words (such as "auto").
    [[nodiscard]] std::optional<double> maybe(const std::string& key) const;
    [[nodiscard]] std::vector<double> numbers(const std::string& key) const;  ///< empty when absent
    /// Three numbers or quantities; std::logic_error when the key has no such value, as for the following.
    [[nodiscard]] std::array<double, 3> vector(const std::string& key) const;
    [[nodiscard]] int integer(const std::string& key) const;
    [[nodiscard]] bool flag(const std::string& key) const;
    [[nodiscard]] std::string text(const std::string& key) const;  ///< "" when absent or not a text
    [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;  ///< of a text: itself
    /// The table of that key, if it is there.
    [[nodiscard]] std::optional<Section> table(const std::string& key) const;
    [[nodiscard]] std::vector<Section> tables(const std::string& key) const;  ///< of an array of tables
    [[nodiscard]] std::vector<std::string> keys() const;                      ///< all that are given
    [[nodiscard]] std::size_t count(const std::string& key) const;  ///< length of an array, 0 when it is none

  private:
    const Table* schema_;
    const toml::table* values_;
};

}  // namespace hemoflux::apps
