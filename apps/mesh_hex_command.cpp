#include <fmt/format.h>

#include <memory>

#include "apps/commands.hpp"
#include "exchange/error.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_cavity.hpp"
#include "meshing/hex_cylinder.hpp"
#include "meshing/hex_io.hpp"
#include "meshing/hex_pipe.hpp"
#include "meshing/hex_quality.hpp"

namespace hemoflux::apps {
namespace {

/// What all kinds share.
struct HexOutput {
    std::string file;
};

/// Makes a mesh, checks and reports it, then writes it; a file name that cannot be used is refused first.
template <class Make>
void finish(const Make& make, const HexOutput& out) {
    if (!out.file.empty()) meshing::check_hex_extension(out.file);
    const meshing::HexMesh mesh = make();
    const meshing::HexGrid grid = make_hex_grid(mesh);
    fmt::print("{}", report(quality(grid), "L"));
    for (const meshing::HexGrid::Patch& patch : grid.patches)
        fmt::print("{:<20} {} faces\n", "patch " + patch.name, patch.count);
    if (out.file.empty()) return;
    meshing::write_hex_mesh(out.file, mesh);
    fmt::print("written              {}\n", out.file);
}

CLI::App* add_kind(CLI::App* hex, const std::string& name, const std::string& what,
                   const std::string& example, const std::shared_ptr<HexOutput>& out) {
    CLI::App* kind = hex->add_subcommand(name, what);
    kind->option_defaults()->always_capture_default();
    kind->add_option("--output,-o", out->file, "File to write (.msh for gmsh or .vtu for ParaView)");
    kind->footer("Example: hemoflux mesh hex " + example);
    return kind;
}

void add_cube(CLI::App* hex) {
    const auto out = std::make_shared<HexOutput>();
    const auto s = std::make_shared<meshing::CavityShape>();
    CLI::App* kind =
        add_kind(hex, "cube",
                 "Cube centred at the origin, paved without rows in x-y and fine at its walls; patches x- "
                 "to z+",
                 "cube --cells 90480 -o cube.msh", out);
    kind->add_option("--edge", s->edge, "Edge of the cube");
    kind->add_option("--cells", s->cells, "Number of cells, about");
    kind->add_option("--wall", s->wall, "Width of cells at the walls over that in the middle");
    kind->callback([=] { finish([&] { return cavity_mesh(*s); }, *out); });
}

void add_cylinder(CLI::App* hex) {
    const auto out = std::make_shared<HexOutput>();
    const auto s = std::make_shared<meshing::CylinderShape>();
    CLI::App* kind =
        add_kind(hex, "cylinder",
                 "Far field around a circular cylinder along z, one cell thick; patches cylinder, inlet, "
                 "far, outlet, z-, z+",
                 "cylinder --cells 23040 --first-height 0.05 -o cylinder.msh", out);
    kind->add_option("--diameter", s->diameter, "Diameter D of the cylinder");
    kind->add_option("--radius", s->radius, "Radius of the far field in D");
    kind->add_option("--thickness", s->thickness, "Extent in z in D");
    kind->add_option("--cells", s->cells, "Number of cells, about, for a scale of 1");
    kind->add_option("--first-height", s->first_height,
                     "Height of the cells on the cylinder in D, for a scale of 1");
    kind->add_option("--scale", s->scale, "Multiplies all cell widths: 0.5 gives four times the cells");
    kind->add_option("--wake", s->wake, "How strongly cells gather in the wake, 0 to 0.9");
    kind->callback([=] { finish([&] { return cylinder_mesh(*s); }, *out); });
}

CLI::App* add_pipe_options(CLI::App* kind, const std::shared_ptr<meshing::PipeShape>& s) {
    kind->add_option("--diameter", s->diameter, "Diameter D of the pipe");
    kind->add_option("--length", s->length, "Length in D, from x = 0");
    kind->add_option("--cells", s->cells, "Number of cells, about");
    kind->add_option("--wall", s->wall, "Width of cells at the wall over that in the middle");
    return kind;
}

void add_pipes(CLI::App* hex) {
    const auto out = std::make_shared<HexOutput>();
    const auto s = std::make_shared<meshing::PipeShape>();
    CLI::App* kind = add_kind(hex, "pipe", "Straight circular pipe along x; patches inlet, outlet, wall",
                              "pipe --length 4 --cells 20000 -o pipe.msh", out);
    add_pipe_options(kind, s)->callback([=] { finish([&] { return pipe_mesh(*s); }, *out); });

    const auto narrow = std::make_shared<meshing::PipeShape>();
    narrow->constriction = 0.5;
    CLI::App* throat =
        add_kind(hex, "constriction",
                 "Circular pipe along x, smoothly narrowed by a cosine; patches inlet, outlet, wall",
                 "constriction --depth 0.5 --throat 2 --throat-length 2 -o stenosis.msh", out);
    throat->add_option("--depth", narrow->constriction, "Part of the radius that the throat takes away");
    throat->add_option("--throat", narrow->throat, "Place of the throat in D");
    throat->add_option("--throat-length", narrow->throat_length, "Length of the narrowed part in D");
    add_pipe_options(throat, narrow)->callback([=] { finish([&] { return pipe_mesh(*narrow); }, *out); });
}

struct BoxArguments {
    std::vector<double> lower{0, 0, 0}, upper{1, 1, 1};
    std::vector<int> cells{20, 20, 20};
    meshing::BoxDistortion distortion;
};

void add_box(CLI::App* hex) {
    const auto out = std::make_shared<HexOutput>();
    const auto s = std::make_shared<BoxArguments>();
    CLI::App* kind = add_kind(hex, "box", "Box of equal cells, straight or distorted; patches x- to z+",
                              "box --cells 40 40 1 --upper 2 2 0.1 --skew 0.03 -o box.vtu", out);
    kind->add_option("--lower", s->lower, "Lower corner")->expected(3);
    kind->add_option("--upper", s->upper, "Upper corner")->expected(3);
    kind->add_option("--cells", s->cells, "Number of cells along each axis")->expected(3);
    kind->add_option("--skew", s->distortion.skew,
                     "Smooth displacement of the nodes over the size of the box");
    kind->add_option("--random", s->distortion.random,
                     "Random displacement of the nodes over the width of a cell");
    kind->add_flag("--shuffle", s->distortion.shuffle, "List cells and nodes in random order");
    kind->add_option("--seed", s->distortion.seed, "Of the random numbers");
    kind->callback([=] {
        const auto corner = [](const std::vector<double>& x) { return Vec3d{x[0], x[1], x[2]}; };
        const std::array<int, 3> cells{s->cells[0], s->cells[1], s->cells[2]};
        finish([&] { return meshing::box_mesh(corner(s->lower), corner(s->upper), cells, s->distortion); },
               *out);
    });
}

struct CheckArguments {
    std::string file;
    double scale = 1;
};

void add_check(CLI::App* hex) {
    const auto out = std::make_shared<HexOutput>();
    const auto s = std::make_shared<CheckArguments>();
    CLI::App* kind =
        add_kind(hex, "check", "Checks a mesh from a file, reports its quality, and writes it again if asked",
                 "check cylinder.msh -o cylinder.vtu", out);
    kind->add_option("file", s->file, "File to read (.msh or .vtu)")->required();
    kind->add_option("--scale", s->scale, "Multiplies all lengths");
    kind->callback([=] { finish([&] { return meshing::read_hex_mesh(s->file, s->scale); }, *out); });
}

}  // namespace

void add_mesh_hex_command(CLI::App& mesh) {
    CLI::App* hex = mesh.add_subcommand("hex",
                                        "Unstructured hexahedra of a shipped geometry, with a report of "
                                        "their quality. Lengths have the unit that the "
                                        "case file gives the mesh");
    hex->require_subcommand(1);
    hex->footer("Example: hemoflux mesh hex cylinder --cells 23040 -o cylinder.msh");
    add_cube(hex);
    add_cylinder(hex);
    add_pipes(hex);
    add_box(hex);
    add_check(hex);
}

}  // namespace hemoflux::apps
