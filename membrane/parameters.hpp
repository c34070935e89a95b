/// Moduli of the membrane in the internal units: length 1 um, force 1e-11 N, time 1e-5 s; hence tension
/// 1e-5 N/m, pressure 10 N/m^2, energy 1e-17 J, surface viscosity 1e-10 Pa s m.
#pragma once

#include <cmath>
#include <string>

#include "exchange/error.hpp"

namespace hemoflux::membrane {

inline constexpr double piconewton = 0.1;         ///< 1 pN in the internal unit of force
inline constexpr double attojoule_per_unit = 10;  ///< the internal unit of energy in aJ

namespace detail {
/// Throws InputError unless value >= 0 (NaN is refused too).
inline void not_negative(const char* name, double value) {
    if (!(value >= 0) || std::isinf(value))
        throw InputError(std::string(name) + " = " + std::to_string(value),
                         "a modulus must be a finite number that is not negative", "Correct its value");
}
}  // namespace detail

/// Penalties that hold volume and area, (6.3) and (6.14).
struct ConstraintModuli {
    double volume = 100;     ///< K_V, 10 N/m^2
    double area = 100;       ///< K_A, global, 1e-5 N/m
    double local_area = 10;  ///< K_A,k, of each triangle, 1e-5 N/m

    /// Throws InputError when a modulus is negative or not finite.
    void check() const {
        detail::not_negative("volume modulus", volume);
        detail::not_negative("area modulus", area);
        detail::not_negative("local area modulus", local_area);
    }
};

/// How the mean curvature of the triangulated surface is taken; both tend to the same energy.
enum class BendingScheme {
    juelicher,      ///< edge angles summed over a node's ring, (6.22), Juelicher 1996; bending.hpp
    gompper_kroll,  ///< cotangent Laplacian over Voronoi areas, Gompper and Kroll 1996; gompper_kroll.hpp
};

/// Bending resistance, (6.20).
struct BendingModuli {
    double local = 0.025;            ///< K_B, Helfrich, 1e-17 J
    double area_difference = 0.025;  ///< K_B,ADE, 1e-17 J
    BendingScheme scheme = BendingScheme::juelicher;

    /// Throws InputError when a modulus is negative or not finite.
    void check() const {
        detail::not_negative("bending modulus", local);
        detail::not_negative("area difference modulus", area_difference);
    }
};

/// How the membrane resists in-plane deformation. The shear modulus K_S is the input of every law; its
/// coefficients follow from it at each spring's or triangle's own rest state, so that no result depends on the
/// mesh. Of a flat sheet (sheet.hpp measures it), with K the area modulus of the law without K_A,k:
enum class InPlaneLaw {
    wlc,              ///< shifted worm-like chain (6.30), wlc.hpp; K = 2 K_S
    wlc_power,        ///< worm-like chain against a power law, Fedosov et al. 2010, wlc.hpp; K = 2 K_S
    wlc_hydrostatic,  ///< worm-like chain against the triangles' area, Dao et al. 2006, wlc.hpp; K = 2 K_S
    neo_hookean,      ///< continuum, strain_energy.hpp; K = 3 K_S
    skalak,           ///< continuum, strain_energy.hpp; K = (1 + 2 C) K_S
};

/// In-plane resistance, (6.38), and the surface viscosity of (6.41).
struct NetworkModuli {
    double shear = 0.4;       ///< K_S, 1e-5 N/m
    double viscosity = 7000;  ///< mu_PM, 1e-10 Pa s m; acts in motion only, never in statics
    InPlaneLaw law = InPlaneLaw::wlc;
    double skalak_ratio = 1;  ///< C of InPlaneLaw::skalak; its area modulus is (1 + 2 C) K_S

    /// Throws InputError when a modulus is negative or not finite.
    void check() const {
        detail::not_negative("shear modulus", shear);
        detail::not_negative("Skalak ratio", skalak_ratio);
        detail::not_negative("membrane viscosity", viscosity);
    }
};

/// All moduli of one kind of cell.
struct Parameters {
    ConstraintModuli constraint;
    BendingModuli bending;
    NetworkModuli network;

    /// Throws InputError when a modulus is negative or not finite.
    void check() const {
        constraint.check();
        bending.check();
        network.check();
    }
};

/// Table 6.1: the stress-free cell, K_S = 4e-6 N/m. (The table's N/m^2 of the area moduli are uN/m.)
inline Parameters stress_free_parameters() { return {}; }

/// Table 6.2: the pre-stressed cell, K_S = 6.1e-6 N/m, all else as Table 6.1.
inline Parameters pre_stressed_parameters() {
    Parameters p;
    p.network.shear = 0.61;
    return p;
}

/// Rest state of a healthy red blood cell, Tables 6.1 and 6.2.
namespace red_blood_cell {
inline constexpr double area = 134;             ///< A_0, um^2
inline constexpr double volume = 93.64;         ///< V_0, um^3
inline constexpr double stretch_ratio = 2.6;    ///< r = L_c / L_0 of a spring
inline constexpr double reduced_curvature = 6;  ///< c_0 = C_0 R_0
inline constexpr double pi = 3.14159265358979323846;
/// R_0 = sqrt(A_0 / 4 pi), um (6.43).
inline double radius() { return std::sqrt(area / (4 * pi)); }
}  // namespace red_blood_cell

}  // namespace hemoflux::membrane
