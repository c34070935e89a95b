#include "apps/case_flow.hpp"

#include <algorithm>

#include "apps/choice.hpp"
#include "apps/units.hpp"

namespace hemoflux::apps {

FluidInput read_fluid(const Section& in, bool sheared) {
    FluidInput fluid;
    fluid.density = in.number("density");
    fluid.viscosity = in.number("viscosity");
    const std::string initial = in.text("initial");
    if (initial == "analytical")
        fluid.initial = InitialFlow::analytical;
    else if (initial == "channel")
        fluid.initial = InitialFlow::channel;
    else if (initial == "inflow")
        fluid.initial = InitialFlow::inflow;
    else if (initial == "shear" || (initial == "auto" && sheared))
        fluid.initial = InitialFlow::shear;
    else if (initial == "uniform") {
        fluid.initial = InitialFlow::uniform;
        const std::vector<double> velocity = in.numbers("initial_velocity");
        std::copy(velocity.begin(), velocity.end(), fluid.initial_velocity.begin());
    }
    return fluid;
}

GridInput read_grid(const Section& in) {
    GridInput grid;
    const std::vector<std::string> kinds = in.texts("kind");
    const std::vector<double> length = in.numbers("length");
    const std::vector<double> cells = in.numbers("cells");
    if (const auto plateau = in.table("plateau")) {
        grid.plateau_a = plateau->number("a");
        grid.plateau_b = plateau->number("b");
    }
    const auto faces = in.table("faces");
    const double scale = faces ? conversion(faces->text("unit"), "um") : 1.0;
    for (std::size_t d = 0; d < 3; ++d) {
        grid.kind[d] = chosen<AxisKind>(kinds[kinds.size() == 3 ? d : 0],
                                        {"uniform", "plateau", "chebyshev", "explicit"});
        if (grid.kind[d] == AxisKind::given) {
            grid.faces[d] = faces ? faces->numbers(std::string(1, "xyz"[d])) : std::vector<double>();
            for (double& face : grid.faces[d]) {
                face *= scale;
            }
        } else if (!length.empty() && !cells.empty()) {
            grid.length[d] = length[d];
            grid.cells[d] = static_cast<int>(cells[d]);
            grid.lower[d] = in.text("origin") == "corner" ? 0.0 : -length[d] / 2;
        }
    }
    return grid;
}

PatchInput read_patch(const Section& in) {
    PatchInput patch;
    if (in.has("periodic")) {
        patch.partner = in.text("periodic");
        return patch;
    }
    const std::vector<double> vector = in.numbers("velocity");
    if (!vector.empty()) {
        patch.velocity = VelocityCondition::vector;
        patch.vector = in.vector("velocity");
    } else {
        patch.velocity = chosen<VelocityCondition>(
            in.text("velocity"),
            {"periodic", "shear", "no-slip", "zero-gradient", "symmetry", "parabolic", "expression"});
    }
    const std::string text = in.text("density");
    if (const auto value = in.maybe("density")) {
        patch.density = text.empty() ? DensityCondition::density : DensityCondition::pressure;
        patch.value = *value;
    } else {
        patch.density = chosen<DensityCondition>(text, {"zero-gradient", "gradient", "expression"});
        patch.value = in.maybe("pressure_gradient").value_or(0);
        patch.pressure_expression = in.text("pressure_expression");
    }
    patch.speed = in.maybe("speed").value_or(0);
    if (const auto texts = in.texts("velocity_expression"); texts.size() == 3) {
        std::copy(texts.begin(), texts.end(), patch.velocity_expression.begin());
    }
    return patch;
}

MeshInput read_mesh(const Section& in) {
    MeshInput mesh;
    mesh.kind = in.text("kind");
    mesh.file = in.text("file");
    mesh.unit = conversion(in.text("unit"), "um");
    mesh.size = in.maybe("size").value_or(0);
    for (const char* key : {"cells", "wall", "radius", "thickness", "first_height", "scale", "wake", "length",
                            "depth", "throat", "throat_length"})
        if (const auto value = in.maybe(key)) mesh.values[key] = *value;
    return mesh;
}

std::map<std::string, PatchInput> read_patches(const Section& in) {
    std::map<std::string, PatchInput> patches;
    for (const std::string& key : in.keys()) {
        const auto table = in.table(key);
        PatchInput patch = table ? read_patch(*table) : PatchInput{};
        const bool both = key == "x" || key == "y" || key == "z";
        if (!both) {
            if (patch.periodic() && patch.partner.empty() &&
                key.size() == 2)  // the word "periodic" for a side
                patch.partner = std::string(1, key[0]) + (key[1] == '-' ? '+' : '-');
            patches[key] = patch;
            continue;
        }
        for (const char side : {'-', '+'}) {
            patch.partner = patch.periodic() ? key + (side == '-' ? '+' : '-') : "";
            patches[key + side] = patch;
        }
    }
    return patches;
}

SteadyInput read_steady(const Section& in) {
    return {chosen<SteadyMethod>(in.text("method"), {"implicit", "local-steps"}),
            chosen<SteadyCriterion>(in.text("criterion"), {"momentum", "residual", "velocity-change"}),
            in.number("tolerance"),
            in.integer("iterations"),
            in.number("sigma"),
            in.number("viscous_weight"),
            in.text("start")};
}

BodyForceInput read_body_force(const Section& in) {
    BodyForceInput force;
    if (in.has("acceleration")) force.acceleration = in.vector("acceleration");
    if (in.has("amplitude")) force.amplitude = in.vector("amplitude");
    force.period = in.maybe("period").value_or(0);
    force.phase = in.number("phase");
    return force;
}

AnalyticalInput read_analytical(const Section& in) {
    return {
        chosen<ExactSolution>(in.text("solution"), {"couette", "poiseuille", "taylor-green", "womersley"}),
        in.maybe("speed").value_or(0), in.numbers("times")};
}

SweepInput read_sweep(const Section& in, const toml::table& listed) {
    SweepInput sweep;
    std::vector<std::pair<toml::source_position, std::string>> keys;
    for (const auto& [key, list] : listed) keys.emplace_back(key.source().begin, std::string(key.str()));
    std::sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
        return a.first.line != b.first.line ? a.first.line < b.first.line : a.first.column < b.first.column;
    });
    for (const auto& [position, key] : keys) {
        sweep.keys.push_back(key);
        std::vector<std::string>& texts = sweep.values.emplace_back();
        for (const toml::node& item : *listed[key].as_array()) texts.push_back(value_text(item));
    }
    const std::string log = in.text("log");
    sweep.product = in.text("combine") == "product";
    sweep.observables = in.texts("observables");
    sweep.order = in.texts("order");
    sweep.extrapolate = in.texts("extrapolate");
    if (const auto range = in.numbers("order_range"); !range.empty())
        sweep.order_range = {range[0], range[1]};
    sweep.difference = in.flag("difference_from_last");
    for (const Section& m : in.tables("measured"))
        sweep.measured.push_back({m.text("file"), m.text("x"), m.text("y"), m.text("label")});
    sweep.log_x = log == "x" || log == "both";
    sweep.log_y = log == "y" || log == "both";
    return sweep;
}

}  // namespace hemoflux::apps
