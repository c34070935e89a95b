/// A case: everything a run needs to know, as plain numbers in the units named here.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/case_cell.hpp"
#include "apps/case_observables.hpp"
#include "apps/case_rigid.hpp"
#include "apps/case_watchdog.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::apps {

/// kind: cells in a flow, the flow alone, or cells alone.
enum class CaseKind { coupled, fluid, membrane };
/// fluid.initial; "auto" is resolved.
enum class InitialFlow { rest, shear, analytical, channel, uniform, inflow };
/// grid.kind of one axis; given: "explicit".
enum class AxisKind { uniform, plateau, chebyshev, given };
/// velocity of one side, in the order of the words in the schema; vector: the same everywhere on it.
enum class VelocityCondition {
    periodic,
    shear,
    no_slip,
    zero_gradient,
    symmetry,
    parabolic,
    expression,
    vector
};
/// density of one side: a word, a number (density), or a quantity (pressure).
enum class DensityCondition { zero_gradient, gradient, expression, density, pressure };
/// coupling.kernel.
enum class Kernel { lagrange, phi2, phi3, phi4 };
/// coupling.membrane_viscosity.
enum class MembraneViscosityForm { springs, fluid };
/// time.scheme.
enum class TimeScheme { euler, rk4, factored };
/// steady.method.
enum class SteadyMethod { implicit, local_steps };
/// steady.criterion.
enum class SteadyCriterion { momentum, residual, velocity_change };
/// numerics.gradient.
enum class Gradient { least_squares, green_gauss, hybrid };
/// analytical.solution.
enum class ExactSolution { couette, poiseuille, taylor_green, womersley };

/// [fluid]
struct FluidInput {
    double density = 0;    ///< kg/m^3
    double viscosity = 0;  ///< Pa s
    InitialFlow initial = InitialFlow::rest;
    Triple initial_velocity{};  ///< um/s, of InitialFlow::uniform
    bool operator==(const FluidInput&) const = default;
};

/// [grid]; lengths in um.
struct GridInput {
    std::array<AxisKind, 3> kind{};
    Triple length{};
    std::array<int, 3> cells{};
    Triple lower{};  ///< lower corner of the box
    double plateau_a = 0, plateau_b = 0;
    std::array<std::vector<double>, 3> faces;  ///< of explicit axes
    bool operator==(const GridInput&) const = default;
};

/// grid.mesh; numbers that are not given are the generator's own.
struct MeshInput {
    std::string kind, file;
    double unit = 1;                       ///< um per unit of length of the file
    double size = 0;                       ///< um
    std::map<std::string, double> values;  ///< the other keys
    bool operator==(const MeshInput&) const = default;
};

/// One side of the box, or one patch of a mesh.
struct PatchInput {
    VelocityCondition velocity = VelocityCondition::periodic;
    Triple vector{};  ///< um/s, for VelocityCondition::vector
    DensityCondition density = DensityCondition::zero_gradient;
    double value =
        0;  ///< density relative to the reference density, pressure above the reference in Pa, or its
            ///< gradient along the inward normal in Pa/m
    double speed = 0;                                ///< of VelocityCondition::parabolic, into the box, um/s
    std::array<std::string, 3> velocity_expression;  ///< m/s
    std::string pressure_expression;                 ///< Pa
    std::string partner;                             ///< of a mesh: the periodic patch opposite
    [[nodiscard]] bool periodic() const { return velocity == VelocityCondition::periodic; }
    bool operator==(const PatchInput&) const = default;
};

/// [coupling]
struct CouplingInput {
    Kernel kernel = Kernel::lagrange;
    bool recentre = false;
    double smoothing = 1;  ///< half-width of the viscosity step in local cells
    MembraneViscosityForm membrane_viscosity = MembraneViscosityForm::springs;
    bool operator==(const CouplingInput&) const = default;
};

/// [contact]
struct ContactInput {
    double pressure = 0;                      ///< Pa
    std::optional<double> range;              ///< um; empty: chosen
    double adhesion = 0;                      ///< J/m^2
    std::optional<double> adhesion_distance;  ///< um; empty: range
    double adhesion_scale = 0;                ///< 1/um
    bool walls = true;
    bool operator==(const ContactInput&) const = default;
};

/// [packing]
struct PackingInput {
    double haematocrit = 0;
    int seed = 1;
    double gap = 0;  ///< um
    bool operator==(const PackingInput&) const = default;
};

/// [time]; exactly one of strain and duration is given.
struct TimeInput {
    TimeScheme scheme = TimeScheme::factored;
    std::optional<double> strain;
    std::optional<double> duration;  ///< s
    std::optional<double> step;      ///< s; empty: numerics.step_strain, or chosen
    std::optional<double> steady;    ///< change of the velocity below which a run ends
    bool adaptive = false;           ///< kind coupled: steps that follow the error
    std::optional<double>
        tolerance;  ///< of adaptive steps: position error per strain unit over R0; empty: chosen
    bool operator==(const TimeInput&) const = default;
};

/// [numerics]; empty optionals are chosen by the program.
struct NumericsInput {
    std::optional<double> lattice_viscosity;  ///< nu/h, kind coupled
    std::optional<double> reynolds;           ///< Re_G, kind coupled
    std::optional<double> mach;
    std::optional<double> speed;  ///< that mach refers to, um/s, kind fluid
    std::optional<double> step_strain;
    std::optional<double> gamma = 1;  ///< empty: chosen
    double tau_floor = 0.05;
    bool single_precision = false;  ///< of the residual
    Gradient gradient = Gradient::least_squares;
    bool operator==(const NumericsInput&) const = default;
};

/// [body_force]
struct BodyForceInput {
    Triple acceleration{};  ///< m/s^2
    Triple amplitude{};     ///< N/m^3
    double period = 0;      ///< s; 0: nothing oscillates
    double phase = 0;       ///< degrees
    bool operator==(const BodyForceInput&) const = default;
};

/// [steady]
struct SteadyInput {
    SteadyMethod method = SteadyMethod::implicit;
    SteadyCriterion criterion = SteadyCriterion::momentum;
    double tolerance = 1e-5;
    int iterations = 0;
    double sigma = 1, viscous_weight = 4;
    std::string start;  ///< folder; "": from fluid.initial
    bool operator==(const SteadyInput&) const = default;
};

/// [analytical]
struct AnalyticalInput {
    ExactSolution solution = ExactSolution::couette;
    double speed = 0;           ///< um/s
    std::vector<double> times;  ///< in decay times or periods
    bool operator==(const AnalyticalInput&) const = default;
};

/// [[sweep.measured]]: points to show beside the computed ones.
struct MeasuredInput {
    std::string file, x, y, label;  ///< CSV file and its columns; x in the unit of the first swept value
    bool operator==(const MeasuredInput&) const = default;
};

/// [sweep]: values as TOML text, [key][value].
struct SweepInput {
    std::vector<std::string> keys;
    std::vector<std::vector<std::string>> values;
    bool product = false;
    std::vector<std::string> observables, order, extrapolate;
    std::optional<std::array<double, 2>> order_range;
    bool difference = false;
    bool log_x = true, log_y = true;
    std::vector<MeasuredInput> measured;
    bool operator==(const SweepInput&) const = default;
};

/// [output]
struct OutputInput {
    double interval_strain = 0.5;
    std::optional<double> interval;  ///< s
    double history_interval_strain = 0.05;
    std::optional<double> history_interval;     ///< s
    double checkpoint_interval_strain = 5;      ///< 0: none
    std::optional<double> checkpoint_interval;  ///< s
    int compression = 1;                        ///< zlib level, 0: none
    std::vector<std::string> fields;            ///< as the schema lists them
    bool pictures = true;
    std::optional<std::array<double, 2>> window_strain;  ///< empty: the last 60 % of the run
    bool operator==(const OutputInput&) const = default;
};

/// [[reference]]: low and high are infinite where only one is given.
struct ReferenceInput {
    std::string observable;
    std::optional<double> low, high, value;
    std::string source;
    bool operator==(const ReferenceInput&) const = default;
};

/// Whether a reference is of a sweep (a limit or an order of convergence, which one run does not have).
inline bool of_sweep(const ReferenceInput& reference) {
    return reference.observable.starts_with("order_") || reference.observable.starts_with("limit_");
}

/// A whole case. `resolved` is its TOML text with every default filled in; reading that gives an equal case.
struct Case {
    std::string title;
    CaseKind kind = CaseKind::coupled;
    FluidInput fluid;
    GridInput grid;
    std::array<std::array<PatchInput, 2>, 3> boundary{};  ///< [axis][lower, upper]
    std::optional<MeshInput> mesh;                        ///< in place of `grid` and `boundary`
    std::map<std::string, PatchInput> patches;            ///< of the mesh
    std::optional<SteadyInput> steady;
    std::optional<double> shear_rate;  ///< 1/s
    BodyForceInput body_force;
    std::optional<AnalyticalInput> analytical;
    std::optional<SweepInput> sweep;  ///< not part of `resolved`: a run is one point
    std::vector<CellInput> cells;
    std::vector<RigidInput> bodies;
    CouplingInput coupling;
    std::optional<ContactInput> contact;
    std::optional<PackingInput> packing;  ///< `cells` then holds as many alike as fit, not placed yet
    std::optional<TweezersInput> tweezers;
    TimeInput time;
    NumericsInput numerics;
    MembraneInput membrane;
    OutputInput output;
    WatchdogInput watchdog;
    std::optional<ObservablesInput> observables;
    std::vector<ProfileInput> profiles;
    std::vector<ReferenceInput> references;
    std::string resolved;
    bool operator==(const Case&) const = default;

    /// Whether the axis (0, 1, 2) is periodic.
    [[nodiscard]] bool periodic(std::size_t axis) const { return boundary[axis][0].periodic(); }
};

/// Reads a case file, applies the overrides ("table.key=value", in order), checks every key and the keys
/// against each other. Throws FileError (unreadable) or InputError. check_case() looks at the geometry.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from TOML text; relative paths are seen from `folder`, messages call the text `name`.
Case parse_case(const std::string& text, const std::string& name = "case",
                const std::filesystem::path& folder = std::filesystem::current_path(),
                const std::vector<std::string>& overrides = {});

/// The grid of a case. Throws InputError.
meshing::RectilinearGrid make_grid(const GridInput& grid);

}  // namespace hemoflux::apps
