#include "apps/case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/case_flow.hpp"
#include "apps/case_membrane.hpp"
#include "apps/case_rules.hpp"
#include "apps/case_suspension.hpp"
#include "apps/choice.hpp"
#include "apps/prefix.hpp"
#include "apps/toml_input.hpp"
#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

TimeInput read_time(const Section& in) {
    return {chosen<TimeScheme>(in.text("scheme"), {"euler", "rk4", "factored"}),
            in.maybe("strain"),
            in.maybe("duration"),
            in.maybe("step"),
            in.maybe("steady"),
            in.flag("adaptive"),
            in.maybe("tolerance")};
}

NumericsInput read_numerics(const Section& in) {
    return {in.maybe("lattice_viscosity"),
            in.maybe("reynolds"),
            in.maybe("mach"),
            in.maybe("speed"),
            in.maybe("step_strain"),
            in.maybe("gamma"),
            in.number("tau_floor"),
            in.text("precision") == "single",
            chosen<Gradient>(in.text("gradient"), {"least-squares", "green-gauss", "hybrid"})};
}

OutputInput read_output(const Section& in) {
    OutputInput output{in.number("interval_strain"),
                       in.maybe("interval"),
                       in.number("history_interval_strain"),
                       in.maybe("history_interval"),
                       in.number("checkpoint_interval_strain"),
                       in.maybe("checkpoint_interval"),
                       in.integer("compression"),
                       in.texts("fields"),
                       in.flag("pictures"),
                       {}};
    if (const std::vector<double> window = in.numbers("window_strain"); !window.empty()) {
        output.window_strain = {window[0], window[1]};
    }
    return output;
}

Case read_values(const toml::table& values) {
    const Section in(case_schema(), values);
    Case c;
    c.title = in.text("title");
    c.kind = chosen<CaseKind>(in.text("kind"), {"coupled", "fluid", "membrane"});
    if (const auto shear = in.table("shear")) {
        c.shear_rate = shear->number("rate");
    }
    if (const auto fluid = in.table("fluid")) {
        c.fluid = read_fluid(*fluid, c.shear_rate.has_value());
    }
    if (const auto grid = in.table("grid")) {
        if (const auto mesh = grid->table("mesh")) {
            c.mesh = read_mesh(*mesh);
        } else {
            c.grid = read_grid(*grid);
        }
    }
    if (const auto boundary = in.table("boundary"); boundary && c.mesh) {
        c.patches = read_patches(*boundary);
    } else if (boundary) {
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t side = 0; side < 2; ++side) {
                const std::string both(1, "xyz"[d]);
                const std::string one = both + "-+"[side];
                const auto patch = boundary->table(boundary->has(one) ? one : both);
                c.boundary[d][side] = patch ? read_patch(*patch) : PatchInput{};
            }
        }
    }
    if (const auto force = in.table("body_force")) {
        c.body_force = read_body_force(*force);
    }
    if (const auto steady = in.table("steady")) {
        c.steady = read_steady(*steady);
    }
    if (const auto exact = in.table("analytical")) {
        c.analytical = read_analytical(*exact);
    }
    for (const Section& cell : in.tables("cell")) {
        c.cells.push_back(read_cell(cell));
    }
    for (const Section& body : in.tables("body")) {
        c.bodies.push_back(read_rigid(body));
    }
    if (const auto coupling = in.table("coupling")) {
        c.coupling = {
            chosen<Kernel>(coupling->text("kernel"), {"lagrange", "phi2", "phi3", "phi4"}),
            coupling->flag("recentre"), coupling->number("smoothing"),
            chosen<MembraneViscosityForm>(coupling->text("membrane_viscosity"), {"springs", "fluid"})};
    }
    if (const auto tweezers = in.table("tweezers")) {
        c.tweezers = read_tweezers(*tweezers);
    }
    if (const auto contact = in.table("contact")) {
        c.contact = read_contact(*contact);
    }
    if (const auto packing = in.table("packing")) {
        c.packing = read_packing(*packing);
    }
    if (const auto time = in.table("time")) {
        c.time = read_time(*time);
    }
    if (const auto numerics = in.table("numerics")) {
        c.numerics = read_numerics(*numerics);
    }
    if (const auto membrane = in.table("membrane")) {
        c.membrane = read_membrane(*membrane);
    }
    if (const auto output = in.table("output")) {
        c.output = read_output(*output);
    }
    if (const auto watchdog = in.table("watchdog")) {
        c.watchdog = read_watchdog(*watchdog);
    }
    if (const auto observables = in.table("observables")) {
        c.observables = read_observables(*observables);
    }
    for (const Section& profile : in.tables("profile")) {
        c.profiles.push_back(read_profile(profile));
    }
    for (const Section& r : in.tables("reference")) {
        c.references.push_back(
            {r.text("observable"), r.maybe("low"), r.maybe("high"), r.maybe("value"), r.text("source")});
    }
    return c;
}

Case finish(toml::table values, const std::string& name, const std::filesystem::path& folder,
            const std::vector<std::string>& overrides) {
    for (const std::string& assignment : overrides) {
        override_value(values, assignment);
    }
    toml::table resolved = resolve(case_schema(), values, folder);
    check_rules(resolved, name);
    Case c = read_values(resolved);
    if (resolved.contains("sweep")) {
        c.sweep = read_sweep(*Section(case_schema(), resolved).table("sweep"),
                             *values["sweep"]["values"].as_table());
        resolved.erase("sweep");
    }
    for (CellInput& cell : c.cells) {
        const double length = std::hypot(cell.axis[0], cell.axis[1], cell.axis[2]);
        for (double& component : cell.axis) {
            component /= length;
        }
    }
    complete_suspension(c, resolved["fluid"]["initial"].value_or(std::string("auto")) != "auto");
    c.resolved = "# The case with every default filled in.\n" + to_toml(case_schema(), resolved);
    return c;
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return finish(read_toml(file), file.string(), std::filesystem::absolute(file).parent_path(), overrides);
}

Case parse_case(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                const std::vector<std::string>& overrides) {
    return finish(parse_toml(text, name), name, folder, overrides);
}

namespace {

meshing::Axis make_axis(const GridInput& grid, std::size_t d) {
    const double lower = grid.lower[d], upper = lower + grid.length[d];
    switch (grid.kind[d]) {
        case AxisKind::uniform:
            return meshing::uniform_axis(lower, upper, grid.cells[d]);
        case AxisKind::plateau:
            return meshing::plateau_axis(lower, upper, grid.cells[d], grid.plateau_a, grid.plateau_b);
        case AxisKind::chebyshev:
            return meshing::chebyshev_axis(lower, upper, grid.cells[d]);
        case AxisKind::given:
            break;
    }
    return meshing::explicit_axis(grid.faces[d]);
}

}  // namespace

meshing::RectilinearGrid make_grid(const GridInput& grid) {
    meshing::RectilinearGrid result;
    for (std::size_t d = 0; d < 3; ++d)
        result.axes[d] = placed(fmt::format("[grid], axis {}", "xyz"[d]), [&] { return make_axis(grid, d); });
    return result;
}

}  // namespace hemoflux::apps
