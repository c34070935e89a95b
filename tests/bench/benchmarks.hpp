/// The groups of benchmarks, each registered by one function, and what they share.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace hemoflux::bench {

/// Thread counts to measure: 1, and 2 where the backend has them.
std::vector<int> thread_counts();

/// Runs `work` under the wall clock on `threads` threads; reports `items` per call as items_per_second unless
/// 0.
void measure(benchmark::State& state, int threads, std::size_t items, const std::function<void()>& work);

/// residual/<n>/<features>/<threads>, residual_single/<n>/<threads>, residual_unstructured/<n>/<threads>,
/// residual_by_cell/<n>/<features>, residual_scalar/<n>/plain, ghost_fill/<n>/<threads>, factored_solve/<n>/<threads>.
/// Items are cells.
void add_fluid_benchmarks();
/// membrane_forces/<nodes>/<threads>, membrane_batch/2562/<threads>/cells:<n>, membrane_law/2562/1/<law or bending
/// scheme>. Items are nodes.
void add_membrane_benchmarks();
/// stencil, spread and interpolate of 2562 nodes on the tank-treading grid, by kernel, and
/// viscosity_recompute, viscosity_check.
void add_coupling_benchmarks();
/// coupled_step/<threads> of apps/cases/tank_treading.toml, and evaluate_in_step, its fluid's ghost fill and
/// residual alone.
void add_coupled_step_benchmarks();

}  // namespace hemoflux::bench
