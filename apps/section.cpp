// Typed access to resolved tables.
#include <fmt/format.h>

#include <stdexcept>

#include "apps/toml_input.hpp"
#include "apps/units.hpp"

namespace hemoflux::apps {
namespace {

/// The forms of a key that is in the schema by construction.
const Key& known(const Table& schema, const std::string& key) {
    const Key* found = schema.find(key);
    if (found == nullptr) {
        throw std::logic_error(fmt::format("[{}] has no key {}", schema.name, key));
    }
    return *found;
}

std::optional<double> as_number(const Key& key, const toml::node& node) {
    if (const auto value = node.value<double>(); node.is_number()) {
        return value;
    }
    const auto word = node.value<std::string>();
    for (const Form& form : key.forms) {
        if (word && form.has_word(*word)) {
            return std::nullopt;
        }
    }
    for (const Form& form : key.forms) {
        if (word && form.type == Type::quantity) {
            return quantity(*word, form.unit);
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> Section::maybe(const std::string& key) const {
    const Key& known_key = known(*schema_, key);
    const toml::node* node = values_->get(key);
    return node == nullptr ? std::nullopt : as_number(known_key, *node);
}

double Section::number(const std::string& key) const {
    const auto value = maybe(key);
    if (!value) {
        throw std::logic_error(fmt::format("[{}] {} has no number", schema_->name, key));
    }
    return *value;
}

std::vector<double> Section::numbers(const std::string& key) const {
    const Key& known_key = known(*schema_, key);
    std::vector<double> values;
    if (const toml::array* array = (*values_)[key].as_array()) {
        for (const toml::node& item : *array) {
            values.push_back(as_number(known_key, item).value());
        }
    }
    return values;
}

std::array<double, 3> Section::vector(const std::string& key) const {
    const std::vector<double> values = numbers(key);
    return {values.at(0), values.at(1), values.at(2)};
}

int Section::integer(const std::string& key) const { return static_cast<int>(number(key)); }

bool Section::flag(const std::string& key) const {
    known(*schema_, key);
    return (*values_)[key].value<bool>().value();
}

std::string Section::text(const std::string& key) const {
    known(*schema_, key);
    return (*values_)[key].value_or(std::string());
}

std::vector<std::string> Section::texts(const std::string& key) const {
    known(*schema_, key);
    std::vector<std::string> words;
    if (const toml::array* array = (*values_)[key].as_array()) {
        for (const toml::node& item : *array) {
            words.push_back(item.value_or(std::string()));
        }
    } else if (has(key)) {
        words.push_back(text(key));
    }
    return words;
}

std::optional<Section> Section::table(const std::string& key) const {
    for (const Form& form : known(*schema_, key).forms) {
        const toml::table* values = (*values_)[key].as_table();
        if (form.type == Type::table && values != nullptr) {
            return Section(form.members.at(0), *values);
        }
    }
    return std::nullopt;
}

std::vector<std::string> Section::keys() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : *values_) {
        names.emplace_back(name.str());
    }
    return names;
}

std::size_t Section::count(const std::string& key) const {
    const toml::array* array = (*values_)[key].as_array();
    return array == nullptr ? 0 : array->size();
}

std::vector<Section> Section::tables(const std::string& key) const {
    std::vector<Section> sections;
    const Form& form = known(*schema_, key).forms.front();
    if (const toml::array* array = (*values_)[key].as_array()) {
        for (const toml::node& item : *array) {
            sections.emplace_back(form.members.at(0), *item.as_table());
        }
    }
    return sections;
}

}  // namespace hemoflux::apps
