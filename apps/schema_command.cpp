#include <fmt/format.h>

#include "apps/commands.hpp"
#include "apps/schema.hpp"

namespace hemoflux::apps {

void add_schema_command(CLI::App& program) {
    CLI::App* schema =
        program.add_subcommand("schema", "Print every table and key of a case file (Markdown)");
    schema->footer("Example: hemoflux schema > reference.md");
    schema->callback([] { fmt::print("{}", schema_page()); });
}

}  // namespace hemoflux::apps
