#include "apps/mesh_case.hpp"

#include <cmath>

#include "apps/prefix.hpp"
#include "meshing/hex_cavity.hpp"
#include "meshing/hex_cylinder.hpp"
#include "meshing/hex_io.hpp"
#include "meshing/hex_pipe.hpp"

namespace hemoflux::apps {

meshing::HexMesh make_mesh(const MeshInput& in) {
    if (in.kind == "file") return meshing::read_hex_mesh(in.file, in.unit);
    const auto given = [&](const char* key, double standard) {
        const auto found = in.values.find(key);
        return found == in.values.end() ? standard : found->second;
    };
    const auto cells = [&](int standard) { return static_cast<int>(std::lround(given("cells", standard))); };
    if (in.kind == "cube") {
        meshing::CavityShape s;
        s.edge = in.size;
        s.cells = cells(s.cells);
        s.wall = given("wall", s.wall);
        return cavity_mesh(s);
    }
    if (in.kind == "cylinder") {
        meshing::CylinderShape s;
        s.diameter = in.size;
        s.cells = cells(s.cells);
        s.radius = given("radius", s.radius);
        s.thickness = given("thickness", s.thickness);
        s.first_height = given("first_height", s.first_height);
        s.scale = given("scale", s.scale);
        s.wake = given("wake", s.wake);
        return cylinder_mesh(s);
    }
    meshing::PipeShape s;
    s.diameter = in.size;
    s.cells = cells(s.cells);
    s.wall = given("wall", s.wall);
    s.length = given("length", s.length);
    if (in.kind == "constriction") {
        s.constriction = given("depth", 0.5);
        s.throat = given("throat", s.throat);
        s.throat_length = given("throat_length", s.throat_length);
    }
    return pipe_mesh(s);
}

meshing::HexGrid make_hex_grid(const Case& c, const meshing::HexMesh& mesh) {
    std::vector<meshing::PeriodicPair> pairs;
    for (const auto& [name, patch] : c.patches)
        if (patch.periodic() && !(c.patches.contains(patch.partner) && patch.partner < name))
            pairs.push_back({name, patch.partner});
    return placed(c.mesh->file.empty() ? "grid.mesh" : "mesh file " + c.mesh->file,
                  [&] { return meshing::make_hex_grid(mesh, pairs); });
}

}  // namespace hemoflux::apps
