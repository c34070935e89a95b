// Surface, mesh and checkpoint files that are spoilt; see bad_input_test.cpp.
#include "tests/apps/bad_input.hpp"

namespace hemoflux::apps {
namespace {

/// A tetrahedron, or what is made of it.
struct Vtp {
    std::string points = "4", polys = "4", coordinates = "0 0 0 1 0 0 0 1 0 0 0 1",
                triangles = "0 2 1 0 1 3 0 3 2 1 2 3", offsets = "3 6 9 12", type = "PolyData";
    [[nodiscard]] std::string text() const {
        return "<VTKFile type=\"" + type +
               "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">" +
               "<PolyData><Piece NumberOfPoints=\"" + points + "\" NumberOfPolys=\"" + polys +
               "\"><Points><DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
               "format=\"ascii\">" +
               coordinates +
               "</DataArray></Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" "
               "format=\"ascii\">" +
               triangles + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
               offsets + "</DataArray></Polys></Piece></PolyData></VTKFile>\n";
    }
};

TEST_F(BadInput, SurfaceFiles) {
    const auto file = [](const std::string& name, const std::string& content,
                         const std::vector<std::string>& parts) {
        std::vector<std::string> all{name};
        all.insert(all.end(), parts.begin(), parts.end());
        return Bad{cell_with("mesh = \"icosphere\"", "file = \"" + name + "\""), all, 2, name, content};
    };
    const auto vtp = [&](const Vtp& v, const std::string& part) { return file("a.vtp", v.text(), {part}); };
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty "
        "double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
        "0\n1 1 0\n";
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    expect_refused({
        file("a.xyz", "1 2 3", {"\".xyz\" is not known", ".ply"}),
        file("a.vtp", "", {"empty"}),
        file("a.vtp", "garbage", {"<VTKFile"}),
        file("a.vtp", Vtp().text().substr(0, 200), {"malformed"}),
        vtp({.type = "UnstructuredGrid"}, "not a VTKFile of type PolyData"),
        vtp({}, "42"),  // sound, but no cell
        vtp({.points = "99999999999999"}, "more than its bytes can hold"),
        vtp({.points = "-5"}, "NumberOfPoints"),
        vtp({.polys = "300000000"}, "more than its bytes can hold"),
        vtp({.coordinates = "nan 0 0 1 0 0 0 1 0 0 0 1"}, "vertex 0"),
        vtp({.triangles = "0 2 9 0 1 3 0 3 2 1 2 3"}, "vertex 9 of 4"),
        vtp({.triangles = "0 2 -9 0 1 3 0 3 2 1 2 3"}, "vertex -9 of 4"),
        vtp({.polys = "3", .offsets = "4 8 12"}, "4 corners"),
        vtp({.offsets = "3 2 9 1000000"}, "offsets"),
        file("a.ply", "plx\n", {"PLY"}),
        file("a.ply", ply, {"breaks off"}),
        file("a.ply", ply + "0 1 0\n4 0 1 2 3\n", {"4 corners"}),
        file("a.ply", ply + "0 1 0\n3 0 1 7\n", {"beyond the 4"}),
        file("a.stl", "xx", {"\"solid\""}),
        file("a.stl", "solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n", {"malformed"}),
        file("a.obj", corners + "f 1 2 9\n", {"malformed"}),
        file("a.obj", "v 1 2\nf 1 2 3\n", {"malformed"}),
    });
}

TEST_F(BadInput, MeshFiles) {
    const auto on_mesh = [](const std::string& name) {
        return "title = \"Mesh\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\nmesh = { kind "
               "= \"file\", file = \"" +
               name +
               "\", unit = \"um\" }\n[boundary]\nlid = { velocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"] }\n"
               "[time]\nduration = \"1 us\"\n";
    };
    const auto file = [&](const std::string& name, const std::string& content, const std::string& part) {
        return Bad{on_mesh(name), {name, part}, 2, name, content};
    };
    const std::string nodes = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n";
    const auto msh = [&](const std::string& count, const std::string& elements) {
        return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + count + "\n" + nodes +
               "$EndNodes\n$Elements\n" + elements + "\n$EndElements\n";
    };
    const std::string cube = "1\n1 5 2 1 1 1 2 3 4 5 6 7 8";
    const auto vtu = [](const std::string& points, const std::string& nodes_of, const std::string& offset,
                        const std::string& type) {
        return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt64\">"
               "<UnstructuredGrid><Piece NumberOfPoints=\"" +
               points +
               "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
               "format=\"ascii\">0 0 0 "
               "1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points><Cells><DataArray "
               "type=\"Int64\" "
               "Name=\"connectivity\" format=\"ascii\">" +
               nodes_of + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
               offset + "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + type +
               "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
    };
    const std::string eight = "0 1 2 3 4 5 6 7";
    expect_refused({
        file("a.msh", "", "$MeshFormat"),
        file("a.msh", "SystemCall \"touch out\";\n", "$MeshFormat"),  // gmsh would run it
        file("a.msh", "$MeshFormat\n9.9 0 8\n$EndMeshFormat\n", "version 9.9"),
        file("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "$Nodes"),
        file("a.msh", msh("8", cube).substr(0, 100), "$Nodes"),
        file("a.msh", msh("99999999999", cube), "more than the file holds"),
        file("a.msh", msh("9", cube), "breaks off"),
        file("a.msh", msh("8", "1\n1 5 2 1 1 1 2 3 4 5 6 7 88"), "names node 88"),
        file("a.msh", msh("8", "1\n1 4 2 1 1 1 2 3 5"), "Tetrahedron"),
        file("a.msh", msh("8", "1\n1 99 2 1 1 1 2 3 5"), "type 99"),
        file("a.vtu", "", "<VTKFile"),
        file("a.vtu", Vtp().text(), "UnstructuredGrid"),
        file("a.vtu", vtu("99999999999", eight, "8", "12"), "more than its bytes can hold"),
        file("a.vtu", vtu("8", "0 1 2 3 4 5 6 77", "8", "12"), "node 77 of 8"),
        file("a.vtu", vtu("8", "0 1 2 4", "4", "12"), "4 nodes instead of 8"),
        file("a.vtu", vtu("8", "0 1 2 4", "4", "10"), "VTK type 10"),
        file("a.stl", "x", "\".stl\" is not known"),
        file("a.msh", msh("8", cube), "in no patch"),
        {on_mesh("none.msh"), {"none.msh"}, 4},
    });
}

}  // namespace
}  // namespace hemoflux::apps
