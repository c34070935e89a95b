// The tables of runs with many cells: [contact] and [packing].
#include "apps/schema.hpp"

namespace hemoflux::apps {

Table contact_table() {
    const auto not_negative = [](const char* unit) {
        return quantity_in(unit).within(0, 1e9, "it parts cells or draws them together by its own sign");
    };
    const Form length = quantity_in("um").above(0, "a length is positive");
    return {
        "contact",
        "Short-range forces between cells, and from walls, as a pressure between flat surfaces.",
        {{"pressure", {not_negative("Pa")}, "\"10 Pa\"", "P of the repulsion P (1 - d/range)^2; 0 Pa: none"},
         {"range",
          {automatic(), length},
          "\"auto\"",
          "where the repulsion begins; auto: the longer of a mean edge of the membrane and the smallest grid "
          "cell"},
         {"adhesion",
          {not_negative("J/m^2")},
          "\"0 J/m^2\"",
          "energy per area of the Morse aggregation; 0 J/m^2: none"},
         {"adhesion_distance",
          {automatic(), length},
          "\"auto\"",
          "distance at which the aggregation exerts no force; auto: range"},
         {"adhesion_scale",
          {quantity_in("1/um").above(0, "a scale is positive")},
          "\"4 1/um\"",
          "beta of the Morse law; the aggregation ends 4/beta beyond its distance"},
         {"walls", {flag()}, "true", "repulsion from the sides of the box that are not periodic"}}};
}

Table packing_table() {
    return {
        "packing",
        "Many cells like the one [[cell]], placed and turned at random without overlap.",
        {{"haematocrit",
          {number()
               .above(0, "it is the cells' part of the box")
               .within(1e-9, 0.6, "cells leave room between them")},
          "",
          "volume of the cells over that of the box",
          true},
         {"seed", {integer().within(0, 2147483647, "a seed is a whole number")}, "1", "of the random places"},
         {"gap",
          {quantity_in("um").within(0, 5, "a distance is not negative")},
          "\"0.2 um\"",
          "smallest distance between two cells, and from walls, at the start"}}};
}

}  // namespace hemoflux::apps
