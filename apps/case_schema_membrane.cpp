// The tables [membrane] and [tweezers].
#include "apps/schema.hpp"

namespace hemoflux::apps {
namespace {

Key contact_key() {
    return {"contact",
            {number().within(1e-6, 0.5, "each end holds a part of the nodes"),
             quantity_in("um").above(0, "a bead touches the cell")},
            "0.02",
            "part of the nodes that each bead holds, or the diameter of its contact"};
}

}  // namespace

Table tweezers_table() {
    return {
        "tweezers",
        "Pulls the first cell apart along x from the start, in the fluid.",
        {{"force", {quantity_in("pN").within(0, 1e6, "the ends are pulled apart")}, "", "on each end", true},
         contact_key(),
         {"tolerance",
          {quantity_in("um/s").above(0, "a tolerance is positive")},
          "\"0.1 um/s\"",
          "the run ends when both diameters change more slowly than this over two strain units"}}};
}

Table membrane_table() {
    const Form not_negative = number().within(-1e6, 1e6, "no such cell").of(Form::any);
    return {
        "membrane",
        "What to do with cells alone.",
        {{"task",
          {choice({"relax", "stretch", "shapes", "moduli", "relax-back", "calibrate"})},
          "\"relax\"",
          "relax at rest; stretch by optical tweezers; relax over c0 and M0; measure the moduli of a flat "
          "sheet; release a stretched cell; fit K_S and c0 to stretch measurements"},
         {"forces",
          {quantity_in("pN").within(0, 1e6, "the ends are pulled apart").of(Form::any)},
          "[\"0 pN\", \"50 pN\", \"100 pN\", \"150 pN\"]",
          "pulling forces, in this order; relax-back starts from the last"},
         contact_key(),
         {"solver",
          {choice({"static", "dynamic"})},
          "\"static\"",
          "stretch: minimum of the energy at each force, or overdamped motion until it rests"},
         {"fluid_viscosity",
          {quantity_in("Pa s").above(0, "a viscosity is positive")},
          "\"1 mPa s\"",
          "of the surrounding fluid, which drags the nodes in overdamped motion"},
         {"duration",
          {quantity_in("s").above(0, "a motion has a length")},
          "\"0.5 s\"",
          "longest overdamped motion"},
         {"experiment",
          {path()},
          "",
          "CSV with columns F_pN, DA_um, DT_um, and DA_lo, DA_hi, DT_lo, DT_hi for error bars: the summary "
          "says how far the curve is from it"},
         {"recovery",
          {path().of(Form::any)},
          "[]",
          "CSV files with columns t (s) and L_W, length over width, to compare relax-back with"},
         {"curvatures", {not_negative}, "[]", "shapes: values of c0; none: the cell's own"},
         {"area_differences", {not_negative}, "[]", "shapes: values of M0/(8 pi R0); none: the cell's own"},
         {"refine",
          {flag()},
          "false",
          "shapes: repeat with four times the nodes, show that and report the change"},
         {"shear_bounds",
          {quantity_in("N/m").above(0, "a modulus is positive").of(2)},
          "[\"1 uN/m\", \"20 uN/m\"]",
          "calibrate: K_S is sought between these"},
         {"curvature_bounds",
          {number().within(-1e6, 1e6, "no such cell").of(2)},
          "[0, 10]",
          "calibrate: c0 is sought between these"},
         {"tolerance",
          {quantity_in("pN").above(0, "a tolerance is positive")},
          "\"2e-4 pN\"",
          "largest nodal force left"}}};
}

}  // namespace hemoflux::apps
