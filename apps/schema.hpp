/// The description of every table of a case file, written once. Parsing, error messages, the resolved echo,
/// the reference page and the JSON schema (`hemoflux schema`) all come from it.
#pragma once

#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace hemoflux::apps {

struct Table;

/// What one value is, before units and ranges.
enum class Type { quantity, number, integer, flag, text, choice, path, table, anything };

/// One way to write a value. A key may allow several, e.g. a number or "auto".
struct Form {
    static constexpr std::size_t single = 0;
    static constexpr std::size_t any = std::numeric_limits<std::size_t>::max();

    Type type;
    std::string unit = {};                  ///< unit the program receives a quantity in
    std::vector<std::string> choices = {};  ///< allowed words of a choice
    std::vector<Table> members;             ///< exactly one table, for Type::table (which is incomplete here)
    std::size_t count = single;             ///< single value, array of this many, or array of any number
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open = false;             ///< low itself is not allowed
    std::string because = {};      ///< why the range is what it is; ends the sentence "... is out of range, "
    std::vector<int> values = {};  ///< the only numbers allowed; empty: all of the range

    /// The same form with values > bound.
    [[nodiscard]] Form above(double bound, std::string why) const;
    /// The same form with values of at most `bound` as well.
    [[nodiscard]] Form up_to(double bound) const;
    /// The same form with values in [from, to].
    [[nodiscard]] Form within(double from, double to, std::string why) const;
    /// The same form with these numbers only.
    [[nodiscard]] Form among(std::initializer_list<int> numbers, std::string why) const;
    /// The same form as an array of n values (Form::any: any number of them).
    [[nodiscard]] Form of(std::size_t n) const;

    /// Whether the form is a choice that has this word.
    [[nodiscard]] bool has_word(std::string_view word) const;
    /// In words: "a quantity in um", "3 whole numbers", "one of a, b".
    [[nodiscard]] std::string describe() const;
    /// The range in words, "" when unbounded: "> 0", "1 .. 40", "of 42, 162".
    [[nodiscard]] std::string range() const;
    /// Whether a number is allowed.
    [[nodiscard]] bool holds(double value) const;
};

/// The forms of a value: a quantity that arrives in `unit`, a number, a whole number, true or false, any text, a path
/// (which becomes absolute), one of some words, a table.
Form quantity_in(std::string unit);
Form number();
Form integer();
Form flag();
Form text();
Form path();
Form choice(std::initializer_list<const char*> words);
Form automatic();  ///< the word "auto": chosen by the program and printed
Form table(Table members);
Form anything();  ///< any TOML value, checked elsewhere

/// One key of a table.
struct Key {
    std::string name;
    std::vector<Form> forms;
    std::string standard;  ///< default as TOML text; "" when the key has none
    std::string meaning;   ///< one line
    bool required = false;
};

/// One table: "[fluid]", "[[cell]]", or an inline one.
struct Table {
    std::string name;
    std::string meaning;
    std::vector<Key> keys;
    std::vector<Key> others = {};  ///< at most one: what keys of any other name are

    /// The key called `name`, else what keys of other names are, or nullptr.
    [[nodiscard]] const Key* find(std::string_view key) const;
};

/// The whole case file: its keys are title, kind and the tables.
const Table& case_schema();

/// Its tables that fill a source of their own.
Table cell_table();
Table rigid_body_table();
Table observables_table();
Table profile_table();
Table membrane_table();
Table tweezers_table();
Table boundary_table();
Table body_force_table();
Table analytical_table();
Table sweep_table();
Table mesh_table();
Table steady_table();
Table contact_table();
Table packing_table();
Table watchdog_table();

/// The known name nearest to `word` by edit distance, "" when none is near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

/// A remedy: the nearest known name, or the list of all of them.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// The reference page of the case file in Markdown.
std::string schema_page();

/// The same as a JSON schema (draft 7), with which editors check and complete a case file as it is written.
std::string json_schema();

}  // namespace hemoflux::apps
