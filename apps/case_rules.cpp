#include "apps/case_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/case_rigid.hpp"
#include "apps/prefix.hpp"
#include "apps/schema.hpp"
#include "apps/toml_input.hpp"
#include "apps/units.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& why,
                         const std::string& remedy) {
    throw InputError(fmt::format("{}: {}", name, what), why, remedy);
}

void need_tables(const toml::table& values, const std::string& name) {
    const std::string kind = values["kind"].value_or(std::string());
    std::vector<std::string> needed;
    if (kind != "membrane") {
        needed = {"fluid", "grid", "boundary"};
        if (!values.contains("steady")) needed.emplace_back("time");
    }
    if (kind != "fluid") {
        needed.emplace_back("cell");
    }
    for (const std::string& table : needed) {
        const toml::array* array = values[table].as_array();
        if (!values.contains(table) || (array != nullptr && array->empty())) {
            const std::string title = table == "cell" ? "[[cell]]" : fmt::format("[{}]", table);
            refuse(name, fmt::format("table {} is missing", title),
                   fmt::format("a case of kind \"{}\" needs it", kind),
                   fmt::format("Add {}; `hemoflux schema` lists its keys", title));
        }
    }
}

/// Tables that the kind of a case does not read. A case of kind membrane may keep those of the flow, so that
/// --set kind=membrane takes the cells out of it.
void refuse_unused_tables(const toml::table& values, const std::string& name) {
    struct Unused {
        const char *kind, *table, *why;
    };
    constexpr Unused unused[] = {{"fluid", "contact", "it acts between cells"},
                                 {"fluid", "packing", "it places cells"},
                                 {"fluid", "tweezers", "they pull a cell"},
                                 {"fluid", "membrane", "it is a task for cells alone"},
                                 {"coupled", "membrane", "it is a task for cells alone"}};
    const std::string kind = values["kind"].value_or(std::string());
    for (const Unused& u : unused)
        if (kind == u.kind && values.contains(u.table))
            refuse(name, fmt::format("[{}] in a case of kind \"{}\"", u.table, kind),
                   fmt::format("{}, so it would have no effect", u.why), "Remove it, or choose another kind");
}

/// "periodic", a condition, or nothing, for one side.
enum class Side { missing, periodic, condition };

Side side_of(const toml::table& boundary, const std::string& key) {
    if (!boundary.contains(key)) {
        return Side::missing;
    }
    return boundary[key].is_table() ? Side::condition : Side::periodic;
}

void check_boundary(const toml::table& values, const std::string& name) {
    const toml::table* boundary = values["boundary"].as_table();
    if (boundary == nullptr || values["grid"]["mesh"].is_table()) {
        return;
    }
    const std::vector<std::string> sides{"x", "y", "z", "x-", "x+", "y-", "y+", "z-", "z+"};
    for (const auto& [side, patch] : *boundary) {
        if (std::find(sides.begin(), sides.end(), std::string(side.str())) == sides.end()) {
            refuse(name, fmt::format("unknown key \"{}\" in [boundary]", side.str()),
                   "a box has the sides x-, x+, y-, y+, z-, z+", suggestion(side.str(), sides));
        }
    }
    for (const std::string axis : {"x", "y", "z"}) {
        const Side both = side_of(*boundary, axis);
        const Side lower = side_of(*boundary, axis + "-");
        const Side upper = side_of(*boundary, axis + "+");
        if (both != Side::missing) {
            if (lower != Side::missing || upper != Side::missing) {
                refuse(name,
                       fmt::format("boundary.\"{0}\" and boundary.\"{0}{1}\" are both given", axis,
                                   lower != Side::missing ? "-" : "+"),
                       "one side would have two conditions",
                       fmt::format("Keep \"{0}\", or \"{0}-\" and \"{0}+\"", axis));
            }
        } else if (lower == Side::missing || upper == Side::missing) {
            refuse(name,
                   fmt::format("side \"{}{}\" has no boundary condition", axis,
                               lower == Side::missing ? "-" : "+"),
                   "the flow in the box is not determined",
                   fmt::format("Add \"{0}\" = \"periodic\", or a condition for \"{0}-\" and for \"{0}+\"",
                               axis));
        } else if (lower != upper) {
            refuse(name,
                   fmt::format("boundary \"{}{}\" is periodic, its opposite side is not", axis,
                               lower == Side::periodic ? "-" : "+"),
                   "what leaves through a periodic side enters through the other",
                   fmt::format("Write \"{0}\" = \"periodic\", or give both sides a condition", axis));
        }
    }
    for (const auto& [side, patch] : *boundary) {
        if (patch.is_table() && patch.at_path("velocity").value_or(std::string()) == "shear" &&
            !values.contains("shear")) {
            refuse(name, fmt::format("boundary.\"{}\" has velocity = \"shear\"", side.str()),
                   "there is no shear rate", "Add [shear] with a rate");
        }
    }
}

void check_grid(const toml::table& values, const std::string& name) {
    if (!values.contains("grid")) {
        return;
    }
    const Section grid = *Section(case_schema(), values).table("grid");
    if (const auto mesh = grid.table("mesh")) {
        placed(name + ": grid.mesh.unit", [&] { return conversion(mesh->text("unit"), "um"); });
        return;
    }
    std::vector<std::string> kinds = grid.texts("kind");
    kinds.resize(3, kinds.front());
    const auto has_kind = [&](const char* kind) {
        return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    };
    for (std::size_t d = 0; d < 3; ++d) {
        const std::string axis(1, "xyz"[d]);
        if (kinds[d] == "explicit" && (!grid.table("faces") || !grid.table("faces")->has(axis))) {
            refuse(name, fmt::format("grid.faces.{} is missing", axis),
                   "axis " + axis + " has the kind \"explicit\"",
                   fmt::format("Add faces = {{ {} = [...] }} to [grid]", axis));
        }
    }
    if (std::count(kinds.begin(), kinds.end(), "explicit") < 3) {
        for (const char* key : {"length", "cells"}) {
            if (!grid.has(key)) {
                refuse(name, fmt::format("key \"{}\" is missing in [grid]", key), "the box has no size",
                       fmt::format("Add {}", key == std::string("cells")
                                                 ? "cells = [30, 30, 30]"
                                                 : "length = [\"12 um\", \"12 um\", \"12 um\"]"));
            }
        }
    }
    if (has_kind("plateau") && !grid.table("plateau")) {
        refuse(name, "key \"plateau\" is missing in [grid]", "a plateau axis needs its two parameters",
               "Add plateau = { a = 10, b = 0.2 }");
    }
    if (const auto faces = grid.table("faces"))
        placed(name + ": grid.faces.unit", [&] { return conversion(faces->text("unit"), "um"); });
}

void check_membrane(const Section& membrane, const std::vector<Section>& cells, const std::string& name) {
    const std::string task = membrane.text("task");
    if (cells.size() > 1 && (task == "relax-back" || task == "calibrate" || task == "moduli")) {
        refuse(name, fmt::format("{} cells with membrane.task = \"{}\"", cells.size(), task), "it takes one",
               "Keep one [[cell]]");
    }
    if (membrane.numbers("forces").empty()) {
        refuse(name, "membrane.forces is empty", "there is nothing to apply",
               "List forces, or leave the key out");
    }
    if (task == "calibrate" && !membrane.has("experiment")) {
        refuse(name, "membrane.task = \"calibrate\" without membrane.experiment",
               "there is nothing to fit to", "Name a CSV file with columns F_pN, DA_um, DT_um");
    }
    for (const char* key : {"shear_bounds", "curvature_bounds"}) {
        const std::vector<double> bounds = membrane.numbers(key);
        if (!(bounds.at(0) < bounds.at(1))) {
            refuse(name, fmt::format("membrane.{} = [{}, {}]", key, bounds[0], bounds[1]),
                   "the range is empty", "Give the lower bound first");
        }
    }
}

void check_cells(const toml::table& values, const std::string& name) {
    const std::vector<Section> cells = Section(case_schema(), values).tables("cell");
    const std::string kind = values["kind"].value_or(std::string());
    if (kind == "fluid" && !cells.empty()) {
        refuse(name, "a [[cell]] in a case of kind \"fluid\"", "it would have no effect",
               "Write kind = \"coupled\", or remove the cell");
    }
    if (const auto membrane = Section(case_schema(), values).table("membrane"))
        check_membrane(*membrane, cells, name);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto axis = cells[c].vector("axis");
        if (!(std::hypot(axis[0], axis[1], axis[2]) > 0)) {
            refuse(name, fmt::format("cell.{}.axis is zero", c), "it gives no direction",
                   "Write for example [0, 1, 0]");
        }
        if (cells[c].text("reference") == "file" && !cells[c].has("reference_file")) {
            refuse(name, fmt::format("cell.{} has reference = \"file\"", c), "no reference_file is given",
                   "Add reference_file = \"rest.vtp\"");
        }
        if (cells[c].text("reference") == "stored" && !cells[c].has("file")) {
            refuse(name, fmt::format("cell.{} has reference = \"stored\"", c), "no file is given",
                   "Add file = \"rbc.vtp\", as hemoflux mesh rbc writes it");
        }
    }
}

void check_references(const toml::table& values, const std::string& name) {
    for (const Section& reference : Section(case_schema(), values).tables("reference")) {
        const auto low = reference.maybe("low");
        const auto high = reference.maybe("high");
        const std::string what = fmt::format("[[reference]] {}", reference.text("observable"));
        if (!low && !high && !reference.has("value")) {
            refuse(name, what, "there is nothing to compare with", "Add low and high, or value");
        }
        if (low && high && !(*low <= *high)) {
            refuse(name, what, fmt::format("low = {} is above high = {}", *low, *high), "Exchange them");
        }
    }
}

void check_watchdog(const toml::table& values, const std::string& name) {
    const std::vector<double> density = Section(case_schema(), values).table("watchdog")->numbers("density");
    if (!(density.at(0) < density.at(1)))
        refuse(name, fmt::format("watchdog.density = [{}, {}]", density[0], density[1]),
               "no density lies between these", "Give the lowest density first, e.g. [0.9, 1.1]");
}

void check_observables(const toml::table& values, const std::string& name) {
    const bool fluid = values["kind"].value_or(std::string()) == "fluid";
    if (values.contains("observables") && !fluid) {
        refuse(name, "[observables] is given", "it measures a flow without cells",
               "Remove it, or choose kind = \"fluid\"");
    }
    const toml::array* profiles = values["profile"].as_array();
    if (profiles != nullptr && !profiles->empty() && !values.contains("observables")) {
        refuse(name, "[[profile]] is given without [observables]",
               "profiles are in units of its speed and length", "Add [observables]");
    }
}

}  // namespace

void check_rules(const toml::table& resolved, const std::string& name) {
    need_tables(resolved, name);
    refuse_unused_tables(resolved, name);
    check_watchdog(resolved, name);
    check_grid(resolved, name);
    check_boundary(resolved, name);
    check_cells(resolved, name);
    check_observables(resolved, name);
    check_references(resolved, name);
    check_flow_rules(resolved, name);
    check_rigid_rules(Section(case_schema(), resolved), name);
}

}  // namespace hemoflux::apps
