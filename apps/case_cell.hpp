/// What a case says of its cells: [[cell]], [tweezers] and [membrane].
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "membrane/shapes.hpp"
#include "membrane/stretch.hpp"

namespace hemoflux::apps {

/// Components along x, y, z.
using Triple = std::array<double, 3>;

/// cell.shape; file: the surface that cell.file names.
enum class CellShape { discocyte, sphere, spheroid, evans_fung, file };
/// cell.reference; automatic: "auto", resolved when the cell is built, because a file may hold its references.
enum class MembraneReference { stress_free, uniform, coarse_grained, spheroid, file, stored, automatic };
/// membrane.task.
enum class MembraneTask { relax, stretch, shapes, moduli, recovery, calibrate };

/// [[cell]]; lengths um, tensions N/m, energies J.
struct CellInput {
    std::string name;  ///< what tables and pictures call it; "": its number
    std::string mesh;  ///< "icosphere" or the path of a sphere mesh; unused when shape is file
    int nodes = 0;     ///< of the icosphere
    CellShape shape = CellShape::discocyte;
    std::string file;                                     ///< surface for CellShape::file
    double reduced_volume = 0;                            ///< of CellShape::spheroid
    membrane::Route route = membrane::Route::evans_fung;  ///< of CellShape::discocyte
    MembraneReference reference = MembraneReference::automatic;
    std::string reference_file;
    double reference_reduced_volume = 0;
    double camber = 0;  ///< um, of the start of a discocyte
    membrane::InPlaneLaw law = membrane::InPlaneLaw::wlc;
    double skalak_ratio = 1;  ///< C of the Skalak law
    membrane::BendingScheme bending_scheme = membrane::BendingScheme::juelicher;
    double shear_modulus = 0;                       ///< K_S, N/m
    std::optional<double> spring_length;            ///< L_s0, um; empty: 1.16 mean edges of the relaxed disc
    std::optional<double> spring_ratio;             ///< r
    double volume_modulus = 0;                      ///< K_V, Pa
    double area_modulus = 0;                        ///< K_A, N/m
    double local_area_modulus = 0;                  ///< K_A,k, N/m
    double bending_modulus = 0;                     ///< K_B, J
    double ade_modulus = 0;                         ///< K_ADE, J
    std::optional<double> spontaneous_curvature;    ///< c0 = C_0 R0; empty as the next ones: see rest_state()
    std::optional<double> relaxed_area_difference;  ///< M0 / (8 pi R0)
    double membrane_viscosity = 0;                  ///< Pa s m
    std::optional<double> area;                     ///< A0, um^2
    std::optional<double> volume;                   ///< V0, um^3
    double cytosol_viscosity = 0;                   ///< Pa s
    Triple position{};                              ///< um
    Triple axis{};                                  ///< unit vector
    bool operator==(const CellInput&) const = default;
};

/// [tweezers]: a cell pulled at both ends along x.
struct TweezersInput {
    double force = 0;  ///< pN
    membrane::Grip grip;
    double tolerance = 0;  ///< um/s; the run ends when both diameters change more slowly
    bool operator==(const TweezersInput&) const = default;
};

/// [membrane]: a cell alone.
struct MembraneInput {
    MembraneTask task = MembraneTask::relax;
    std::vector<double> forces;         ///< pN
    membrane::Grip grip;                ///< what each bead holds
    bool dynamic = false;               ///< stretch in overdamped motion in place of the static solver
    double fluid_viscosity = 0;         ///< Pa s, of the surrounding fluid's drag in overdamped motion
    double duration = 0;                ///< s, of overdamped motion
    std::string experiment;             ///< CSV file to compare with, columns F_pN, DA_um, DT_um; "": none
    std::vector<std::string> recovery;  ///< CSV files to compare with, columns t (s) and L_W
    /// c0, and M0 in units of 8 pi R0, whose combinations the task shapes goes through; empty: the cell's own.
    std::vector<double> curvatures, area_differences;
    bool refine = false;                       ///< repeat each shape with four times as many nodes
    std::array<double, 2> shear_bounds{};      ///< N/m, between which the task calibrate seeks K_S
    std::array<double, 2> curvature_bounds{};  ///< and c0
    double tolerance = 2e-4;                   ///< pN
    bool operator==(const MembraneInput&) const = default;
};

}  // namespace hemoflux::apps
