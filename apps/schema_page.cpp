#include <fmt/format.h>

#include "apps/schema.hpp"

namespace hemoflux::apps {
namespace {

/// Tables first seen as members of others get their own section, after their parent.
std::string section(const Table& table, const std::string& title) {
    std::string page = fmt::format("## {}\n\n{}\n\n", title, table.meaning);
    page += "| Key | Value | Range | Default | Meaning |\n|---|---|---|---|---|\n";
    std::string inner;
    std::vector<Key> keys = table.keys;
    keys.insert(keys.end(), table.others.begin(), table.others.end());
    for (const Key& key : keys) {
        std::string values;
        std::string ranges;
        for (const Form& form : key.forms) {
            values += (values.empty() ? "" : " or ") + form.describe();
            const std::string range = form.range();
            ranges += range.empty() ? ""
                                    : (ranges.empty() ? "" : " or ") + range +
                                          (form.unit.empty() ? "" : " " + form.unit);
            if (form.type == Type::table) {
                const bool array = form.count != Form::single;
                const std::string& name = form.members[0].name;
                const std::string known = array ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
                if (inner.find("## " + known) == std::string::npos) inner += section(form.members[0], known);
            }
        }
        const std::string standard = key.required           ? "required"
                                     : key.standard.empty() ? "none"
                                                            : fmt::format("`{}`", key.standard);
        page +=
            fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, values, ranges, standard, key.meaning);
    }
    return page + "\n" + inner;
}

}  // namespace

std::string schema_page() {
    return "# The case file\n\nA case is one TOML file. Quantities are texts with their unit; every multiple "
           "and "
           "every other unit of the same dimension that UDUNITS-2 knows is accepted. Any key can be set on "
           "the "
           "command line: `--set fluid.viscosity=\"6 mPa s\"`, `--set cell.0.nodes=642`.\n\n" +
           section(case_schema(), "Top level");
}

}  // namespace hemoflux::apps
