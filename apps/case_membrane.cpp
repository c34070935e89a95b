#include "apps/case_membrane.hpp"

#include "apps/choice.hpp"

namespace hemoflux::apps {
namespace {

/// The key "contact": a diameter, whose text is kept, or a part of the nodes.
membrane::Grip read_grip(const Section& in) {
    if (in.text("contact").empty()) return {.fraction = in.number("contact")};
    return {.contact_diameter = in.number("contact")};
}

}  // namespace

CellInput read_cell(const Section& in) {
    CellInput cell;
    cell.name = in.text("name");
    cell.mesh = in.text("mesh");
    cell.nodes = in.integer("nodes");
    cell.file = in.text("file");
    cell.shape = in.has("file")
                     ? CellShape::file
                     : chosen<CellShape>(in.text("shape"), {"discocyte", "sphere", "spheroid", "evans-fung"});
    cell.reduced_volume = in.number("reduced_volume");
    cell.route = chosen<membrane::Route>(in.text("route"), {"evans-fung", "deflation"});
    cell.reference = chosen<MembraneReference>(
        in.text("reference"),
        {"stress-free", "uniform", "coarse-grained", "spheroid", "file", "stored", "auto"});
    cell.reference_file = in.text("reference_file");
    cell.reference_reduced_volume = in.number("reference_reduced_volume");
    cell.law = chosen<membrane::InPlaneLaw>(in.text("law"),
                                            {"wlc", "wlc-power", "wlc-hydrostatic", "neo-hookean", "skalak"});
    cell.skalak_ratio = in.number("skalak_ratio");
    cell.bending_scheme =
        chosen<membrane::BendingScheme>(in.text("bending_scheme"), {"juelicher", "gompper-kroll"});
    cell.camber = in.number("camber");
    cell.shear_modulus = in.number("shear_modulus");
    cell.spring_length = in.maybe("spring_length");
    cell.spring_ratio = in.maybe("spring_ratio");
    cell.volume_modulus = in.number("volume_modulus");
    cell.area_modulus = in.number("area_modulus");
    cell.local_area_modulus = in.number("local_area_modulus");
    cell.bending_modulus = in.number("bending_modulus");
    cell.ade_modulus = in.number("ade_modulus");
    cell.spontaneous_curvature = in.maybe("spontaneous_curvature");
    cell.relaxed_area_difference = in.maybe("relaxed_area_difference");
    cell.membrane_viscosity = in.number("membrane_viscosity");
    cell.area = in.maybe("area");
    cell.volume = in.maybe("volume");
    cell.cytosol_viscosity = in.number("cytosol_viscosity");
    cell.position = in.vector("position");
    cell.axis = in.vector("axis");
    return cell;
}

TweezersInput read_tweezers(const Section& in) {
    return {in.number("force"), read_grip(in), in.number("tolerance")};
}

MembraneInput read_membrane(const Section& in) {
    MembraneInput m;
    m.task = chosen<MembraneTask>(in.text("task"),
                                  {"relax", "stretch", "shapes", "moduli", "relax-back", "calibrate"});
    m.forces = in.numbers("forces");
    m.grip = read_grip(in);
    m.dynamic = in.text("solver") == "dynamic";
    m.fluid_viscosity = in.number("fluid_viscosity");
    m.duration = in.number("duration");
    m.experiment = in.text("experiment");
    m.recovery = in.texts("recovery");
    m.curvatures = in.numbers("curvatures");
    m.area_differences = in.numbers("area_differences");
    m.refine = in.flag("refine");
    const std::vector<double> shear = in.numbers("shear_bounds"), curvature = in.numbers("curvature_bounds");
    m.shear_bounds = {shear.at(0), shear.at(1)};
    m.curvature_bounds = {curvature.at(0), curvature.at(1)};
    m.tolerance = in.number("tolerance");
    return m;
}

}  // namespace hemoflux::apps
