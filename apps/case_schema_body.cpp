// The table [[body]]: rigid bodies in the fluid.
#include "apps/schema.hpp"

namespace hemoflux::apps {

Table rigid_body_table() {
    const Form length = quantity_in("um").above(0, "a length is positive");
    return {
        "body",
        "One rigid body each, immersed in the fluid (chapter 5), in a box of cells or a mesh. Kinds fluid "
        "and coupled; with [steady], in a box, it is held, and its forces are unknowns of the implicit "
        "method.",
        {{"name", {text()}, "\"\"", "what files and observables of several bodies call it"},
         {"shape",
          {choice({"sphere", "spheroid", "cylinder"})},
          "\"sphere\"",
          "a cylinder is open and usually spans the box; a file is a shape of its own"},
         {"file", {path()}, "", "closed triangulated surface (um) in place of shape: .vtp, .ply, .stl, .obj"},
         {"diameter", {length}, "", "of sphere and cylinder; of a spheroid the equator's"},
         {"aspect",
          {number().above(0, "a ratio of lengths")},
          "1",
          "spheroid: polar axis over equatorial diameter, above 1 prolate"},
         {"length", {length}, "", "of a cylinder"},
         {"nodes",
          {automatic(), integer().within(12, 655362, "a surface has nodes")},
          "\"auto\"",
          "of the surface, about; spheres and spheroids: 42, 162, 642, 2562, ...; auto: at least 1.4 per "
          "square "
          "of the cells around it"},
         {"position", {quantity_in("um").of(3)}, "[\"0 um\", \"0 um\", \"0 um\"]", "centre at the start"},
         {"axis",
          {number().of(3)},
          "[0, 0, 1]",
          "at the start, of a spheroid or cylinder; the z axis of a file"},
         {"motion",
          {choice({"prescribed", "torque-free", "free"})},
          "\"prescribed\"",
          "moves with its velocities (zero: it is fixed); the same, but turns freely; or moves freely"},
         {"velocity", {quantity_in("um/s").of(3)}, "[\"0 um/s\", \"0 um/s\", \"0 um/s\"]", "of the centre"},
         {"angular_velocity", {quantity_in("1/s").of(3)}, "[\"0 1/s\", \"0 1/s\", \"0 1/s\"]", "in rad/s"},
         {"density",
          {automatic(), quantity_in("kg/m^3").above(0, "a density is positive")},
          "\"auto\"",
          "of a body that moves freely, at least the fluid's; auto: neutrally buoyant"},
         {"force", {quantity_in("N").of(3)}, "", "on the body from outside, e.g. its weight in the fluid"},
         {"torque", {quantity_in("N m").of(3)}, "", "on the body from outside"},
         {"method",
          {choice({"direct", "feedback"})},
          "\"direct\"",
          "the velocity at the nodes is corrected in every step (multi-direct forcing), or springs (5.21)"},
         {"stiffness",
          {automatic(), quantity_in("Pa/m").above(0, "springs pull back")},
          "\"auto\"",
          "feedback: force per area per displacement, k of (5.21); auto: a fiftieth of what makes the "
          "springs as fast "
          "as the step"},
         {"iterations",
          {integer().within(1, 100, "the velocity is corrected at least once")},
          "4",
          "direct: corrections in a step"},
         {"retraction",
          {automatic(), number().within(-2, 2, "beyond, the surface is another one")},
          "\"auto\"",
          "by how many local cells the nodes are drawn in, because smeared forces act as a larger body; "
          "auto: as "
          "measured on a turning sphere, 0.12 lagrange (0.19 on a mesh), 0.34 phi2, 0.38 phi3, 0.51 phi4"},
         {"speed",
          {quantity_in("um/s").above(0, "a speed is positive")},
          "",
          "U of drag_coefficient and lift_coefficient, F/(rho U^2 A/2); without it there are none"},
         {"reference_area",
          {automatic(), quantity_in("um^2").above(0, "an area is positive")},
          "\"auto\"",
          "A of the coefficients; auto: pi D^2/4, of a cylinder D L"},
         {"drag_direction",
          {number().of(3)},
          "[1, 0, 0]",
          "of the drag; the pressure difference is along it"},
         {"lift_direction", {number().of(3)}, "[0, 1, 0]", "of the lift"}}};
}

}  // namespace hemoflux::apps
