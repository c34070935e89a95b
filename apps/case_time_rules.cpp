// Rules between keys that concern a run's time: its length, its step, and what of the output depends on both.
#include <fmt/format.h>

#include "apps/case_rules.hpp"
#include "apps/schema.hpp"
#include "apps/toml_input.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& why,
                         const std::string& remedy) {
    throw InputError(fmt::format("{}: {}", name, what), why, remedy);
}

/// A given step is not longer than the run, and the run has a number of steps that can be counted and waited for.
void check_length(const Section& top, const Section& time, const std::string& name) {
    constexpr double most_steps = 1e12;
    const auto shear = top.table("shear");
    const double rate = shear ? shear->number("rate") : 0;
    const auto refuse_unless = [&](const char* key, double step, const char* of, double length) {
        if (step > length * (1 + 1e-9))
            refuse(name, fmt::format("{} = {:.4g}", key, step),
                   fmt::format("the step is longer than the run, whose {} is {:.4g}", of, length),
                   "Shorten the step, or lengthen the run");
        if (!(length / step < most_steps))
            refuse(name, fmt::format("{} = {:.4g} in a run whose {} is {:.4g}", key, step, of, length),
                   "that many steps never end", "Lengthen the step, or shorten the run");
    };
    const auto step = time.maybe("step"), strain = time.maybe("strain"), duration = time.maybe("duration");
    const auto step_strain = top.table("numerics")->maybe("step_strain");
    if (step && duration) refuse_unless("time.step", *step, "duration (s)", *duration);
    if (step && strain && rate > 0) refuse_unless("time.step", *step * rate, "strain", *strain);
    if (step_strain && strain) refuse_unless("numerics.step_strain", *step_strain, "strain", *strain);
    if (step_strain && duration && rate > 0)
        refuse_unless("numerics.step_strain", *step_strain, "strain", *duration * rate);
}

/// Steps that follow the error are of runs with cells, and leave nothing else to set the step.
void check_adaptive(const Section& top, const Section& time, const std::string& name) {
    if (!time.flag("adaptive")) {
        if (time.maybe("tolerance"))
            refuse(name, "time.tolerance without time.adaptive = true", "equal steps follow no error",
                   "Add adaptive = true to [time], or remove it");
        return;
    }
    if (top.text("kind") != "coupled")
        refuse(name, fmt::format("time.adaptive in a case of kind \"{}\"", top.text("kind")),
               "the error is that of membrane nodes, and there are none", "Remove it, or set the step");
    const bool in_strain = top.table("numerics")->maybe("step_strain").has_value();
    if (in_strain || time.maybe("step"))
        refuse(name, fmt::format("time.adaptive with {}", in_strain ? "numerics.step_strain" : "time.step"),
               "steps that follow the error are not given", "Keep one of them");
    for (const Section& body : top.tables("body"))
        if (body.text("method") == "feedback" && !body.maybe("stiffness"))
            refuse(name, "time.adaptive with a [[body]] whose stiffness is \"auto\"",
                   "springs chosen for the first step would be too stiff for longer ones",
                   "Give its stiffness, or write method = \"direct\"");
}

}  // namespace

void check_time_rules(const toml::table& values, const std::string& name) {
    if (!values.contains("time") || values.contains("steady")) {
        return;
    }
    const Section top(case_schema(), values);
    const Section time = *top.table("time");
    const auto exact = top.table("analytical");
    const bool timed = exact && !exact->numbers("times").empty();
    if (timed && (time.has("strain") || time.has("duration"))) {
        refuse(name, "analytical.times and the length of the run are both given",
               "the last of the times ends the run", "Remove time.duration, or the times");
    }
    if (!timed && time.has("strain") == time.has("duration")) {
        refuse(name,
               time.has("strain") ? "time.strain and time.duration are both given" : "the run has no length",
               "exactly one of them says when it ends", "Keep one, e.g. strain = 25 in [time]");
    }
    const bool sheared = values.contains("shear") || values["kind"].value_or(std::string()) == "coupled";
    if (time.has("strain") && !sheared) {
        refuse(name, "time.strain is given without [shear]", "strain is shear rate times time",
               "Add [shear] with a rate, or give duration = \"1 s\" instead");
    }
    const bool step = time.maybe("step").has_value();
    const bool step_strain = top.table("numerics")->maybe("step_strain").has_value();
    check_length(top, time, name);
    check_adaptive(top, time, name);
    if (step && step_strain) {
        refuse(name, "time.step and numerics.step_strain are both given", "a run has one time step",
               "Keep one of them");
    }
    if (step_strain && !sheared) {
        refuse(name, "numerics.step_strain is given without [shear]", "strain is shear rate times time",
               "Add [shear] with a rate, or give time.step instead");
    }
    const auto fluid = top.table("fluid");
    if (fluid && fluid->text("initial") == "shear" && !values.contains("shear")) {
        refuse(name, "fluid.initial is \"shear\" without [shear]", "there is no shear rate",
               "Add [shear] with a rate");
    }
    if (fluid && fluid->text("initial") == "inflow") {
        const toml::node_view<const toml::node> side = values["boundary"]["x-"];
        const std::string velocity =
            side["velocity"].value_or(std::string(side["velocity"].is_array() ? "vector" : ""));
        if (velocity.empty() || velocity == "zero-gradient" || velocity == "symmetry") {
            refuse(name, "fluid.initial is \"inflow\"", "the side x- has no given velocity",
                   "Give boundary.\"x-\" a velocity, or start at rest");
        }
    }
    const std::vector<double> window = top.table("output")->numbers("window_strain");
    if (!window.empty() && !(window[0] >= 0 && window[0] < window[1])) {
        refuse(name, fmt::format("output.window_strain = [{}, {}]", window[0], window[1]),
               "the window is empty", "Give the lower strain first, e.g. [10, 25]");
    }
}

}  // namespace hemoflux::apps
