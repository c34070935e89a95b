// The program `hemoflux`.
#include <fmt/format.h>

#include <cstdio>
#include <new>
#include <string>

#include "apps/commands.hpp"
#include "apps/output/pictures.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"

namespace {

int run_program(int argc, char** argv) {
    CLI::App program(
        "Red blood cells in flow: lattice Boltzmann flux solver, immersed boundary, spring-particle "
        "membrane.",
        "hemoflux");
    program.footer(
        "Example: hemoflux run apps/cases/tank_treading_quick.toml --output results/quick\n"
        "Exit codes: 0 done, 2 bad input, 3 numerical failure, 4 unreadable or unwritable files, 130 "
        "interrupted");
    program.set_version_flag(
        "--version", fmt::format("hemoflux {} ({})", HEMOFLUX_VERSION, hemoflux::exchange::backend_name()));
    program.require_subcommand(1);
    int code = static_cast<int>(hemoflux::Exit::done);
    hemoflux::apps::add_run_command(program, code);
    hemoflux::apps::add_mesh_command(program);
    hemoflux::apps::add_membrane_command(program, code);
    hemoflux::apps::add_schema_command(program);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked = program.exit(error) == 0;  // --help and --version arrive here too
        return static_cast<int>(asked ? hemoflux::Exit::done : hemoflux::Exit::bad_input);
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc > 1 &&
            std::string(argv[1]) == "render-pictures") {  // the child that draws, see output/pictures.hpp
            return hemoflux::output::render_pictures_main({argv + 2, argv + argc});
        }
        return run_program(argc, argv);
    } catch (const hemoflux::Error& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr,
                   "error: The memory is exhausted: the case does not fit. Use fewer cells or nodes.\n");
        return static_cast<int>(hemoflux::Exit::numerical);
    }
}
