/// Static relaxation: the nearest minimum of the energy, by L-BFGS on the forces of a batch.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "exchange/vec3.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::membrane {

/// When to stop, and how far a node may go at once.
struct RelaxOptions {
    double tolerance = 2e-5;     ///< largest force on any vertex at the minimum, 1e-11 N
    int max_iterations = 20000;  ///< L-BFGS iterations before giving up
    int history = 20;            ///< corrections that approximate the inverse Hessian
    double largest_move =
        0.25;  ///< first trial of a line search moves no vertex further, in mean rest lengths

    /// Throws InputError unless all are positive.
    void check() const;
};

/// What a relaxation did.
struct RelaxResult {
    int iterations = 0;        ///< of L-BFGS
    int evaluations = 0;       ///< of the forces
    double largest_force = 0;  ///< on any vertex, loads included, 1e-11 N
    double energy = 0;         ///< of the membrane, without the loads' potential, 1e-17 J
};

/// A triangle whose normal points against the sum of its neighbours' normals, where the surface is folded over;
/// the number of triangles when there is none.
std::size_t folded_triangle(const Topology& topology, const std::vector<Vec3d>& positions);

/// Moves the vertices of a batch of one cell to the nearest minimum of E - sum load.r, where `load` is a
/// constant force on each vertex (1e-11 N; empty: none) that should sum to zero. Steps in which a spring
/// would reach its contour length are rejected. Throws InputError when the batch holds several cells or load
/// has the wrong size, and NumericalError when it starts beyond the contour length, does not converge (it
/// names the spring near its contour length or the folded triangle that is to blame) or ends folded over.
RelaxResult relax(Batch& batch, const RelaxOptions& options = {}, const std::vector<Vec3d>& load = {});

/// An energy besides the membrane's: returns its value at r (x of all vertices, then y, then z; um) and adds its
/// gradient to `gradient`. 1e-17 J and 1e-11 N.
using Potential = std::function<double(std::span<const double> r, std::span<double> gradient)>;

/// -sum load.r of a constant force on each vertex (1e-11 N); an empty function for no load.
Potential dead_load(const std::vector<Vec3d>& load);

/// As relax(), with any potential added to the energy; an empty function adds none.
RelaxResult minimise(Batch& batch, const RelaxOptions& options, const Potential& potential);

/// Steps in which the reference volume goes from a sphere's or spheroid's to a discocyte's. Never one: the
/// cell would buckle into a cup.
inline constexpr int deflation_steps = 12;

/// Relaxes the batch's one cell under references whose V_0, C_0 and M_0 go in equal steps from the cell's
/// present volume and the batch's present C_0 and M_0 to those of `target`; all else is the target's from the
/// first step on. All steps but the last converge to 100 times the tolerance. The batch's reference is the
/// target afterwards. Iterations and evaluations are summed. Errors as relax(); InputError unless steps >= 1.
RelaxResult approach(Batch& batch, const Reference& target, const RelaxOptions& options = {},
                     int steps = deflation_steps);

/// approach() to the batch's present reference with `volume` (um^3) as V_0.
RelaxResult deflate(Batch& batch, double volume, const RelaxOptions& options = {},
                    int steps = deflation_steps);

}  // namespace hemoflux::membrane
