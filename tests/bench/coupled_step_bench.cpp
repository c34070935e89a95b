#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "apps/coupled_run.hpp"
#include "benchmarks.hpp"

namespace hemoflux::bench {
namespace {

/// The shipped case past its first transient, set up once: relaxing the cell takes longer than measuring.
apps::CoupledSystem& tank_treading() {
    constexpr int warm_up_steps = 50;
    static const std::unique_ptr<apps::CoupledSystem> system = [] {
        const apps::Case c = apps::read_case(std::filesystem::path(HEMOFLUX_CASES) / "tank_treading.toml");
        auto s = std::make_unique<apps::CoupledSystem>(c);
        s->add_cells(c);
        for (int step = 0; step < warm_up_steps; ++step) s->loop->step(s->numerics.step);
        return s;
    }();
    return *system;
}

void coupled_step(benchmark::State& state, int threads) {
    apps::CoupledSystem& system = tank_treading();
    measure(state, threads, system.fluid->cells(), [&] { system.loop->step(system.numerics.step); });
    system.loop->check();
}

void evaluate_in_step(benchmark::State& state, int threads) {
    apps::CoupledSystem& system = tank_treading();
    measure(state, threads, system.fluid->cells(), [&] { system.fluid->evaluate(); });
}

}  // namespace

void add_coupled_step_benchmarks() {
    for (const int threads : thread_counts()) {
        benchmark::RegisterBenchmark(fmt::format("coupled_step/{}", threads).c_str(), coupled_step, threads)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(fmt::format("evaluate_in_step/{}", threads).c_str(), evaluate_in_step,
                                     threads)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    }
}

}  // namespace hemoflux::bench
