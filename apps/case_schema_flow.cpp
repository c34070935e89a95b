// Tables of a case file about the conditions of a flow: boundary, forces, exact solutions, sweeps.
#include "apps/schema.hpp"

namespace hemoflux::apps {

Table boundary_table() {
    const Form patch =
        table({"boundary.patch",
               "Conditions on one side of the box; the velocity and the density condition are independent. "
               "In expressions x, "
               "y, z stand for metres and t for seconds; results are in m/s and Pa.",
               {{"velocity",
                 {choice({"shear", "no-slip", "zero-gradient", "symmetry", "parabolic", "expression"}),
                  quantity_in("um/s").of(3)},
                 "",
                 "velocity on the side: u = G y e_x, zero, copied from inside, mirrored, inflow of a plane "
                 "or square duct "
                 "(5.22), functions of place and time, or a vector; needed but where the patch is periodic"},
                {"periodic",
                 {text()},
                 "",
                 "of a mesh: the patch opposite, equal to this one but for a translation"},
                {"speed",
                 {quantity_in("um/s")},
                 "",
                 "of parabolic: velocity into the box in the middle of the side; a product of parabolas "
                 "along the axes that "
                 "are not periodic"},
                {"velocity_expression",
                 {text().of(3)},
                 "",
                 "of expression: the three components, e.g. [\"0.1*sin(2*_pi*t)*y\", \"0\", \"0\"]"},
                {"density",
                 {choice({"zero-gradient", "gradient", "expression"}),
                  number().above(0, "a density is positive"), quantity_in("Pa")},
                 "\"zero-gradient\"",
                 "density relative to the reference density, a pressure above the reference, its gradient, "
                 "or a function"},
                {"pressure_gradient", {quantity_in("Pa/m")}, "", "of gradient: along the inward normal"},
                {"pressure_expression", {text()}, "", "of expression: pressure above the reference"}}});
    const auto side = [&](const char* name, const char* meaning) {
        return Key{name, {choice({"periodic"}), patch}, "", meaning};
    };
    return {"boundary",
            "One key per side, or one for both sides of an axis; of a mesh one key per patch.",
            {side("x", "both sides in x"), side("y", "both sides in y"), side("z", "both sides in z"),
             side("x-", "lower side in x"), side("x+", "upper side in x"), side("y-", "lower side in y"),
             side("y+", "upper side in y"), side("z-", "lower side in z"), side("z+", "upper side in z")},
            {Key{"PATCH", {patch}, "", "a patch of the mesh, by its name"}}};
}

Table mesh_table() {
    const Form length = quantity_in("um").above(0, "a length is positive");
    const Form share = number().above(0, "it is positive");
    return {
        "grid.mesh",
        "A mesh from a file or a generator; what is left out is as in `hemoflux mesh hex`.",
        {{"kind",
          {choice({"file", "cube", "cylinder", "pipe", "constriction"})},
          "\"file\"",
          "file, or a generator: cube with fine walls, far field around a cylinder, straight or narrowed "
          "pipe"},
         {"file", {path()}, "", "of kind file: .msh or .vtu"},
         {"unit", {text()}, "\"m\"", "of kind file: its unit of length"},
         {"size", {length}, "", "edge of the cube, diameter of cylinder or pipe; needed by the generators"},
         {"cells", {integer().above(0, "a mesh has cells")}, "", "number of cells, about"},
         {"wall", {share}, "", "cube, pipes: width of cells at the walls over that in the middle"},
         {"radius", {share}, "", "cylinder: of the far field, in diameters"},
         {"thickness", {share}, "", "cylinder: extent in z, in diameters"},
         {"first_height", {share}, "", "cylinder: of the cells on it, in diameters, for a scale of 1"},
         {"scale", {share}, "", "cylinder: multiplies all cell widths"},
         {"wake",
          {number().within(0, 0.9, "beyond, cells upstream are too coarse")},
          "",
          "cylinder: how strongly cells gather in the wake"},
         {"length", {share}, "", "pipes: in diameters"},
         {"depth",
          {number().within(0, 0.8, "the pipe stays open")},
          "",
          "constriction: part of the radius that the throat takes away"},
         {"throat", {share}, "", "constriction: its place, in diameters"},
         {"throat_length", {share}, "", "constriction: length of the narrowed part, in diameters"}}};
}

Table steady_table() {
    return {"steady",
            "Iteration to the steady state, with its history and a plot of the residual.",
            {{"method",
              {choice({"implicit", "local-steps"})},
              "\"implicit\"",
              "Newton and GMRES, or Runge-Kutta with local time steps (2.55)"},
             {"criterion",
              {choice({"momentum", "residual", "velocity-change"})},
              "\"momentum\"",
              "what falls below the tolerance: rms of the rho u residual over its first value (4.21), that "
              "of all "
              "components (3.5), or the relative change of the velocity in one iteration (3.11)"},
             {"tolerance",
              {number().within(1e-14, 1, "a share")},
              "1e-5",
              "where the iteration ends; on strongly graded grids take 1e-9 or less, since the smallest "
              "cells make the first residual large"},
             {"iterations", {integer().above(0, "an iteration has a number")}, "200000", "most iterations"},
             {"sigma",
              {number().above(0, "a Courant number is positive")},
              "1",
              "local-steps: Courant number (2.55)"},
             {"viscous_weight", {number().above(0, "a weight is positive")}, "4", "local-steps: C of (2.55)"},
             {"start",
              {path()},
              "",
              "folder of a steady run, on a coarser grid as a rule, whose flow is the start"}}};
}

Table body_force_table() {
    return {"body_force",
            "A force on the fluid that is the same everywhere: density * acceleration + amplitude cos(2 pi t "
            "/ period + "
            "phase).",
            {{"acceleration", {quantity_in("m/s^2").of(3)}, "", "constant force per mass"},
             {"amplitude", {quantity_in("N/m^3").of(3)}, "", "of the oscillating force per volume"},
             {"period", {quantity_in("s").above(0, "a period is positive")}, "", "of the oscillating force"},
             {"phase", {quantity_in("degree")}, "\"0 degree\"", "of the oscillating force"}}};
}

Table analytical_table() {
    return {"analytical",
            "An exact solution that the run is compared with; also its start with fluid.initial = "
            "\"analytical\". "
            "Geometry, viscosity and force are those of the case.",
            {{"solution",
              {choice({"couette", "poiseuille", "taylor-green", "womersley"})},
              "",
              "between plates in y moving or driven in x, decaying vortices (3.15), oscillating channel flow "
              "(3.24)",
              true},
             {"speed",
              {quantity_in("um/s").above(0, "a speed is positive")},
              "",
              "of the upper wall (couette), in the middle (poiseuille), u0 (taylor-green)"},
             {"times",
              {number().within(0, 1e9, "times are not negative").of(Form::any)},
              "[]",
              "when to compare, in decay times (taylor-green) or periods (womersley), ascending; the last "
              "ends the run. "
              "Empty: at the end of the run"}}};
}

Table sweep_table() {
    return {
        "sweep",
        "Many runs of one case, by `hemoflux sweep`; `hemoflux run` runs the case as it stands.",
        {{"values",
          {table({"sweep.values",
                  "Addresses of keys with the list of their values, e.g. \"grid.cells\" = [[20, 20, 1], [40, "
                  "40, 1]].",
                  {},
                  {{"ADDRESS", {anything().of(Form::any)}, "", "values of the key"}}})},
          "",
          "what varies; the first key is the abscissa of the plot",
          true},
         {"combine",
          {choice({"together", "product"})},
          "\"together\"",
          "the lists go side by side, or each value meets each"},
         {"observables", {text().of(Form::any)}, "[]", "columns that are printed and plotted; empty: all"},
         {"order",
          {text().of(Form::any)},
          "[]",
          "observables for which the order of convergence in the first key is fitted (order_NAME)"},
         {"extrapolate",
          {text().of(Form::any)},
          "[]",
          "observables for which value = limit + a x^order is fitted over three runs or more, x the first "
          "key, a "
          "spacing or a step, or one over a number of cells (limit_NAME, order_NAME)"},
         {"order_range",
          {number().of(2)},
          "",
          "the first key's values between which orders are fitted, in the unit of the first value; none: "
          "all"},
         {"difference_from_last",
          {flag()},
          "false",
          "adds the observable difference: relative L2 distance of the velocity from the last run's, on the "
          "same grid"},
         {"measured",
          {table({"sweep.measured",
                  "Points to show in the plot beside the computed ones.",
                  {{"file", {path()}, "", "CSV file", true},
                   {"x",
                    {text()},
                    "",
                    "its column for the abscissa, in the unit of the first swept value",
                    true},
                   {"y", {text()}, "", "its column for the ordinate", true},
                   {"label", {text()}, "", "what the plot calls them", true}}})
               .of(Form::any)},
          "[]",
          "[[sweep.measured]]: measured points for the plot"},
         {"log", {choice({"none", "x", "y", "both"})}, "\"both\"", "logarithmic axes of the plot"}}};
}

}  // namespace hemoflux::apps
