#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "apps/case.hpp"
#include "apps/cell_builder.hpp"
#include "apps/cell_surface.hpp"
#include "apps/commands.hpp"
#include "apps/output/vtk_writer.hpp"
#include "apps/units.hpp"
#include "exchange/error.hpp"
#include "meshing/surface_io.hpp"

namespace hemoflux::apps {
namespace {

struct GridArguments {
    std::vector<std::string> kinds{"uniform"};
    std::vector<std::string> lengths{"12 um"};
    std::vector<int> cells{30};
    std::vector<double> plateau{10, 0.2};
    bool corner = false;
    std::string file;
};

struct RbcArguments {
    std::string shape = "discocyte";
    int nodes = 2562;
    std::string area = "134 um^2";
    double reduced_volume = 0.642;
    std::string file;
};

/// Value of axis d from one value for all axes or three.
template <class T>
const T& per_axis(const std::vector<T>& values, std::size_t d, const char* option) {
    if (values.size() != 1 && values.size() != 3) {
        throw InputError(fmt::format("{} has {} values", option, values.size()), "a grid has three axes",
                         "Give one value for all axes, or three");
    }
    return values[values.size() == 1 ? 0 : d];
}

void make_grid_file(const GridArguments& in) {
    GridInput input;
    input.plateau_a = in.plateau[0];
    input.plateau_b = in.plateau[1];
    for (std::size_t d = 0; d < 3; ++d) {
        const std::string& kind = per_axis(in.kinds, d, "--kind");
        input.kind[d] = kind == "plateau"     ? AxisKind::plateau
                        : kind == "chebyshev" ? AxisKind::chebyshev
                                              : AxisKind::uniform;
        input.length[d] = quantity(per_axis(in.lengths, d, "--length"), "um");
        input.cells[d] = per_axis(in.cells, d, "--cells");
        input.lower[d] = in.corner ? 0.0 : -input.length[d] / 2;
    }
    const meshing::RectilinearGrid grid = make_grid(input);
    if (!in.file.empty()) {
        output::DataArray volume{"cell_volume_um3", 1, {}};
        for (const double dz : grid.axes[2].widths()) {
            for (const double dy : grid.axes[1].widths()) {
                for (const double dx : grid.axes[0].widths()) {
                    volume.values.push_back(dx * dy * dz);
                }
            }
        }
        output::write_fluid(in.file, grid.axes, {volume}, 0.0);
    }
    fmt::print("cells     {} x {} x {} = {}\n", grid.axes[0].cells(), grid.axes[1].cells(),
               grid.axes[2].cells(), grid.cells());
    for (std::size_t d = 0; d < 3; ++d) {
        const meshing::Axis& axis = grid.axes[d];
        fmt::print("axis {}    {:.6g} .. {:.6g} um, cells of {:.6g} .. {:.6g} um, growth {:.4g}\n", "xyz"[d],
                   axis.lower(), axis.upper(), axis.smallest(), axis.largest(), axis.growth());
    }
    if (!in.file.empty()) {
        fmt::print("written   {}\n", in.file);
    }
}

/// A cell with every key at its default.
CellInput standard_cell() {
    return parse_case("title = \"\"\nkind = \"membrane\"\n[[cell]]\n").cells.front();
}

void make_rbc_file(const RbcArguments& in) {
    CellInput cell = standard_cell();
    cell.reference =
        MembraneReference::spheroid;  // the disc; equal springs would print the icosphere's pattern on it
    cell.nodes = in.nodes;
    cell.area = quantity(in.area, "um^2");
    cell.volume *= std::pow(cell.area / standard_cell().area, 1.5);  // the same shape at another size
    cell.reduced_volume = in.reduced_volume;
    cell.shape = in.shape == "sphere"       ? CellShape::sphere
                 : in.shape == "spheroid"   ? CellShape::spheroid
                 : in.shape == "evans-fung" ? CellShape::evans_fung
                                            : CellShape::discocyte;
    meshing::SurfaceMesh mesh = start_shape(cell);
    if (cell.shape == CellShape::discocyte) {
        mesh.vertices = build_cell(cell).positions;
    }
    if (!in.file.empty()) {
        meshing::write_surface(in.file, mesh);
    }
    const meshing::SurfaceQuality quality = meshing::quality(mesh);
    fmt::print("nodes            {}\ntriangles        {}\nedges            {}\n", mesh.vertices.size(),
               mesh.triangles.size(), quality.edges);
    fmt::print("edge length      {:.6g} (mean {:.6g}) .. {:.6g} um\nsmallest angle   {:.4g} degrees\n",
               quality.shortest_edge, quality.mean_edge, quality.longest_edge, quality.smallest_angle);
    fmt::print("area             {:.6g} um^2\nvolume           {:.6g} um^3\nreduced volume   {:.6g}\n",
               meshing::area(mesh), meshing::volume(mesh), meshing::reduced_volume(mesh));
    if (!in.file.empty()) {
        fmt::print("written          {}\n", in.file);
    }
}

}  // namespace

void add_mesh_command(CLI::App& program) {
    CLI::App* mesh =
        program.add_subcommand("mesh", "Make a grid or a cell surface, and print its sizes and quality");
    mesh->require_subcommand(1);
    mesh->footer("Example: hemoflux mesh rbc --nodes 642 --output rbc.vtp");

    CLI::App* grid =
        mesh->add_subcommand("grid", "Rectilinear grid; options take one value, or one per axis");
    grid->option_defaults()->always_capture_default();
    const auto g = std::make_shared<GridArguments>();
    grid->add_option("--kind", g->kinds, "uniform, plateau or chebyshev")
        ->check(CLI::IsMember({"uniform", "plateau", "chebyshev"}));
    grid->add_option("--length", g->lengths, "Size of the box with its unit");
    grid->add_option("--cells", g->cells, "Number of cells");
    grid->add_option("--plateau", g->plateau, "Half-width a (cells) and steepness b of plateau axes")
        ->expected(2);
    grid->add_flag("--corner", g->corner, "Put the origin into the lower corner instead of the centre");
    grid->add_option("--output,-o", g->file, "File to write (.vtr)");
    grid->footer(
        "Example: hemoflux mesh grid --kind plateau --length \"12 um\" --cells 30 --plateau 10 0.2 -o "
        "grid.vtr");
    grid->callback([g] { make_grid_file(*g); });

    CLI::App* rbc = mesh->add_subcommand("rbc", "Surface of a red blood cell on an icosphere");
    rbc->option_defaults()->always_capture_default();
    const auto r = std::make_shared<RbcArguments>();
    rbc->add_option("--nodes", r->nodes, "42, 162, 642, 2562, 10242 or 40962");
    rbc->add_option("--shape", r->shape, "discocyte (relaxed), evans-fung, spheroid or sphere")
        ->check(CLI::IsMember({"discocyte", "evans-fung", "spheroid", "sphere"}));
    rbc->add_option("--area", r->area, "Area with its unit");
    rbc->add_option("--reduced-volume", r->reduced_volume, "Of the spheroid");
    rbc->add_option("--output,-o", r->file, "File to write (.vtp, .ply, .stl or .obj)");
    rbc->footer("Example: hemoflux mesh rbc --nodes 2562 --shape evans-fung --output rbc.vtp");
    rbc->callback([r] { make_rbc_file(*r); });
}

}  // namespace hemoflux::apps
