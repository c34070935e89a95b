/// Shapes that several membrane tests start from.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "exchange/backend.hpp"
#include "membrane/batch.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::membrane::test {

/// Cells this small gain little from a second thread, and tests share the machine; the tests about threads
/// set their own number.
inline const bool one_thread = [] {
    exchange::set_threads(1);
    return true;
}();

/// Vertices of the spheroid that the discocyte takes its lengths and areas from.
inline meshing::SurfaceMesh reference_spheroid(int level) {
    return meshing::spheroid(meshing::icosphere(level, red_blood_cell::radius()),
                             meshing::oblate_axes(red_blood_cell::area, reference_reduced_volume));
}

/// An Evans-Fung disc with every vertex moved at random by up to `amplitude` mean edges: a shape without any
/// symmetry, with many concave edges.
inline std::vector<Vec3d> rough_disc(int level, double amplitude = 0.08) {
    meshing::SurfaceMesh mesh = meshing::evans_fung(meshing::icosphere(level, 1.0));
    const double reach = amplitude * meshing::quality(mesh).mean_edge;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-reach, reach);
    for (Vec3d& r : mesh.vertices) r += Vec3d{shift(random), shift(random), shift(random)};
    return mesh.vertices;
}

inline std::shared_ptr<const Topology> icosphere_topology(int level) {
    return std::make_shared<const Topology>(meshing::icosphere(level, 1.0));
}

/// A batch of rough discs under the discocyte's reference and Table 6.1.
inline Batch rough_batch(int level, std::size_t cells = 1) {
    const auto topology = icosphere_topology(level);
    Batch batch(topology, stress_free_parameters(),
                reference_from_shape(*topology, reference_spheroid(level).vertices), cells);
    for (std::size_t c = 0; c < cells; ++c)
        batch.set_positions(c, rough_disc(level, 0.08 / static_cast<double>(c + 1)));
    return batch;
}

}  // namespace hemoflux::membrane::test
