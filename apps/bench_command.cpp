#include <fmt/format.h>

#include <memory>

#include "apps/commands.hpp"
#include "apps/output/atomic_file.hpp"
#include "apps/speed.hpp"
#include "apps/speed_cells.hpp"
#include "exchange/backend.hpp"

namespace hemoflux::apps {
namespace {

struct BenchArguments {
    std::vector<int> sizes{40, 100};
    int threads = 1;
    bool quick = false;
    std::string json;
};

constexpr int thesis_edge = 100, quick_edge = 40;

void bench(const BenchArguments& in) {
    exchange::set_threads(in.threads);
    const Machine machine = this_machine();
    fmt::print("{}\n", describe(machine));
    const std::vector<Timing> timings =
        time_kernels(in.quick ? std::vector<int>{quick_edge} : in.sizes, in.quick);
    fmt::print("{}", table(machine, timings));
    if (!in.json.empty()) {
        output::write_file(in.json, to_json(machine, timings));
        fmt::print("written    {}\n", in.json);
    }
}

void bench_thesis(const BenchArguments& in) {
    exchange::set_threads(in.threads);
    const Machine machine = this_machine();
    const int n = in.quick ? quick_edge : thesis_edge;
    fmt::print("{}\n{}\n", describe(machine),
               table_8_4(machine, structured_cavity(n, in.quick), unstructured_cavity(n, in.quick)));
    const CellSpeed cells = time_cells(in.quick);
    fmt::print("{}\n{}\n", table_8_5_and_8_6(machine, cells), table_7_1(machine, cells));
    fmt::print("{}", table_3_18(machine, steady_cavities(in.quick)));
}

}  // namespace

void add_bench_command(CLI::App& program) {
    const auto in = std::make_shared<BenchArguments>();
    CLI::App* command = program.add_subcommand("bench", "Measure how fast this machine computes");
    command->footer("Example: hemoflux bench --threads 1 --json speed.json");
    command->option_defaults()->always_capture_default();
    command->add_option("--cells", in->sizes, "Cells along each edge of the cubes to measure")
        ->check(CLI::Range(8, 400));
    command->add_option("--json", in->json, "File to write the numbers to");
    const auto shared = [&](CLI::App* c) {
        c->add_option("--threads", in->threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
        c->add_flag("--quick", in->quick, "Short samples on small grids: that it runs, not how fast");
    };
    shared(command);
    CLI::App* thesis = command->add_subcommand("thesis", "The timing tables of the thesis, ours beside them");
    thesis->footer("Example: hemoflux bench thesis --threads 0");
    thesis->option_defaults()->always_capture_default();
    shared(thesis);
    thesis->callback([in] { bench_thesis(*in); });
    command->callback([in, command] {
        if (command->get_subcommands().empty()) bench(*in);
    });
}

}  // namespace hemoflux::apps
