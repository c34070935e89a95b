// The table [[cell]]; defaults are those of the pre-stressed cell, table 6.2 of the thesis.
#include "apps/schema.hpp"

namespace hemoflux::apps {

Table cell_table() {
    const auto modulus = [](const char* unit) {
        return quantity_in(unit).within(0, 1e12, "a modulus is not negative");
    };
    return {
        "cell",
        "One red blood cell each.",
        {{"mesh",
          {choice({"icosphere"}), path()},
          "\"icosphere\"",
          "surface mesh: icosphere, or a mesh file of a sphere"},
         {"nodes",
          {integer().within(42, 655362, "a cell needs at least 42 nodes to have a shape")},
          "2562",
          "nodes of the icosphere: 42, 162, 642, 2562, 10242, 40962"},
         {"shape",
          {choice({"discocyte", "sphere", "spheroid", "evans-fung"})},
          "\"discocyte\"",
          "shape at the start; discocyte: relaxed from the Evans-Fung disc"},
         {"file", {path()}, "", "closed surface that gives both the mesh and the shape at the start"},
         {"reduced_volume",
          {number().within(1e-6, 1, "a sphere has 1, the largest")},
          "0.642",
          "reduced volume of the shape spheroid"},
         {"route",
          {choice({"evans-fung", "deflation"})},
          "\"evans-fung\"",
          "way to the discocyte: from the Evans-Fung disc, or from the spheroid by steps of the volume"},
         {"reference",
          {choice({"stress-free", "uniform", "coarse-grained", "spheroid", "file", "stored", "auto"})},
          "\"auto\"",
          "rest lengths and areas: the relaxed disc's own, one length for all springs, that of a "
          "coarse-grained "
          "spectrin network, a spheroid's, those of the shape in reference_file, those stored in file; auto: "
          "uniform, but of a file those stored there, else its own"},
         {"reference_file", {path()}, "", "closed surface with the same triangles, for reference = \"file\""},
         {"reference_reduced_volume",
          {number().within(1e-6, 1, "a sphere has 1, the largest")},
          "0.95",
          "reduced volume of the spheroid for reference = \"spheroid\""},
         {"shear_modulus", {modulus("N/m")}, "\"6.1 uN/m\"", "K_S; table 6.1 (stress-free) has 4 uN/m"},
         {"spring_length",
          {automatic(), quantity_in("um").above(0, "a length is positive")},
          "\"auto\"",
          "L_s0 for reference = \"uniform\"; auto: 1.16 mean edges of the relaxed disc on this mesh"},
         {"spring_ratio",
          {automatic(), number().above(1, "a spring must be able to grow")},
          "\"auto\"",
          "r, contour length over rest length; auto: stored, else 2.6"},
         {"volume_modulus", {modulus("Pa")}, "\"1000 N/m^2\"", "K_V"},
         {"area_modulus", {modulus("N/m")}, "\"1000 uN/m\"", "K_A, of the whole surface"},
         {"local_area_modulus", {modulus("N/m")}, "\"100 uN/m\"", "K_A,k, of each triangle"},
         {"bending_modulus", {modulus("J")}, "\"2.5e-19 J\"", "K_B"},
         {"ade_modulus", {modulus("J")}, "\"2.5e-19 J\"", "K_ADE, of the area difference"},
         {"spontaneous_curvature",
          {automatic(), number()},
          "\"auto\"",
          "c0, C_0 in units of 1/R0; auto: stored, else 6"},
         {"relaxed_area_difference",
          {automatic(), number()},
          "\"auto\"",
          "M0 in units of 8 pi R0; auto: stored, else 1"},
         {"membrane_viscosity",
          {quantity_in("Pa s m").within(0, 1, "a viscosity is not negative")},
          "\"0 Pa s m\"",
          "surface viscosity mu_PM"},
         {"area",
          {automatic(), quantity_in("um^2").above(0, "an area is positive")},
          "\"auto\"",
          "A0; auto: stored, else that of the file, else 134 um^2"},
         {"volume",
          {automatic(), quantity_in("um^3").above(0, "a volume is positive")},
          "\"auto\"",
          "V0; auto: stored, else that of the file, else 93.64 um^3 at 134 um^2 and in proportion to "
          "area^1.5"},
         {"cytosol_viscosity",
          {quantity_in("Pa s").above(0, "a viscosity is positive")},
          "\"6 mPa s\"",
          "dynamic viscosity inside"},
         {"position", {quantity_in("um").of(3)}, "[\"0 um\", \"0 um\", \"0 um\"]", "centre of the cell"},
         {"axis", {number().of(3)}, "[0, 1, 0]", "direction of the disc's axis of symmetry"}}};
}

}  // namespace hemoflux::apps
