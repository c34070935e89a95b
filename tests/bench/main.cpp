// Benchmarks of all rooms (Google Benchmark). Medians: --benchmark_repetitions=5
// --benchmark_report_aggregates_only=true
#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "benchmarks.hpp"
#include "exchange/backend.hpp"
#include "exchange/pack.hpp"
#include "fluid_problem.hpp"

namespace hemoflux::bench {
namespace {

/// Rounding of some hundred operations per face; a wrong formula is off by far more.
constexpr double scalar_tolerance = 1e-10;

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

int run(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const double error = scalar_kernel_error();
    if (!(error <= scalar_tolerance)) {
        fmt::print(
            stderr,
            "the scalar kernel and the solver's residual differ by {:.3g}; their times cannot be compared\n",
            error);
        return 1;
    }
    benchmark::AddCustomContext("processor", processor());
    benchmark::AddCustomContext("backend", exchange::backend_name());
    benchmark::AddCustomContext("pack_lanes", std::to_string(exchange::pack_lanes));
    benchmark::AddCustomContext("scalar_kernel_error", fmt::format("{:.2g}", error));
    add_fluid_benchmarks();
    add_membrane_benchmarks();
    add_coupling_benchmarks();
#if defined(HEMOFLUX_CASES)
    add_coupled_step_benchmarks();
#endif
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}

}  // namespace

std::vector<int> thread_counts() {
    exchange::set_threads(2);
    const bool two = exchange::threads() == 2;
    exchange::set_threads(0);
    return two ? std::vector<int>{1, 2} : std::vector<int>{1};
}

void measure(benchmark::State& state, int threads, std::size_t items, const std::function<void()>& work) {
    exchange::set_threads(threads);
    for (auto _ : state) work();
    exchange::set_threads(0);
    if (items > 0)
        state.SetItemsProcessed(static_cast<std::int64_t>(items) *
                                static_cast<std::int64_t>(state.iterations()));
}

}  // namespace hemoflux::bench

int main(int argc, char** argv) { return hemoflux::bench::run(argc, argv); }
