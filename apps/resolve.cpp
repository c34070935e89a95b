// Checks TOML values against the schema and fills in defaults.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "apps/toml_input.hpp"
#include "apps/units.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

namespace fs = std::filesystem;

/// "shear.toml, line 12", or the --set assignment that the node came from.
std::string place(const toml::source_region& source) {
    const std::string file = source.path ? *source.path : "default";
    return file.starts_with("--set") || source.begin.line == 0
               ? file
               : fmt::format("{}, line {}", file, source.begin.line);
}

/// One value with its address, checked against the forms of its key.
class Checker {
  public:
    /// name: the key's name in the file.
    Checker(const Key& key, std::string name, std::string address, const fs::path& folder)
        : key_(key), name_(std::move(name)), address_(std::move(address)), folder_(folder) {}

    /// Appends the checked value to `out` under its name.
    void check(const toml::node& value, toml::table& out) const;

  private:
    [[nodiscard]] bool fits(const Form& form, const toml::node& value) const;
    void check_as(const Form& form, const toml::node& value, toml::table& out) const;
    void check_scalar(const Form& form, const toml::node& value) const;
    void check_range(const Form& form, double value, const toml::node& node) const;
    [[noreturn]] void refuse(const toml::node& value, const std::string& why,
                             const std::string& remedy = "") const;

    const Key& key_;
    std::string name_, address_;
    const fs::path& folder_;
};

void Checker::refuse(const toml::node& value, const std::string& why, const std::string& remedy) const {
    std::string expected;
    for (const Form& form : key_.forms) {
        expected += (expected.empty() ? "" : ", or ") + form.describe();
    }
    throw InputError(fmt::format("{}: {} = {}", place(value.source()), address_, value_text(value)), why,
                     remedy.empty() ? "Give " + expected : remedy);
}

/// Does the value have the TOML type of this form? Words of a choice and texts are told apart later.
bool scalar_fits(const Form& form, const toml::node& value) {
    switch (form.type) {
        case Type::quantity:
        case Type::text:
        case Type::choice:
        case Type::path:
            return value.is_string();
        case Type::number:
            return value.is_number();
        case Type::integer:
            return value.is_integer();
        case Type::flag:
            return value.is_boolean();
        case Type::table:
            return value.is_table();
        case Type::anything:
            return true;
    }
    return false;
}

bool Checker::fits(const Form& form, const toml::node& value) const {
    if (form.count == Form::single) {
        if (form.type == Type::choice && key_.forms.size() > 1) {  // another form may take other words
            const auto word = value.value<std::string>();
            return word && form.has_word(*word);
        }
        return scalar_fits(form, value);
    }
    const toml::array* array = value.as_array();
    if (array == nullptr || (form.count != Form::any && array->size() != form.count)) {
        return false;
    }
    return std::all_of(array->begin(), array->end(),
                       [&](const toml::node& item) { return scalar_fits(form, item); });
}

void Checker::check_range(const Form& form, double value, const toml::node& node) const {
    if (!form.holds(value)) {
        const std::string unit = form.unit.empty() ? "" : " " + form.unit;
        refuse(node, fmt::format("out of range, {}", form.because.empty() ? "no such value" : form.because),
               form.range().empty() ? "Give a finite number"
                                    : fmt::format("Choose a value {}{}", form.range(), unit));
    }
}

void Checker::check_scalar(const Form& form, const toml::node& value) const {
    if (form.type == Type::quantity) {
        double converted = 0;
        try {
            converted = quantity(*value.value<std::string>(), form.unit);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", place(value.source()), address_), "bad quantity",
                             std::string(error.what(), std::strlen(error.what()) - 1));
        }
        check_range(form, converted, value);
    } else if (form.type == Type::number || form.type == Type::integer) {
        check_range(form, *value.value<double>(), value);
    } else if (form.type == Type::choice) {
        const std::string word = *value.value<std::string>();
        if (!form.has_word(word)) {
            refuse(value, "no such choice", suggestion(word, form.choices));
        }
    }
}

void Checker::check_as(const Form& form, const toml::node& value, toml::table& out) const {
    if (form.type == Type::table) {
        if (form.count == Form::single) {
            out.insert_or_assign(name_, resolve(form.members.at(0), *value.as_table(), folder_));
            return;
        }
        toml::array tables;
        for (const toml::node& item : *value.as_array()) {
            tables.push_back(resolve(form.members.at(0), *item.as_table(), folder_));
        }
        out.insert_or_assign(name_, std::move(tables));
        return;
    }
    if (const toml::array* array = value.as_array()) {
        for (const toml::node& item : *array) {
            check_scalar(form, item);
        }
    } else {
        check_scalar(form, value);
    }
    if (form.type == Type::path && form.count != Form::single) {
        toml::array files;
        for (const toml::node& item : *value.as_array())
            files.push_back((folder_ / *item.value<std::string>()).lexically_normal().string());
        out.insert_or_assign(name_, std::move(files));
    } else if (form.type == Type::path) {
        const fs::path file = *value.value<std::string>();
        out.insert_or_assign(name_, (folder_ / file).lexically_normal().string());
    } else {
        out.insert_or_assign(name_, value);
    }
}

void Checker::check(const toml::node& value, toml::table& out) const {
    for (const Form& form : key_.forms) {
        if (fits(form, value)) {
            check_as(form, value, out);
            return;
        }
    }
    const bool bare_number =
        value.is_number() && std::any_of(key_.forms.begin(), key_.forms.end(), [](const Form& f) {
            return f.type == Type::quantity && f.count == Form::single;
        });
    refuse(value, bare_number ? "the unit is missing" : "this is not what the key takes");
}

}  // namespace

toml::table resolve(const Table& schema, const toml::table& values, const fs::path& folder) {
    const bool top = schema.name == case_schema().name;
    const std::string where = top ? "the top level" : fmt::format("[{}]", schema.name);
    for (const auto& [name, value] : values) {
        if (schema.find(name.str()) == nullptr) {
            std::vector<std::string> known;
            for (const Key& key : schema.keys) {
                known.push_back(key.name);
            }
            throw InputError(
                fmt::format("{}: unknown key \"{}\" in {}", place(value.source()), name.str(), where),
                "it would have no effect", suggestion(name.str(), known));
        }
    }
    toml::table out;
    const auto address = [&](const std::string& name) {
        return top ? name : fmt::format("{}.{}", schema.name, name);
    };
    if (!schema.others.empty()) {
        for (const auto& [key, value] : values) {
            const std::string name(key.str());
            if (schema.find(name) == &schema.others.front()) {
                Checker(schema.others.front(), name, address(name), folder).check(value, out);
            }
        }
    }
    for (const Key& key : schema.keys) {
        const Checker checker(key, key.name, address(key.name), folder);
        if (const toml::node* value = values.get(key.name)) {
            checker.check(*value, out);
        } else if (!key.standard.empty()) {
            const toml::table standard = toml::parse("value = " + key.standard);
            checker.check(*standard.get("value"), out);
        } else if (key.required) {
            throw InputError(
                fmt::format("{}: key \"{}\" is missing in {}", place(values.source()), key.name, where),
                fmt::format("it has no default ({})", key.meaning),
                fmt::format("Add {} = {}", key.name, key.forms.front().describe()));
        }
    }
    return out;
}

}  // namespace hemoflux::apps
