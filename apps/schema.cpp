#include "apps/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hemoflux::apps {

Form Form::above(double bound, std::string why) const {
    Form form = *this;
    form.low = bound;
    form.open = true;
    form.because = std::move(why);
    return form;
}

Form Form::up_to(double bound) const {
    Form form = *this;
    form.high = bound;
    return form;
}

Form Form::within(double from, double to, std::string why) const {
    Form form = *this;
    form.low = from;
    form.high = to;
    form.because = std::move(why);
    return form;
}

Form Form::among(std::initializer_list<int> numbers, std::string why) const {
    Form form = *this;
    form.values.assign(numbers.begin(), numbers.end());
    form.because = std::move(why);
    return form;
}

Form Form::of(std::size_t n) const {
    Form form = *this;
    form.count = n;
    return form;
}

bool Form::has_word(std::string_view word) const {
    return type == Type::choice && std::find(choices.begin(), choices.end(), word) != choices.end();
}

std::string Form::describe() const {
    const bool many = count != single;
    std::string words;
    switch (type) {
        case Type::quantity:
            words = fmt::format("{}, as text with the unit, e.g. \"1 {}\"",
                                many ? "quantities" : "a quantity", unit);
            break;
        case Type::number:
            words = many ? "numbers" : "a number";
            break;
        case Type::integer:
            words = many ? "whole numbers" : "a whole number";
            break;
        case Type::flag:
            words = "true or false";
            break;
        case Type::text:
            words = many ? "texts" : "a text";
            break;
        case Type::path:
            words = "the path of a file";
            break;
        case Type::choice:
            words = choices.size() == 1 ? fmt::format("\"{}\"", choices[0])
                                        : fmt::format("{} \"{}\"", many ? "words of" : "one of",
                                                      fmt::join(choices, "\", \""));
            break;
        case Type::anything:
            words = many ? "values" : "a value";
            break;
        case Type::table:
            return many ? fmt::format("tables [[{}]]", members.at(0).name)
                        : fmt::format("a table [{}]", members.at(0).name);
    }
    if (!many) {
        return words;
    }
    return count == any ? "a list of " + words : fmt::format("a list of {} {}", count, words);
}

bool Form::holds(double value) const {
    const bool listed = values.empty() || std::find(values.begin(), values.end(), value) != values.end();
    return listed && (open ? value > low : value >= low) && value <= high && std::isfinite(value);
}

std::string Form::range() const {
    if (!values.empty()) return fmt::format("of {}", fmt::join(values, ", "));
    const bool below = std::isfinite(low);
    const bool above_too = std::isfinite(high);
    if (below && above_too) {
        return open ? fmt::format("> {}, <= {}", low, high) : fmt::format("{} .. {}", low, high);
    }
    if (below) {
        return fmt::format("{} {}", open ? ">" : ">=", low);
    }
    return above_too ? fmt::format("<= {}", high) : "";
}

namespace {

Form of_type(Type type) {
    Form form{};
    form.type = type;
    return form;
}

}  // namespace

Form quantity_in(std::string unit) {
    Form form = of_type(Type::quantity);
    form.unit = std::move(unit);
    return form;
}

Form choice(std::initializer_list<const char*> words) {
    Form form = of_type(Type::choice);
    form.choices.assign(words.begin(), words.end());
    return form;
}

Form table(Table members) {
    Form form = of_type(Type::table);
    form.members.push_back(std::move(members));
    return form;
}

Form number() { return of_type(Type::number); }
Form integer() { return of_type(Type::integer); }
Form flag() { return of_type(Type::flag); }
Form text() { return of_type(Type::text); }
Form path() { return of_type(Type::path); }
Form automatic() { return choice({"auto"}); }
Form anything() { return of_type(Type::anything); }

const Key* Table::find(std::string_view key) const {
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
    if (found != keys.end()) return &*found;
    return others.empty() ? nullptr : &others.front();
}

namespace {

/// Levenshtein distance: insertions, deletions and substitutions that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& name : known) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < least && distance < name.size()) {
            least = distance;
            best = name;
        }
    }
    return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
    const std::string near = nearest_name(word, known);
    return near.empty() ? fmt::format("Known are: {}", fmt::join(known, ", "))
                        : fmt::format("Perhaps \"{}\" was meant", near);
}

}  // namespace hemoflux::apps
