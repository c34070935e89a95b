// The schema of a case file for editors.
#include <json/json.h>

#include <cmath>

#include "apps/schema.hpp"
#include "apps/toml_input.hpp"

namespace hemoflux::apps {
namespace {

Json::Value of_table(const Table& table);

/// A default, which the schema holds as TOML text.
Json::Value json_of(const toml::node& node) {
    if (const toml::array* array = node.as_array()) {
        Json::Value out(Json::arrayValue);
        for (const toml::node& item : *array) out.append(json_of(item));
        return out;
    }
    if (const toml::table* table = node.as_table()) {
        Json::Value out(Json::objectValue);
        for (const auto& [key, value] : *table) out[std::string(key.str())] = json_of(value);
        return out;
    }
    if (node.is_boolean()) return Json::Value(*node.value<bool>());
    if (node.is_integer()) return Json::Value(static_cast<Json::Int64>(*node.value<std::int64_t>()));
    if (node.is_floating_point()) return Json::Value(*node.value<double>());
    return Json::Value(node.value_or(std::string()));
}

/// One value of a form, without its being one of a list.
Json::Value of_single(const Form& form) {
    Json::Value out(Json::objectValue);
    switch (form.type) {
        case Type::quantity:
            out["type"] = "string";
            out["pattern"] = "^\\s*[-+]?[0-9.]";
            out["description"] = "a quantity with its unit, which converts to " + form.unit +
                                 (form.range().empty() ? "" : "; " + form.range() + " " + form.unit);
            break;
        case Type::number:
        case Type::integer:
            out["type"] = form.type == Type::number ? "number" : "integer";
            if (std::isfinite(form.low)) out[form.open ? "exclusiveMinimum" : "minimum"] = form.low;
            if (std::isfinite(form.high)) out["maximum"] = form.high;
            for (const int value : form.values) out["enum"].append(value);
            break;
        case Type::flag:
            out["type"] = "boolean";
            break;
        case Type::text:
        case Type::path:
            out["type"] = "string";
            break;
        case Type::choice:
            for (const std::string& word : form.choices) out["enum"].append(word);
            break;
        case Type::table:
            return of_table(form.members.at(0));
        case Type::anything:
            break;
    }
    return out;
}

Json::Value of_form(const Form& form) {
    if (form.count == Form::single) return of_single(form);
    Json::Value out(Json::objectValue);
    out["type"] = "array";
    out["items"] = of_single(form);
    if (form.count != Form::any) {
        out["minItems"] = static_cast<Json::UInt64>(form.count);
        out["maxItems"] = static_cast<Json::UInt64>(form.count);
    }
    return out;
}

Json::Value of_key(const Key& key) {
    Json::Value out(Json::objectValue);
    if (key.forms.size() == 1)
        out = of_form(key.forms.front());
    else
        for (const Form& form : key.forms) out["anyOf"].append(of_form(form));
    const std::string more = out.get("description", "").asString();
    out["description"] = more.empty() ? key.meaning : key.meaning + "; " + more;
    if (!key.standard.empty())
        out["default"] = json_of(*parse_toml("value = " + key.standard, key.name).get("value"));
    return out;
}

Json::Value of_table(const Table& table) {
    Json::Value out(Json::objectValue);
    out["type"] = "object";
    out["description"] = table.meaning;
    out["properties"] = Json::Value(Json::objectValue);
    for (const Key& key : table.keys) {
        out["properties"][key.name] = of_key(key);
        if (key.required) out["required"].append(key.name);
    }
    out["additionalProperties"] = table.others.empty() ? Json::Value(false) : of_key(table.others.front());
    return out;
}

}  // namespace

std::string json_schema() {
    Json::Value root = of_table(case_schema());
    root["$schema"] = "http://json-schema.org/draft-07/schema#";
    root["title"] = "A case of hemoflux";
    return Json::writeString(Json::StreamWriterBuilder(), root) + "\n";
}

}  // namespace hemoflux::apps
