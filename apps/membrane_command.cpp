#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "apps/case_check.hpp"
#include "apps/cell_options.hpp"
#include "apps/commands.hpp"
#include "apps/run.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// A key of [membrane] given by an option of its own.
struct MembraneOption {
    std::string key;
    std::vector<std::string> values;
    bool list = false, quoted = false;  ///< how the case file writes it

    [[nodiscard]] std::string override_text() const {
        if (!list) return fmt::format("membrane.{}={}", key, values.front());
        return quoted ? fmt::format("membrane.{}=[\"{}\"]", key, fmt::join(values, "\", \""))
                      : fmt::format("membrane.{}=[{}]", key, fmt::join(values, ", "));
    }
};

struct Arguments {
    std::string task;
    CellOptions cell;
    std::vector<std::unique_ptr<MembraneOption>> options;
    std::vector<std::string> standard;  ///< overrides that come before all others
    bool refine = false, check = false;
    RunOptions run;

    void add(CLI::App& command, const char* name, const char* key, const char* meaning) {
        options.push_back(std::make_unique<MembraneOption>(MembraneOption{.key = key, .values = {}}));
        command.add_option(name, options.back()->values, meaning)->expected(1);
    }
    void add_list(CLI::App& command, const char* name, const char* key, bool quoted, const char* meaning) {
        options.push_back(std::make_unique<MembraneOption>(
            MembraneOption{.key = key, .values = {}, .list = true, .quoted = quoted}));
        command.add_option(name, options.back()->values, meaning);
    }
};

/// The case that the options describe.
Case case_of(const Arguments& in) {
    std::vector<std::string> sets{"membrane.task=" + in.task};
    sets.insert(sets.end(), in.standard.begin(), in.standard.end());
    for (const auto& option : in.options)
        if (!option->values.empty()) sets.push_back(option->override_text());
    if (in.refine) sets.emplace_back("membrane.refine=true");
    const std::vector<std::string> rest = in.cell.overrides();
    sets.insert(sets.end(), rest.begin(), rest.end());
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
    if (in.run.output.empty()) {
        in.run.output = "results/membrane_" + in.task;
    }
    return run_membrane(c, in.run);
}

struct Task {
    CLI::App* command;
    std::shared_ptr<Arguments> arguments;
};

Task add_task(CLI::App& parent, const std::string& task, const std::string& meaning, const char* examples,
              int& code) {
    CLI::App* command = parent.add_subcommand(task, meaning);
    const auto arguments = std::make_shared<Arguments>();
    arguments->task = task;
    add_cell_options(*command, arguments->cell);
    command->add_option("--output,-o", arguments->run.output,
                        "Output folder [results/membrane_" + task + "]");
    command
        ->add_option("--threads,-t", arguments->run.threads, "Threads; 0: HEMOFLUX_THREADS, else all cores")
        ->check(CLI::Range(0, 4096));
    command->add_flag("--check", arguments->check, "Check and print the case with all defaults, and stop");
    command->add_flag("--quiet,-q", arguments->run.quiet, "Print errors only");
    command->footer(examples);
    command->callback([arguments, &code] { code = run(*arguments); });
    return {command, arguments};
}

void add_motion(const Task& task) {
    task.arguments->add(*task.command, "--fluid-viscosity", "fluid_viscosity",
                        "Viscosity of the surrounding fluid in overdamped motion [1 mPa s]");
    task.arguments->add(*task.command, "--duration", "duration", "Longest overdamped motion [0.5 s]");
}

constexpr const char* forces = "Pulling forces with their unit, in this order [0, 50, 100, 150 pN]";
constexpr const char* contact = "Part of the nodes that each bead holds, or its contact diameter [0.02]";
constexpr const char* experiment =
    "CSV with columns F_pN, DA_um, DT_um and error bars DA_lo, DA_hi, DT_lo, DT_hi";

}  // namespace

void add_membrane_command(CLI::App& program, int& code) {
    CLI::App* command = program.add_subcommand("membrane", "Cells alone, without a fluid");
    command->require_subcommand(1);
    command->footer(
        "Examples: hemoflux membrane relax --nodes 642\n"
        "          hemoflux membrane stretch --nodes 642 --forces \"0 pN\" \"50 pN\" --output results/pull\n"
        "          hemoflux membrane relax --file own.stl");

    add_task(*command, "relax", "Relax the cell to its minimum of energy",
             "Examples: hemoflux membrane relax --nodes 642 --set cell.0.volume=\"80 um^3\"\n"
             "          hemoflux membrane relax --file own.ply --law skalak -o results/own",
             code);

    const Task stretch =
        add_task(*command, "stretch", "Relax the cell and pull its ends apart along x (optical tweezers)",
                 "Examples: hemoflux membrane stretch --reference stress-free --forces \"0 pN\" \"100 pN\"\n"
                 "          hemoflux membrane stretch --contact \"2 um\" --law neo-hookean\n"
                 "          hemoflux membrane stretch --nodes 642 --solver dynamic --forces \"100 pN\"",
                 code);
    stretch.arguments->add_list(*stretch.command, "--forces", "forces", true, forces);
    stretch.arguments->add(*stretch.command, "--contact", "contact", contact);
    stretch.arguments->add(*stretch.command, "--solver", "solver",
                           "static, or dynamic: overdamped motion until the cell rests [static]");
    stretch.arguments->add(*stretch.command, "--experiment", "experiment", experiment);
    add_motion(stretch);

    const Task shapes =
        add_task(*command, "shapes", "Relax the cell at every c0 and M0 and say what it becomes",
                 "Example: hemoflux membrane shapes --nodes 2562 --reference spheroid --curvatures 0 6 12 "
                 "--area-differences 1 3 5",
                 code);
    shapes.arguments->add_list(*shapes.command, "--curvatures", "curvatures", false, "Values of c0 [6]");
    shapes.arguments->add_list(*shapes.command, "--area-differences", "area_differences", false,
                               "Values of M0/(8 pi R0) [1]");
    shapes.command->add_flag("--refine", shapes.arguments->refine,
                             "Repeat with four times the nodes and report the change of energy");

    add_task(
        *command, "moduli", "Measure the moduli of a flat sheet under every in-plane law",
        "Example: hemoflux membrane moduli --shear-modulus \"4 uN/m\" --set cell.0.local_area_modulus=\"0 "
        "N/m\"",
        code);

    const Task recovery = add_task(
        *command, "relax-back", "Stretch the cell, let it go and measure how fast it recovers",
        "Example: hemoflux membrane relax-back --nodes 642 --reference stress-free --forces \"60 pN\" "
        "--set cell.0.membrane_viscosity=\"0.7 uPa s m\"",
        code);
    recovery.arguments->standard = {"membrane.forces=[\"60 pN\"]",
                                    "cell.0.membrane_viscosity=\"0.7 uPa s m\""};
    recovery.arguments->add_list(*recovery.command, "--forces", "forces", true,
                                 "Pulling forces; the cell is let go from the last [60 pN]");
    recovery.arguments->add(*recovery.command, "--contact", "contact", contact);
    recovery.arguments->add_list(*recovery.command, "--recovery", "recovery", true,
                                 "CSV files with columns t (s) and L_W to compare with");
    add_motion(recovery);

    const Task calibrate =
        add_task(*command, "calibrate", "Fit K_S and c0 to measured stretch curves, with their confidence",
                 "Example: hemoflux membrane calibrate --nodes 642 --reference stress-free --experiment "
                 "apps/cases/reference/mills2004_optical_tweezers.csv",
                 code);
    calibrate.arguments->add(*calibrate.command, "--experiment", "experiment", experiment);
    calibrate.arguments->add_list(*calibrate.command, "--shear-bounds", "shear_bounds", true,
                                  "K_S is sought between these two [1 uN/m, 20 uN/m]");
    calibrate.arguments->add_list(*calibrate.command, "--curvature-bounds", "curvature_bounds", false,
                                  "c0 is sought between these two [0, 10]");
    calibrate.arguments->add(*calibrate.command, "--contact", "contact", contact);
}

}  // namespace hemoflux::apps
