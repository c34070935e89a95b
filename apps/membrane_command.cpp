#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "apps/case_check.hpp"
#include "apps/commands.hpp"
#include "apps/run.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

struct Arguments {
    std::string task;
    std::string nodes = "2562", reference = "uniform", shear_modulus;
    std::vector<std::string> forces;
    bool check = false;
    RunOptions options;
};

/// The case that the options describe.
Case case_of(const Arguments& in) {
    std::vector<std::string> sets{"membrane.task=" + in.task, "cell.0.nodes=" + in.nodes,
                                  "cell.0.reference=" + in.reference};
    if (!in.shear_modulus.empty()) {
        sets.push_back("cell.0.shear_modulus=" + in.shear_modulus);
    }
    if (!in.forces.empty()) {
        sets.push_back(fmt::format("membrane.forces=[\"{}\"]", fmt::join(in.forces, "\", \"")));
    }
    sets.insert(sets.end(), in.options.sets.begin(), in.options.sets.end());
    const std::string text =
        fmt::format("title = \"membrane {}\"\nkind = \"membrane\"\n[[cell]]\n[membrane]\n", in.task);
    return parse_case(text, "hemoflux membrane " + in.task, std::filesystem::current_path(), sets);
}

int run(Arguments& in) {
    const Case c = case_of(in);
    check_case(c);
    check_run(c);
    if (in.check) {
        fmt::print("{}\n# The case can be run.\n", c.resolved);
        return static_cast<int>(Exit::done);
    }
    if (in.options.output.empty()) {
        in.options.output = "results/membrane_" + in.task;
    }
    return run_membrane(c, in.options);
}

void add_task(CLI::App& parent, const std::string& task, const std::string& meaning, int& code) {
    CLI::App* command = parent.add_subcommand(task, meaning);
    const auto arguments = std::make_shared<Arguments>();
    arguments->task = task;
    command->add_option("--nodes", arguments->nodes, "Nodes of the icosphere [2562]");
    command->add_option("--reference", arguments->reference, "stress-free, uniform or spheroid [uniform]");
    command->add_option("--shear-modulus", arguments->shear_modulus, "K_S with its unit [6.1 uN/m]");
    if (task == "stretch") {
        command->add_option("--forces", arguments->forces, "Pulling forces with their unit, in this order");
    }
    command->add_option("--set", arguments->options.sets, "Any other key of a case: table.key=value")
        ->allow_extra_args(false);
    command->add_option("--output,-o", arguments->options.output,
                        "Output folder [results/membrane_" + task + "]");
    command
        ->add_option("--threads,-t", arguments->options.threads,
                     "Threads; 0: HEMOFLUX_THREADS, else all cores")
        ->check(CLI::Range(0, 4096));
    command->add_flag("--check", arguments->check, "Check and print the case with all defaults, and stop");
    command->add_flag("--quiet,-q", arguments->options.quiet, "Print errors only");
    command->footer(
        task == "stretch"
            ? "Example: hemoflux membrane stretch --reference stress-free --forces \"0 pN\" \"100 pN\""
            : "Example: hemoflux membrane relax --nodes 642 --set cell.0.volume=\"80 um^3\"");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace

void add_membrane_command(CLI::App& program, int& code) {
    CLI::App* command =
        program.add_subcommand("membrane", "One cell alone, at rest or pulled by optical tweezers");
    command->require_subcommand(1);
    command->footer(
        "Example: hemoflux membrane stretch --nodes 642 --forces \"0 pN\" \"50 pN\" --output results/pull");
    add_task(*command, "relax", "Relax the cell to its minimum of energy", code);
    add_task(*command, "stretch", "Relax the cell and pull its ends apart along x", code);
}

}  // namespace hemoflux::apps
