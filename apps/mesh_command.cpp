#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>

#include "apps/case.hpp"
#include "apps/case_check.hpp"
#include "apps/cell_builder.hpp"
#include "apps/cell_file.hpp"
#include "apps/cell_options.hpp"
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
    CellOptions cell;
    std::string area, reduced_volume, file;
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

/// The case that the options describe; equal springs would print the icosphere's pattern on the disc, so the
/// spheroid is the reference unless another is asked for.
Case case_of(const RbcArguments& in) {
    std::vector<std::string> sets;
    if (in.cell.file.empty()) sets.emplace_back("cell.0.reference=spheroid");
    if (!in.area.empty()) sets.push_back("cell.0.area=" + in.area);
    if (!in.reduced_volume.empty()) sets.push_back("cell.0.reduced_volume=" + in.reduced_volume);
    const std::vector<std::string> rest = in.cell.overrides();
    sets.insert(sets.end(), rest.begin(), rest.end());
    Case c = parse_case("title = \"mesh rbc\"\nkind = \"membrane\"\n[[cell]]\n", "hemoflux mesh rbc",
                        std::filesystem::current_path(), sets);
    check_case(c);
    return c;
}

void make_rbc_file(const RbcArguments& in) {
    const membrane::Cell cell = build_cell(case_of(in).cells.front());
    const meshing::SurfaceMesh mesh{cell.positions, cell.topology->triangles()};
    if (std::filesystem::path(in.file).extension() == ".vtp") {
        write_cell(in.file, *cell.topology, cell.reference, cell.positions);
    } else if (!in.file.empty()) {
        meshing::write_surface(in.file, mesh);
    }
    const meshing::SurfaceQuality quality = meshing::quality(mesh);
    fmt::print("nodes            {}\ntriangles        {}\nedges            {} (Euler characteristic {})\n",
               mesh.vertices.size(), mesh.triangles.size(), quality.edges, quality.euler_characteristic);
    fmt::print("nodes by edges   {}\n", quality.valences);
    fmt::print("edge length      {:.6g} (mean {:.6g}) .. {:.6g} um\nsmallest angle   {:.4g} degrees\n",
               quality.shortest_edge, quality.mean_edge, quality.longest_edge, quality.smallest_angle);
    fmt::print("area             {:.6g} um^2\nvolume           {:.6g} um^3\nreduced volume   {:.6g}\n",
               meshing::area(mesh), meshing::volume(mesh), meshing::reduced_volume(mesh));
    const membrane::Reference& r = cell.reference;
    fmt::print("references       A0 {:.6g} um^2, V0 {:.6g} um^3, C_0 {:.6g} 1/um, M0 {:.6g} um, r {:.4g}\n",
               r.area, r.volume, r.curvature, r.total_curvature, r.stretch_ratio);
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

    CLI::App* rbc = mesh->add_subcommand(
        "rbc",
        "Red blood cell: mesh, reference, relaxed shape. A .vtp file carries the references too, so that "
        "later runs start from it");
    const auto r = std::make_shared<RbcArguments>();
    add_cell_options(*rbc, r->cell);
    rbc->add_option("--area", r->area, "A0 with its unit [134 um^2]");
    rbc->add_option("--reduced-volume", r->reduced_volume, "Of the shape spheroid [0.642]");
    rbc->add_option("--output,-o", r->file, "File to write (.vtp; without references .ply, .stl or .obj)");
    rbc->footer(
        "Examples: hemoflux mesh rbc --nodes 2562 --output rbc.vtp\n"
        "          hemoflux mesh rbc --reference stress-free --route deflation --shear-modulus \"4 uN/m\" -o "
        "disc.vtp\n"
        "          hemoflux mesh rbc --file own.stl --reference uniform -o own.vtp\n"
        "          hemoflux membrane stretch --file rbc.vtp --forces \"100 pN\"");
    rbc->callback([r] { make_rbc_file(*r); });

    add_mesh_hex_command(*mesh);
}

}  // namespace hemoflux::apps
