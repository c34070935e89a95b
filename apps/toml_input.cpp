#include "apps/toml_input.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

#include "exchange/error.hpp"

namespace hemoflux::apps {

toml::table parse_toml(const std::string& text, const std::string& name) {
    try {
        return toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}, line {}, column {}", name, error.source().begin.line,
                                     error.source().begin.column),
                         fmt::format("this is not valid TOML, {}", error.description()),
                         "Correct the line; texts and quantities need quotes: key = \"12 um\"");
    }
}

toml::table read_toml(const std::filesystem::path& file) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream) {
        text << stream.rdbuf();
    }
    if (!stream || std::filesystem::is_directory(file)) {
        throw FileError(
            fmt::format("Case file {}", file.string()),
            fmt::format("it cannot be read ({})", errno != 0 ? std::strerror(errno) : "not a file"),
            "Check the path and its permissions");
    }
    return parse_toml(text.str(), file.string());
}

namespace {

/// The value of an assignment: TOML if it is, else the bare text.
toml::table parse_assignment(const std::string& value, const std::string& name) {
    try {
        return toml::parse("value = " + value, name);
    } catch (const toml::parse_error&) {
        toml::table bare = toml::parse("value = ''", name);
        *bare.get_as<std::string>("value") = value;
        return bare;
    }
}

std::vector<std::string> split(const std::string& address) {
    std::vector<std::string> parts;
    std::istringstream stream(address);
    for (std::string part; std::getline(stream, part, '.');) {
        parts.push_back(part);
    }
    return parts;
}

}  // namespace

void override_value(toml::table& values, const std::string& assignment) {
    const std::string name = "--set " + assignment;
    const auto sign = assignment.find('=');
    const std::vector<std::string> parts = split(assignment.substr(0, sign));
    bool empty = parts.empty() || sign == std::string::npos;
    for (const std::string& part : parts) {
        empty = empty || part.empty();
    }
    if (empty) {
        throw InputError(name, "this is not table.key=value", "Write for example --set shear.rate=\"2 1/s\"");
    }
    toml::table parsed = parse_assignment(assignment.substr(sign + 1), name);
    // moved, not copied: a copy forgets where it came from
    const auto assign = [&](auto&& place) {
        parsed.get("value")->visit([&](auto& value) { place(std::move(value)); });
    };
    toml::node* node = &values;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string& part = parts[i];
        if (toml::array* array = node->as_array()) {
            std::size_t index = 0;
            const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), index);
            if (status != std::errc() || end != part.data() + part.size() || index >= array->size()) {
                throw InputError(name,
                                 fmt::format("there is no element \"{}\" among {}", part, array->size()),
                                 "Elements are numbered from 0, as in --set cell.0.nodes=642");
            }
            if (i + 1 == parts.size()) {
                const auto at = array->cbegin() + static_cast<std::ptrdiff_t>(index);
                assign([&](auto&& value) { array->replace(at, std::forward<decltype(value)>(value)); });
            }
            node = array->get(index);
        } else if (toml::table* inner = node->as_table()) {
            if (i + 1 == parts.size()) {
                assign([&](auto&& value) {
                    inner->insert_or_assign(part, std::forward<decltype(value)>(value));
                });
            } else if (!inner->contains(part)) {
                inner->insert(part, toml::table{});
            }
            node = inner->get(part);
        } else {
            throw InputError(
                name, fmt::format("\"{}\" is no table that could have a key \"{}\"", parts[i - 1], part),
                "`hemoflux schema` lists all tables and keys");
        }
    }
}

namespace {

std::string printed_key(const std::string& key) {
    return key.find_first_of("+-. ") == std::string::npos ? key : fmt::format("\"{}\"", key);
}

}  // namespace

std::string value_text(const toml::node& node) {
    std::string text;
    if (const toml::array* array = node.as_array()) {
        for (const toml::node& item : *array) {
            text += (text.empty() ? "" : ", ") + value_text(item);
        }
        return fmt::format("[{}]", text);
    }
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table) {
            text += fmt::format("{}{} = {}", text.empty() ? " " : ", ", printed_key(std::string(key.str())),
                                value_text(value));
        }
        return fmt::format("{{{} }}", text);
    }
    if (const auto number = node.value<double>(); node.is_floating_point()) {
        return fmt::format("{}", *number);  // the fewest digits that read back as the same number
    }
    std::ostringstream out;
    node.visit([&](const auto& value) { out << toml::toml_formatter{value, toml::format_flags::none}; });
    return out.str();
}

namespace {

/// "key = value" lines of a table; its own tables follow as [sections], deeper ones stay inline.
void print_values(std::ostream& out, const Table& schema, const toml::table& values, bool top) {
    const auto is_section = [](const toml::node& node) {
        return node.is_table() || (node.is_array() && node.as_array()->is_array_of_tables());
    };
    for (const Key& key : schema.keys) {
        const toml::node* node = values.get(key.name);
        if (node != nullptr && !(top && is_section(*node))) {
            out << printed_key(key.name) << " = " << value_text(*node) << '\n';
        }
    }
    if (!schema.others.empty()) {
        for (const auto& [name, node] : values) {
            if (schema.find(name.str()) == &schema.others.front()) {
                out << printed_key(std::string(name.str())) << " = " << value_text(node) << '\n';
            }
        }
    }
    if (!top) {
        return;
    }
    for (const Key& key : schema.keys) {
        const toml::node* node = values.get(key.name);
        if (node == nullptr || !is_section(*node)) {
            continue;
        }
        const Table& inner = key.forms.front().members.at(0);
        if (const toml::table* table = node->as_table()) {
            out << "\n[" << key.name << "]\n";
            print_values(out, inner, *table, false);
        } else {
            for (const toml::node& element : *node->as_array()) {
                out << "\n[[" << key.name << "]]\n";
                print_values(out, inner, *element.as_table(), false);
            }
        }
    }
}

}  // namespace

std::string to_toml(const Table& schema, const toml::table& resolved) {
    std::ostringstream out;
    print_values(out, schema, resolved, true);
    return out.str();
}

}  // namespace hemoflux::apps
