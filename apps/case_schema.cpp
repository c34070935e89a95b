// Every table and key of a case file but those of [[cell]].
#include "apps/schema.hpp"

namespace hemoflux::apps {
namespace {

constexpr const char* positive_length = "a length is positive";

Table fluid_table() {
    return {
        "fluid",
        "The suspending fluid.",
        {{"density",
          {quantity_in("kg/m^3").above(0, "a density is positive")},
          "\"1000 kg/m^3\"",
          "mass density of both fluids"},
         {"viscosity",
          {quantity_in("Pa s").above(0, "a viscosity is positive")},
          "",
          "dynamic viscosity of the suspending fluid",
          true},
         {"initial",
          {choice({"auto", "rest", "uniform", "shear", "channel", "inflow", "analytical"})},
          "\"auto\"",
          "flow at the start; auto: shear where [shear] is given, channel where a force drives cells between "
          "walls, else rest; channel: the steady flow of [body_force]; inflow: the velocity of the side x- "
          "everywhere, with the pressure drop of its friction; analytical: as [analytical] at t = "
          "0"},
         {"initial_velocity",
          {quantity_in("um/s").of(3)},
          "",
          "of initial = \"uniform\": the same everywhere, e.g. the free stream around a body"}}};
}

Table grid_table() {
    const auto kinds = {"uniform", "plateau", "chebyshev", "explicit"};
    const Key list{"", {number().of(Form::any)}, "", "ascending face coordinates"};
    const auto faces_along = [&](const char* name) { return Key{name, list.forms, "", list.meaning}; };
    return {"grid",
            "The rectilinear grid; each axis on its own.",
            {{"kind",
              {choice(kinds), choice(kinds).of(3)},
              "\"uniform\"",
              "spacing, of all axes or one word per axis"},
             {"mesh",
              {table(mesh_table())},
              "",
              "an unstructured mesh of hexahedra in place of the box, kind fluid"},
             {"length",
              {quantity_in("um").above(0, positive_length).of(3)},
              "",
              "size of the box; not needed where all axes are explicit"},
             {"cells",
              {integer().within(1, 4096, "a grid has at least one cell per axis").of(3)},
              "",
              "number of cells; not needed where all axes are explicit"},
             {"plateau",
              {table({"grid.plateau",
                      "Plateau spacing (5.31), in index units.",
                      {{"a",
                        {number().within(0, 2048, "half the width of the plateau, in cells")},
                        "",
                        "half the width of the fine plateau, in cells",
                        true},
                       {"b",
                        {number().above(0, "the steepness is positive")},
                        "",
                        "steepness of the step to the coarse cells",
                        true}}})},
              "",
              "parameters of plateau axes"},
             {"origin",
              {choice({"centred", "corner"})},
              "\"centred\"",
              "where the coordinate origin lies in the box: its centre or its lower corner"},
             {"faces",
              {table({"grid.faces",
                      "Face coordinates of explicit axes.",
                      {faces_along("x"),
                       faces_along("y"),
                       faces_along("z"),
                       {"unit", {text()}, "\"um\"", "unit of the coordinates"}}})},
              "",
              "face coordinates of explicit axes"}}};
}

Table numerics_table() {
    return {
        "numerics",
        "Numerical parameters; chosen and printed with their estimated errors when left out.",
        {{"lattice_viscosity",
          {automatic(), number().above(0, "a viscosity is positive")},
          "\"auto\"",
          "kind coupled: nu/h of the more viscous fluid in lattice units; sets the accuracy; auto: 0.5"},
         {"reynolds",
          {automatic(), number().above(0, "a Reynolds number is positive")},
          "\"auto\"",
          "kind coupled: Re_G = G D^2/nu of the computation (capillary scaling); auto: 2"},
         {"mach",
          {automatic(), number().within(1e-6, 0.3, "the scheme is weakly compressible")},
          "\"auto\"",
          "largest speed over the speed of sound; auto: follows from the two above (coupled), or 0.1 "
          "(fluid)"},
         {"speed",
          {automatic(), quantity_in("um/s").above(0, "a speed is positive")},
          "\"auto\"",
          "kind fluid: speed that mach refers to; auto: the fastest that sides, forces and solution suggest"},
         {"step_strain",
          {automatic(), number().above(0, "a time step is positive")},
          "\"auto\"",
          "time step in strain units"},
         {"gamma",
          {automatic(), number().within(1e-4, 1, "gamma = 1 means no preconditioning")},
          "1",
          "preconditioning (4.2); auto, in steady runs: by the strategy of Table 4.1, printed with its "
          "reasons"},
         {"tau_floor",
          {number().within(0, 10, "tau - 1/2 is not negative")},
          "0.05",
          "lower bound of tau - 1/2"},
         {"precision",
          {choice({"double", "single"})},
          "\"double\"",
          "of the residual; single is faster and for fluid runs on cubic cells, error about 1e-5 of it"},
         {"gradient",
          {choice({"least-squares", "green-gauss", "hybrid"})},
          "\"least-squares\"",
          "kind fluid: operator for the gradients (A.29-A.35); hybrid on unstructured grids only"}}};
}

Table output_table() {
    const Form interval = number().above(0, "an interval is positive");
    return {"output",
            "What a run writes.",
            {{"interval_strain", {interval}, "0.5", "strain between two pictures of fluid and cells"},
             {"interval",
              {quantity_in("s").above(0, "an interval is positive")},
              "",
              "the same as a time; needed without [shear]"},
             {"history_interval_strain", {interval}, "0.05", "strain between two rows of history.csv"},
             {"checkpoint_interval_strain",
              {number().within(0, 1e9, "an interval is not negative")},
              "5",
              "strain between two checkpoints; 0: none"},
             {"fields",
              {choice({"velocity", "density", "pressure", "vorticity", "viscosity", "force"}).of(Form::any)},
              "[\"velocity\", \"density\", \"viscosity\"]",
              "fluid fields in the .vtr files"},
             {"pictures", {flag()}, "true", "PNG and SVG pictures at the end"},
             {"window_strain",
              {automatic(), number().of(2)},
              "\"auto\"",
              "strains between which observables are averaged; auto: the last 60 % of the run"}}};
}

}  // namespace

const Table& case_schema() {
    static const Table schema{
        "case",
        "What is run. Which tables are needed depends on the kind.",
        {{"title", {text()}, "", "one line for the summary and the pictures", true},
         {"kind",
          {choice({"coupled", "fluid", "membrane"})},
          "\"coupled\"",
          "cells in a flow, the flow alone, or one cell alone at rest"},
         {"fluid", {table(fluid_table())}, "", "kinds coupled and fluid"},
         {"grid", {table(grid_table())}, "", "kinds coupled and fluid"},
         {"boundary", {table(boundary_table())}, "", "kinds coupled and fluid"},
         {"shear",
          {table(
              {"shear",
               "Shear flow u = G y e_x.",
               {{"rate", {quantity_in("1/s").above(0, "strain is the clock of the run")}, "", "G", true}}})},
          "",
          "needed by velocity = \"shear\" and, but in coupled runs, by strain"},
         {"body_force", {table(body_force_table())}, "", "optional"},
         {"steady",
          {table(steady_table())},
          "",
          "kind fluid: iterates to the steady state, in place of [time]; also with bodies, which are held"},
         {"analytical", {table(analytical_table())}, "", "kind fluid"},
         {"sweep", {table(sweep_table())}, "", "optional"},
         {"cell", {table(cell_table()).of(Form::any)}, "", "kinds coupled and membrane"},
         {"body", {table(rigid_body_table()).of(Form::any)}, "", "kinds fluid and coupled"},
         {"coupling",
          {table(
              {"coupling",
               "Immersed boundary between fluid and what is immersed in it.",
               {{"kernel",
                 {choice({"lagrange", "phi2", "phi3", "phi4"})},
                 "\"lagrange\"",
                 "interpolation and spreading"},
                {"recentre", {flag()}, "false", "move the cell back to its position after every step"},
                {"smoothing",
                 {number().within(1, 8, "a jump sharper than one cell is not resolved")},
                 "1",
                 "half-width of the viscosity step (6.46), in local grid cells"},
                {"membrane_viscosity",
                 {choice({"springs", "fluid"})},
                 "\"springs\"",
                 "how cell.membrane_viscosity acts: along the membrane's springs, or by raising the fluid's "
                 "viscosity in the cells that the membrane crosses"}}})},
          "{}",
          "kind coupled, and [[body]]"},
         {"contact",
          {table(contact_table())},
          "",
          "kind coupled; none: cells do not feel each other but through the fluid"},
         {"packing", {table(packing_table())}, "", "kind coupled, in place of a list of cells"},
         {"tweezers", {table(tweezers_table())}, "", "kind coupled, optional"},
         {"time",
          {table(
              {"time",
               "How the run advances and how long it lasts.",
               {{"scheme",
                 {choice({"euler", "rk4", "factored"})},
                 "\"factored\"",
                 "forward Euler, Runge-Kutta 4, or linearly implicit with approximate factorisation"},
                {"strain",
                 {number().above(0, "a run has a length")},
                 "",
                 "length of the run in strain units (kind coupled without shear: in mu R0/K_S); or duration"},
                {"duration",
                 {quantity_in("s").above(0, "a run has a length")},
                 "",
                 "length of the run in time; or strain"},
                {"step",
                 {automatic(), quantity_in("s").above(0, "a time step is positive")},
                 "\"auto\"",
                 "time step; auto: chosen for stability, or numerics.step_strain"},
                {"steady",
                 {number().within(1e-14, 1, "a share")},
                 "",
                 "kind fluid: ends the run when in a hundredth of its length the velocity changes by less "
                 "than "
                 "this share (relative L2)"}}})},
          "",
          "kinds coupled and fluid"},
         {"numerics", {table(numerics_table())}, "{}", "optional"},
         {"membrane", {table(membrane_table())}, "", "kind membrane"},
         {"output", {table(output_table())}, "{}", "optional"},
         {"observables", {table(observables_table())}, "", "kind fluid"},
         {"profile", {table(profile_table()).of(Form::any)}, "", "kind fluid, with [observables]"},
         {"reference",
          {table({"reference",
                  "A published or computed number that the summary compares with.",
                  {{"observable", {text()}, "", "name of the observable in summary.json", true},
                   {"low", {number()}, "", "lower end of the accepted range"},
                   {"high", {number()}, "", "upper end of the accepted range"},
                   {"value", {number()}, "", "the reference value itself"},
                   {"source", {text()}, "", "where the number comes from", true}}})
               .of(Form::any)},
          "",
          "optional"}}};
    return schema;
}

}  // namespace hemoflux::apps
