/// Steps that follow the error of the nodes' motion.
///
/// Nodes move by dt times the NEW velocity (6.47), which is first order; the mean of the old and the new one would be
/// second order. Their difference is the displacement that a step gets wrong,
///
///   e_i = dt/2 |U_i,new - U_i,old|,    eps = max_i e_i / (R0 G dt) = max_i |U_i,new - U_i,old| / (2 R0 G)
///
/// per strain unit and over the radius R0 of the cell: a run of strain S places no node worse than by S eps R0, as far as
/// these errors neither grow nor cancel. eps is proportional to dt. It is not the error of the fluid's velocity, which the
/// AF scheme makes first order as well, nor of what a membrane at its explicit limit does.
///
/// The step becomes 0.9 dt tol/eps (at least half of it) when eps passes the tolerance; no step is taken back. It becomes
/// longer, at most twice, when one longer by a quarter is allowed. A change of the step itself changes the velocities, by what
/// penalties and their damping make of it, so the steps that follow one are waited for before the next.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// Bounds of the step, in any unit of time, and of the error per strain unit.
struct StepBounds {
    double longest = 0;   ///< what is stable
    double shortest = 0;  ///< below this the run has failed
    double first = 0;     ///< where it begins
    double tolerance = 0;
};

/// Steps after a change in which no other follows.
inline constexpr int settling_steps = 4;

/// The controller alone: plain numbers.
class StepControl {
  public:
    /// std::invalid_argument unless 0 < shortest <= first <= longest and 0 < tolerance.
    explicit StepControl(const StepBounds& bounds);

    /// The step that is wished for now; never above the longest.
    [[nodiscard]] double step() const { return step_; }
    /// Whether the error asks for less than the shortest step.
    [[nodiscard]] bool failed() const { return step_ < bounds_.shortest; }
    /// Takes note of eps in a step of the length `taken`. NaN leaves the step as it is.
    void observe(double taken, double error);
    /// Steps to come that change nothing.
    [[nodiscard]] int waiting() const { return waiting_; }
    /// For a restart.
    void restore(double step, int waiting) { step_ = step, waiting_ = waiting; }
    [[nodiscard]] const StepBounds& bounds() const { return bounds_; }

  private:
    StepBounds bounds_;
    double step_;
    int waiting_ = 0;
};

/// How much the velocities of nodes change from step to step.
class VelocityChange {
  public:
    explicit VelocityChange(std::size_t nodes);
    ~VelocityChange();

    /// Compares with the velocities of the last call (device, c) and keeps these.
    void observe(const exchange::FieldView& velocity);
    /// Whether two steps have been seen, so that there is a change.
    [[nodiscard]] bool known() const { return known_; }
    /// max |U - U_old| over the nodes; NaN if any velocity is.
    [[nodiscard]] double largest() const { return largest_; }
    /// The first node where it is.
    [[nodiscard]] std::size_t where() const;

    /// Velocities last seen, x, y and z of all nodes one after the other; empty before the first call. For a restart.
    [[nodiscard]] std::vector<double> memory() const;
    /// std::length_error for any other number of values.
    void restore(const std::vector<double>& memory);

  private:
    struct Scratch;
    std::array<exchange::Buffer<double>, 3> last_;
    exchange::Buffer<double> change_;
    std::unique_ptr<Scratch> scratch_;
    double largest_ = 0;
    bool seen_ = false, known_ = false;
};

}  // namespace hemoflux::coupling
