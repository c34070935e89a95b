#include <fmt/format.h>

#include <memory>

#include "apps/case_check.hpp"
#include "apps/commands.hpp"
#include "apps/estimate.hpp"
#include "apps/run.hpp"
#include "apps/sweep.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

struct Arguments {
    std::string file;
    bool check = false;
    RunOptions options;
};

/// `--restart DIR` alone continues the case that was resolved into DIR, in DIR.
void complete(Arguments& arguments) {
    RunOptions& options = arguments.options;
    if (arguments.file.empty() && options.restart.empty()) {
        throw InputError("No case is given", "there is nothing to run",
                         "Write hemoflux run CASE.toml, or hemoflux run --restart DIR");
    }
    if (arguments.file.empty()) {
        arguments.file = (options.restart / "resolved.toml").string();
    }
    if (options.output.empty()) {
        options.output = options.restart.empty()
                             ? std::filesystem::path("results") / std::filesystem::path(arguments.file).stem()
                             : options.restart;
    }
}

int run(Arguments& arguments) {
    complete(arguments);
    const Case c = read_case(arguments.file, arguments.options.sets);
    const std::vector<std::string> warnings = check_case(c);
    if (arguments.check && arguments.options.threads > 0) exchange::set_threads(arguments.options.threads);
    // before the warnings, so that a case which cannot be run gives its error alone
    const std::string numbers = arguments.check ? derived_numbers(c) : "";
    for (const std::string& warning : warnings) {
        fmt::print(stderr, "warning: {}.\n", warning);
    }
    if (arguments.check) {
        fmt::print("{}\n{}# The case can be run.\n", c.resolved, numbers);
        return static_cast<int>(Exit::done);
    }
    if (c.kind == CaseKind::membrane) {
        return run_membrane(c, arguments.options);
    }
    return run_case(c, arguments.options);
}

/// What run and sweep have in common.
CLI::App* add_options(CLI::App& program, const char* name, const char* meaning, Arguments& arguments) {
    CLI::App* command = program.add_subcommand(name, meaning);
    command->add_option("CASE", arguments.file, "Case file (TOML)");
    command->add_option("--output,-o", arguments.options.output, "Output folder [results/CASE]");
    command
        ->add_option("--threads,-t", arguments.options.threads,
                     "Threads; 0: HEMOFLUX_THREADS, else all cores")
        ->check(CLI::Range(0, 4096));
    command->add_option("--set", arguments.options.sets, "Override a key of the case: table.key=value")
        ->allow_extra_args(false);
    command->add_flag("--check", arguments.check, "Check the case, print what would be run, and stop");
    command->add_flag("--quiet,-q", arguments.options.quiet, "Print errors only");
    return command;
}

}  // namespace

void add_sweep_command(CLI::App& program, int& code) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = add_options(program, "sweep", "Run a case for all values of its [sweep]", *arguments);
    command->footer(
        "The same command continues a sweep that was interrupted.\n"
        "Examples: hemoflux sweep apps/cases/taylor_green_space.toml\n"
        "          hemoflux sweep case.toml --set numerics.gradient=green-gauss --output results/sweep");
    command->callback([arguments, &code] {
        complete(*arguments);
        code = run_sweep(arguments->file, arguments->options, arguments->check);
    });
}

void add_run_command(CLI::App& program, int& code) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = add_options(program, "run", "Run a case", *arguments);
    command->add_option("--restart", arguments->options.restart, "Continue the run in this folder");
    command->footer(
        "Examples: hemoflux run apps/cases/tank_treading.toml --threads 2\n"
        "          hemoflux run case.toml --set shear.rate=\"5 1/s\" --set cell.0.nodes=642 --output "
        "results/fast\n"
        "          hemoflux run --restart results/fast");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace hemoflux::apps
