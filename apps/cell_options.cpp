#include "apps/cell_options.hpp"

namespace hemoflux::apps {
namespace {

struct Option {
    const char *name, *key;
    std::string CellOptions::*value;
    const char* meaning;
};

const Option options_of_a_cell[] = {
    {"--nodes", "nodes", &CellOptions::nodes,
     "Nodes of the icosphere: 42, 162, 642, 2562, 10242, 40962 [2562]"},
    {"--mesh", "mesh", &CellOptions::mesh, "Mesh file of a sphere, in place of the icosphere"},
    {"--file", "file", &CellOptions::file,
     "Closed surface (.vtp, .ply, .stl, .obj; um) that gives mesh and shape, and its references where the "
     "file holds them"},
    {"--shape", "shape", &CellOptions::shape, "discocyte, sphere, spheroid or evans-fung [discocyte]"},
    {"--route", "route", &CellOptions::route, "Way to the discocyte: evans-fung or deflation [evans-fung]"},
    {"--reference", "reference", &CellOptions::reference,
     "stress-free, uniform, coarse-grained, spheroid, file or stored [uniform; of a file its own]"},
    {"--reference-file", "reference_file", &CellOptions::reference_file,
     "Shape of the reference \"file\", with the cell's triangles"},
    {"--law", "law", &CellOptions::law, "wlc, wlc-power, wlc-hydrostatic, neo-hookean or skalak [wlc]"},
    {"--bending", "bending_scheme", &CellOptions::bending, "juelicher or gompper-kroll [juelicher]"},
    {"--shear-modulus", "shear_modulus", &CellOptions::shear_modulus, "K_S with its unit [6.1 uN/m]"},
    {"--spontaneous-curvature", "spontaneous_curvature", &CellOptions::spontaneous_curvature,
     "c0, C_0 in units of 1/R0 [6]"},
    {"--area-difference", "relaxed_area_difference", &CellOptions::area_difference,
     "M0 in units of 8 pi R0 [1]"},
};

}  // namespace

std::vector<std::string> CellOptions::overrides() const {
    std::vector<std::string> all;
    for (const Option& option : options_of_a_cell)
        if (const std::string& value = this->*option.value; !value.empty())
            all.push_back(std::string("cell.0.") + option.key + "=" + value);
    all.insert(all.end(), sets.begin(), sets.end());
    return all;
}

void add_cell_options(CLI::App& command, CellOptions& options) {
    for (const Option& option : options_of_a_cell)
        command.add_option(option.name, options.*option.value, option.meaning);
    command.add_option("--set", options.sets, "Any other key of a case: table.key=value")
        ->allow_extra_args(false);
}

}  // namespace hemoflux::apps
