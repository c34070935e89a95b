#include <fmt/format.h>

#include <memory>

#include "apps/commands.hpp"
#include "apps/schema.hpp"

namespace hemoflux::apps {

void add_schema_command(CLI::App& program) {
    CLI::App* schema =
        program.add_subcommand("schema", "Print every table and key of a case file (Markdown)");
    const auto json = std::make_shared<bool>(false);
    schema->add_flag("--json", *json, "As a JSON schema, for editors that check and complete TOML");
    schema->footer(
        "Examples: hemoflux schema > reference.md\n"
        "          hemoflux schema --json > hemoflux.schema.json   # then, on top of a case: #:schema "
        "hemoflux.schema.json");
    schema->callback([json] { fmt::print("{}", *json ? json_schema() : schema_page()); });
}

}  // namespace hemoflux::apps
