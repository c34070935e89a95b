#include "apps/report/command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "apps/output/atomic_file.hpp"
#include "apps/report/page.hpp"

namespace hemoflux::report {
namespace {

struct Arguments {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path output;
};

void write_report(const Arguments& in) {
    const std::filesystem::path file = in.output.empty() ? in.folders.front() / "report.html" : in.output;
    const std::string page = build_page(read_runs(in.folders));
    output::write_file(file, page);
    fmt::print("written {} ({:.1f} MB)\n", file.string(), static_cast<double>(page.size()) * 1e-6);
}

}  // namespace

void add_report_command(CLI::App& program) {
    const auto in = std::make_shared<Arguments>();
    CLI::App* command = program.add_subcommand(
        "report", "Make one HTML page of the results of a run, or of several side by side");
    command->add_option("DIR", in->folders, "Output folders of runs or sweeps")->required();
    command->add_option("--output,-o", in->output, "File to write [report.html in the first folder]");
    command->footer(
        "The page needs no other file and no network.\n"
        "Examples: hemoflux report results/tank_treading_quick\n"
        "          hemoflux report results/coarse results/fine --output comparison.html");
    command->callback([in] { write_report(*in); });
}

}  // namespace hemoflux::report
