// The program `hemoflux`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "apps/commands.hpp"
#include "apps/output/gallery.hpp"
#include "apps/output/pictures.hpp"
#include "apps/report/command.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace {

/// Names of the subcommands of a command, as words.
std::string subcommands(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* each : command.get_subcommands({})) names.push_back(each->get_name());
    return fmt::format("{}", fmt::join(names, ", "));
}

/// The message for a command line that cannot be read, in the form of all messages.
std::string usage_error(const CLI::App& program, const CLI::Error& error,
                        const std::vector<std::string>& words) {
    const CLI::App* command = &program;
    std::string path = "hemoflux", what = error.what(), why = "the command line cannot be understood";
    for (const std::string& word : words) {
        if (command->get_subcommands({}).empty() || word.starts_with('-')) break;
        const auto found =
            command->get_subcommands([&](const CLI::App* each) { return each->get_name() == word; });
        const CLI::App* next = found.empty() ? nullptr : found.front();
        if (!next) {
            what = fmt::format("\"{}\" is not a command", word);
            why = fmt::format("{} has {}", path, subcommands(*command));
            return fmt::format("error: {}: {}. See {} --help.\n", what, why, path);
        }
        command = next;
        path += " " + word;
    }
    if (command->get_require_subcommand_min() > 0 && command->get_subcommands().empty()) {
        what = "no command is given";
        why = fmt::format("{} needs one of {}", path, subcommands(*command));
    }
    return fmt::format("error: {}: {}. See {} --help.\n", what, why, path);
}

int run_program(int argc, char** argv) {
    CLI::App program(
        "Red blood cells in flow: lattice Boltzmann flux solver, immersed boundary, spring-particle "
        "membrane.",
        "hemoflux");
    program.footer(
        "Examples: hemoflux run apps/cases/tank_treading_quick.toml --output results/quick\n"
        "          hemoflux report results/quick\n"
        "Exit codes: 0 done, 2 bad input, 3 numerical failure, 4 unreadable or unwritable files, 130 "
        "interrupted");
    program.set_version_flag(
        "--version", fmt::format("hemoflux {} ({})", HEMOFLUX_VERSION, hemoflux::exchange::backend_name()));
    program.require_subcommand(1);
    int code = static_cast<int>(hemoflux::Exit::done);
    hemoflux::apps::add_run_command(program, code);
    hemoflux::apps::add_sweep_command(program, code);
    hemoflux::apps::add_mesh_command(program);
    hemoflux::apps::add_membrane_command(program, code);
    hemoflux::apps::add_bench_command(program);
    hemoflux::apps::add_schema_command(program);
    hemoflux::report::add_report_command(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help and --version arrive here too
        fmt::print(stderr, "{}", usage_error(program, error, {argv + 1, argv + argc}));
        return static_cast<int>(hemoflux::Exit::bad_input);
    }
    return code;
}

/// Ends a child that draws (output/pictures.hpp), without exit handlers: graphics drivers leak in theirs.
[[noreturn]] void leave(int code) {
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGXFSZ,
                SIG_IGN);  // a limit on the size of files is then an error of write(), with its message
    hemoflux::exchange::limit_spinning(argv);
    try {
        if (argc > 1 && std::string(argv[1]) == "render-pictures")
            leave(hemoflux::output::render_pictures_main({argv + 2, argv + argc}));
        if (argc > 1 && std::string(argv[1]) == "render-gallery")
            leave(hemoflux::output::render_gallery_main({argv + 2, argv + argc}));
        return run_program(argc, argv);
    } catch (const hemoflux::Error& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr,
                   "error: The memory is exhausted: the case does not fit. Use fewer cells or nodes.\n");
        return static_cast<int>(hemoflux::Exit::numerical);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}: the system refused what the run needs. Check paths and free space.\n",
                   error.what());
        return static_cast<int>(hemoflux::Exit::file);
    }
}
