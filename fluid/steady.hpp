/// Iterates a flow to its steady state and keeps the history of its residual.
///
///   R_rms = sqrt(sum_i R(Q_i)^2 / cells), of the rho u residual                              (4.19)
///   normalised by its value after the first iteration, until it is below 1e-5                (4.20), (4.21)
///   or: all components of R together below 1e-9 of their value after the first iteration     (3.5)
///   or: relative change of the velocity in one iteration below the tolerance                 (3.11)
///
/// An iteration is a Runge-Kutta step with local time steps, or one implicit step (see fluid/newton_krylov.hpp); the first
/// one is always a Runge-Kutta step, so that both are measured against the same value.
#pragma once

#include <functional>
#include <string>

#include "fluid/flow.hpp"
#include "fluid/newton_krylov.hpp"

namespace hemoflux::fluid {

/// How a steady state is approached.
enum class SteadyMethod { local_steps, newton };
/// What is compared with the tolerance.
enum class SteadyCriterion { momentum_x, residual, velocity_change };

/// Choices of a steady run.
struct SteadyOptions {
    SteadyMethod method = SteadyMethod::newton;
    SteadyCriterion criterion = SteadyCriterion::momentum_x;
    double tolerance = 1e-5;
    std::size_t most_iterations = 100000;
    double sigma = 2;                  ///< Courant number of local steps (2.55)
    double c = 4;                      ///< weight of the viscous radius (2.55)
    std::size_t patience = 5000;       ///< iterations with local steps without a new lowest residual: a stall
    std::size_t newton_patience = 40;  ///< implicit steps without a new lowest residual: a stall
    NewtonOptions newton;
};

/// One iteration of the history.
struct SteadyRecord {
    std::size_t iteration = 0;    ///< 1 for the first
    ResidualNorm residual;        ///< rms of every component
    double measure = 0;           ///< what is compared with the tolerance
    std::size_t evaluations = 0;  ///< residual evaluations so far
    double seconds = 0;           ///< processor seconds so far, of all threads together
    std::size_t krylov = 0;       ///< Krylov iterations of an implicit step
    double courant = 0;           ///< Courant number of the step
};

/// How a steady run ended.
enum class SteadyEnd { converged, most_iterations, stalled, interrupted };

/// What a steady run came to.
struct SteadyResult {
    SteadyEnd end = SteadyEnd::most_iterations;
    SteadyRecord last;
    double lowest = 0;      ///< lowest measure reached
    std::size_t bytes = 0;  ///< device memory of the implicit method
};

/// Called after every iteration; returns false to stop.
using SteadyObserver = std::function<bool(const SteadyRecord&)>;

/// Iterates until the criterion is met. With a constraint the method must be newton, and what is compared with the
/// tolerance is the residual of all equations together over its value at the start, whatever the criterion. Throws
/// NumericalError, naming the cell, when the flow is no longer finite or its density or speed is out of range, and
/// InputError for a tolerance that is not positive or local steps with a constraint.
SteadyResult find_steady_state(Flow& flow, const SteadyOptions& options, const SteadyObserver& observer = {},
                               Constraint* constraint = nullptr);

/// The way a run ended, in a few words.
std::string describe(SteadyEnd end);

}  // namespace hemoflux::fluid
