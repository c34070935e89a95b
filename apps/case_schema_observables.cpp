// Tables of a case file about what is measured in a flow.
#include "apps/schema.hpp"

namespace hemoflux::apps {

Table observables_table() {
    const Form place = quantity_in("um").of(3);
    const Form body = table(
        {"observables.body",
         "Force on a patch, wall shear, separation and wake of the body that it encloses.",
         {{"patch", {text()}, "", "name of the patch", true},
          {"direction", {number().of(3)}, "[1, 0, 0]", "of the stream"},
          {"lift", {number().of(3)}, "[0, 1, 0]", "of the lift, normal to the stream"},
          {"centre",
           {automatic(), place},
           "\"auto\"",
           "angles are counted around it; auto: that of the patch"},
          {"area",
           {automatic(), quantity_in("um^2").above(0, "an area is positive")},
           "\"auto\"",
           "A_f of (4.22); auto: the body as the stream sees it"},
          {"front", {automatic(), place}, "\"auto\"", "pressure_difference is counted from here ..."},
          {"rear", {automatic(), place}, "\"auto\"", "... to here; auto: half a length from the centre"}}});
    return {"observables",
            "What is measured in a flow alone, in units of a speed and a length.",
            {{"speed",
              {automatic(), quantity_in("um/s").above(0, "a speed is positive")},
              "\"auto\"",
              "reference speed; auto: of the fastest side"},
             {"length",
              {automatic(), quantity_in("um").above(0, "a length is positive")},
              "\"auto\"",
              "reference length, with a body its diameter; auto: of the box in x"},
             {"cavity",
              {flag()},
              "false",
              "extrema of the centrelines and vortices of a cavity whose lid y+ moves in x"},
             {"body", {body}, "", "forces on a body and its wake"}}};
}

Table profile_table() {
    return {
        "profile",
        "A computed or published profile along a line through the flow; the summary has its root mean square "
        "distance "
        "as FIELD_profile_rms, or FIELD_profile_rms_NAME.",
        {{"field", {choice({"u", "v", "w"})}, "", "velocity component, in units of observables.speed", true},
         {"along",
          {choice({"x", "y", "z"})},
          "",
          "direction of the line; positions in units of observables.length from its lower end",
          true},
         {"through",
          {automatic(), quantity_in("um").of(3)},
          "\"auto\"",
          "a point of the line; auto: the middle of the box"},
         {"file", {path()}, "", "CSV file, '#' comments first", true},
         {"columns", {text().of(2)}, "", "of position and value", true},
         {"rows", {text().of(2)}, "", "a column and the word that its rows must have"},
         {"skip", {number().of(Form::any)}, "[]", "positions of misprinted values, left out"},
         {"name", {text()}, "\"\"", "tells several profiles of one field apart"},
         {"label", {text()}, "\"reference\"", "in the plot"}}};
}

}  // namespace hemoflux::apps
