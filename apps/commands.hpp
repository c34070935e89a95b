/// The subcommands of the program; each adds itself to the command line and does its work when chosen. Errors
/// leave as hemoflux::Error.
#pragma once

#include <CLI/CLI.hpp>

namespace hemoflux::apps {

/// `hemoflux run CASE.toml`. The callback stores the exit code of the run in `code`.
void add_run_command(CLI::App& program, int& code);
/// `hemoflux sweep CASE.toml`.
void add_sweep_command(CLI::App& program, int& code);
/// `hemoflux mesh grid|rbc|hex`.
void add_mesh_command(CLI::App& program);
/// `hemoflux mesh hex cube|cylinder|pipe|constriction|box|check`, part of `mesh`.
void add_mesh_hex_command(CLI::App& mesh);
/// `hemoflux membrane relax|stretch|shapes|moduli|relax-back|calibrate`.
void add_membrane_command(CLI::App& program, int& code);
/// `hemoflux bench` and `hemoflux bench thesis`.
void add_bench_command(CLI::App& program);
/// `hemoflux schema`.
void add_schema_command(CLI::App& program);

}  // namespace hemoflux::apps
