#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "benchmarks.hpp"
#include "membrane/batch.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::bench {
namespace {

void membrane_forces(benchmark::State& state, int nodes, int threads, std::size_t cells,
                     const membrane::Parameters& parameters) {
    using namespace membrane;
    const int level = meshing::icosphere_level(nodes);
    const meshing::SurfaceMesh sphere = meshing::icosphere(level, red_blood_cell::radius());
    const auto topology = std::make_shared<const Topology>(sphere);
    const meshing::SurfaceMesh rest =
        meshing::spheroid(sphere, meshing::oblate_axes(red_blood_cell::area, reference_reduced_volume));
    Batch batch(topology, parameters, reference_from_shape(*topology, rest.vertices), cells);
    const auto disc = meshing::evans_fung(sphere).vertices;
    for (std::size_t c = 0; c < cells; ++c) batch.set_positions(c, disc);
    measure(state, threads, cells * static_cast<std::size_t>(nodes), [&] { batch.compute_forces(); });
}

}  // namespace

void add_membrane_benchmarks() {
    using membrane::BendingScheme, membrane::InPlaneLaw, membrane::Parameters;
    const auto add = [](const std::string& name, int nodes, int threads, std::size_t cells,
                        const Parameters& parameters) {
        benchmark::RegisterBenchmark(name.c_str(), membrane_forces, nodes, threads, cells, parameters)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    };
    const Parameters usual = membrane::pre_stressed_parameters();
    for (const int nodes : {642, 2562})
        for (const int threads : thread_counts())
            add(fmt::format("membrane_forces/{}/{}", nodes, threads), nodes, threads, 1, usual);
    for (const std::size_t cells : {10U, 100U})
        for (const int threads : thread_counts())
            add(fmt::format("membrane_batch/2562/{}/cells:{}", threads, cells), 2562, threads, cells, usual);
    const std::pair<const char*, InPlaneLaw> laws[] = {{"wlc_power", InPlaneLaw::wlc_power},
                                                       {"wlc_hydrostatic", InPlaneLaw::wlc_hydrostatic},
                                                       {"neo_hookean", InPlaneLaw::neo_hookean},
                                                       {"skalak", InPlaneLaw::skalak}};
    for (const auto& [name, law] : laws) {
        Parameters parameters = usual;
        parameters.network.law = law;
        add(fmt::format("membrane_law/2562/1/{}", name), 2562, 1, 1, parameters);
    }
    Parameters laplacian = usual;
    laplacian.bending.scheme = BendingScheme::gompper_kroll;
    add("membrane_law/2562/1/gompper_kroll", 2562, 1, 1, laplacian);
}

}  // namespace hemoflux::bench
