#include <fmt/format.h>

#include <memory>

#include "benchmarks.hpp"
#include "membrane/batch.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::bench {
namespace {

void membrane_forces(benchmark::State& state, int nodes, int threads) {
    using namespace membrane;
    const int level = meshing::icosphere_level(nodes);
    const double r0 = red_blood_cell::radius();
    const meshing::SurfaceMesh sphere = meshing::icosphere(level, r0);
    const auto topology = std::make_shared<const Topology>(sphere);
    const double equator = reference_spheroid_equator * r0, pole = reference_spheroid_pole * r0;
    const meshing::SurfaceMesh rest = meshing::spheroid(sphere, equator, equator, pole);
    Batch batch(topology, pre_stressed_parameters(), reference_from_shape(*topology, rest.vertices));
    batch.set_positions(0, meshing::evans_fung(sphere).vertices);
    measure(state, threads, static_cast<std::size_t>(nodes), [&] { batch.compute_forces(); });
}

}  // namespace

void add_membrane_benchmarks() {
    for (const int nodes : {642, 2562})
        for (const int threads : thread_counts())
            benchmark::RegisterBenchmark(fmt::format("membrane_forces/{}/{}", nodes, threads).c_str(),
                                         membrane_forces, nodes, threads)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
}

}  // namespace hemoflux::bench
