/// Which of the motions of section 7.4 a cell in shear flow performs, from its histories alone.
///
/// Two angles tell: alpha, that of the cell's longest axis to the flow (the inclination, known up to half turns), and
/// phi = alpha - theta, how far the membrane has gone round as seen from that axis, theta being how far it has turned in
/// space (membrane::membrane_turn). One keeps turning when it gains half a turn or more.
///
///   | motion        | alpha                               | phi           |
///   | tumbling      | keeps turning                       | swings        |
///   | tank treading | stays within swinging_threshold_deg | keeps turning |
///   | swinging      | oscillates by more                  | keeps turning |
///   | intermittent  | keeps turning                       | keeps turning |
///   | steady        | neither turns                       |               |
#pragma once

#include <vector>

namespace hemoflux::coupling {

/// The motions of the table above.
enum class MotionMode { steady, tumbling, intermittent, swinging, tank_treading };

/// "steady", "tumbling", "intermittent", "swinging", "tank treading".
const char* name_of(MotionMode mode);

/// Amplitude (half of peak to peak) of the inclination above which a tank-treading cell is said to swing.
inline constexpr double swinging_threshold_deg = 2;

/// Records of one cell in order of strain, close enough that no angle changes by a quarter turn between two.
struct MotionHistory {
    std::vector<double> strain;
    std::vector<double> inclination_deg;  ///< in (-90, 90], or unwrapped
    std::vector<double> material_deg;     ///< theta, how far the membrane has turned, unwrapped or not

    /// The records with strain in [from, to].
    [[nodiscard]] MotionHistory window(double from, double to) const;
};

/// Periods in strain units, NaN where there is none.
struct CellMotion {
    MotionMode mode = MotionMode::steady;
    int flips = 0;                    ///< half turns that alpha has gained, either way
    int treads = 0;                   ///< half turns that phi has gained
    double tumbling_period = 0;       ///< of a full turn of alpha
    double tank_treading_period = 0;  ///< of a full turn of phi
    double swing_period = 0;          ///< between two upward passages of the mean inclination
    double inclination_deg = 0;       ///< mean; NaN when alpha keeps turning
    double amplitude_deg = 0;  ///< half of peak to peak, the mean over the half turns of phi; NaN likewise

    /// Of the motion: a full turn of the cell when it tumbles, else of its membrane.
    [[nodiscard]] double period() const {
        return mode == MotionMode::tumbling ? tumbling_period : tank_treading_period;
    }
};

/// Classifies a history. std::length_error when its columns differ in length; fewer than two records are steady.
CellMotion classify(const MotionHistory& history);

}  // namespace hemoflux::coupling
