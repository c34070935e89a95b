/// A cell in tweezers in the course of time: pulled until it rests, and let go (Hochmuth, Worthy, Evans 1979).
///
/// Ratio w = D_A / D_T of length to width. Hochmuth's fit of the recovery,
///   (w - w_inf)(w_0 + w_inf) / [(w + w_inf)(w_0 - w_inf)] = exp(-t/t_c),
/// measures t_c, which is mu_PM / K_S for a flat membrane without fluid.
#pragma once

#include <vector>

#include "membrane/dynamics.hpp"
#include "membrane/stretch.hpp"

namespace hemoflux::membrane {

/// The cell at one time.
struct RecoveryPoint {
    double time_s = 0;
    double axial_um = 0, transverse_um = 0;
};

/// Pulls the batch's one cell with a force (pN) on the vertices of `pulled` from its present shape until D_A
/// changes by less than `rest` (um) in a step or the steps are used up; the first point is the present shape.
/// Errors as evolve().
std::vector<RecoveryPoint> pull_in_time(Batch& batch, const PulledVertices& pulled, double force_pN,
                                        const DynamicsOptions& options, double rest = 1e-4);

/// Lets the batch's one cell go from its present shape, and follows it for all steps of the options; the first
/// point is the present shape. Errors as evolve().
std::vector<RecoveryPoint> relax_back(Batch& batch, const DynamicsOptions& options);

/// t_c, s, by least squares through the origin over the points whose left-hand side lies between 0.1 and 1,
/// w_0 that of the first point and w_inf = `rest_ratio`. InputError when there are fewer than two of them.
double recovery_time(const std::vector<RecoveryPoint>& points, double rest_ratio);

}  // namespace hemoflux::membrane
