#include "meshing/hex_io.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "exchange/error.hpp"
#include "meshing/hex_box.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::meshing {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
class HexIo : public testing::Test {
  protected:
    HexIo() {
        std::string pattern = (fs::temp_directory_path() / "hemoflux_hex_io_XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }
    ~HexIo() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    static std::string refusal(const fs::path& path) {
        try {
            read_hex_mesh(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    fs::path folder_;
};

void expect_mentions(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << '"' << message << "\" lacks \"" << part << '"';
}

TEST_F(HexIo, RoundTripsKeepEveryBit) {
    const HexMesh mesh = box_mesh({0, 0, 0}, {1, 2, 0.3}, {5, 4, 3}, {.random = 0.3, .shuffle = true});
    for (const char* name : {"box.msh", "box.vtu", "Box.VTU"}) {
        write_hex_mesh(folder_ / name, mesh);
        const HexMesh back = read_hex_mesh(folder_ / name);
        EXPECT_EQ(back.cells, mesh.cells) << name;
        ASSERT_EQ(back.nodes.size(), mesh.nodes.size());
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            EXPECT_EQ(back.nodes[i].x, mesh.nodes[i].x);
            EXPECT_EQ(back.nodes[i].y, mesh.nodes[i].y);
            EXPECT_EQ(back.nodes[i].z, mesh.nodes[i].z);
        }
        ASSERT_EQ(back.patches.size(), 6U);
        for (std::size_t p = 0; p < 6; ++p) {
            EXPECT_EQ(back.patches[p].name, mesh.patches[p].name);
            EXPECT_EQ(back.patches[p].faces, mesh.patches[p].faces);
        }
        EXPECT_EQ(make_hex_grid(back).volume, make_hex_grid(mesh).volume);
    }
}

TEST_F(HexIo, LengthsAreScaled) {
    write_hex_mesh(folder_ / "box.msh", box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
    const HexGrid grid = make_hex_grid(read_hex_mesh(folder_ / "box.msh", 1e3));
    EXPECT_DOUBLE_EQ(grid.volume[0], 1e9);
    EXPECT_THROW(read_hex_mesh(folder_ / "box.msh", -1), InputError);
}

// One hexahedron in MSH 4.1 as text, with a node of no cell and one unnamed group.
constexpr const char* header = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
constexpr const char* entities =
    "$Entities\n0 0 2 1\n"
    "1 0 0 0 1 1 0 1 7 0\n2 0 0 0 1 1 1 1 9 0\n"
    "1 0 0 0 1 1 1 1 3 0\n"
    "$EndEntities\n";
constexpr const char* nodes =
    "$Nodes\n1 9 10 90\n3 1 0 9\n10\n20\n30\n40\n50\n60\n70\n80\n90\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n5 5 5\n$EndNodes\n";

TEST_F(HexIo, ReadsMshAsTextWithNamedAndUnnamedGroups) {
    const std::string names = "$PhysicalNames\n2\n2 7 \"floor of it\"\n3 3 \"fluid\"\n$EndPhysicalNames\n";
    const std::string elements =
        "$Elements\n3 3 1 3\n2 1 3 1\n1 10 20 30 40\n2 2 3 1\n2 50 60 70 80\n"
        "3 1 5 1\n3 10 20 30 40 50 60 70 80\n$EndElements\n";
    const HexMesh mesh =
        read_hex_mesh(write("one.msh", std::string(header) + names + entities + nodes + elements));
    EXPECT_EQ(mesh.nodes.size(), 8U);
    ASSERT_EQ(mesh.cells.size(), 1U);
    EXPECT_EQ(mesh.cells[0], (std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7}));
    ASSERT_EQ(mesh.patches.size(), 2U);
    EXPECT_EQ(mesh.patches[0].name, "floor of it");
    EXPECT_EQ(mesh.patches[1].name, "9");
    EXPECT_EQ(mesh.patches[1].faces[0], (std::array<std::uint32_t, 4>{4, 5, 6, 7}));
    try {
        make_hex_grid(mesh);
        FAIL();
    } catch (const InputError& error) {
        expect_mentions(error.what(), "4 border faces are in no patch");
    }
}

TEST_F(HexIo, RefusesOtherElementsAndBrokenFiles) {
    const std::string start = std::string(header) + entities + nodes;
    expect_mentions(
        refusal(write("tet.msh", start + "$Elements\n1 1 1 1\n3 1 4 1\n1 10 20 30 50\n$EndElements\n")),
        "1 elements of type Tetrahedron 4");
    expect_mentions(refusal(write("tri.msh", start + "$Elements\n2 2 1 2\n2 1 2 1\n1 10 20 30\n3 1 5 1\n"
                                                     "2 10 20 30 40 50 60 70 80\n$EndElements\n")),
                    "patch \"7\" holds 1 elements of type Triangle 3");
    expect_mentions(
        refusal(write("flat.msh", start + "$Elements\n1 1 1 1\n2 1 3 1\n1 10 20 30 40\n$EndElements\n")),
        "no hexahedra");
    EXPECT_NE(refusal(write("text.msh", "this is no mesh\n")), "");
    EXPECT_NE(refusal(write("text.vtu", "this is no mesh\n")), "");
    expect_mentions(refusal(write("box.stl", "")), "Use .msh (gmsh) or .vtu (VTK)");
    EXPECT_THROW(read_hex_mesh(folder_ / "absent.msh"), FileError);
    EXPECT_THROW(read_hex_mesh(folder_ / "absent.vtu"), FileError);
    EXPECT_THROW(write_hex_mesh(folder_ / "absent" / "box.msh", box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1})),
                 FileError);
}

std::string vtu(const std::string& types, const std::string& arrays) {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid>"
           "<Piece NumberOfPoints=\"8\" NumberOfCells=\"2\"><Points>"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
           "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points><Cells>"
           "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 7 0 1 2 "
           "3</DataArray>"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">8 12</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
           types + "</DataArray></Cells>" + arrays + "</Piece></UnstructuredGrid></VTKFile>\n";
}

TEST_F(HexIo, ReadsVtuWithNumberedPatchesAndRefusesOtherCells) {
    const std::string physical =
        "<CellData><DataArray type=\"Int32\" Name=\"gmsh:physical\" format=\"ascii\">0 "
        "4</DataArray></CellData>";
    const HexMesh mesh = read_hex_mesh(write("quad.vtu", vtu("12 9", physical)));
    ASSERT_EQ(mesh.patches.size(), 1U);
    EXPECT_EQ(mesh.patches[0].name, "4");
    EXPECT_EQ(mesh.patches[0].faces[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
    expect_mentions(refusal(write("bare.vtu", vtu("12 9", ""))), "no cell array \"patch\"");
    expect_mentions(refusal(write("tet.vtu", vtu("12 10", physical))), "cell 1 is of VTK type 10");
}

}  // namespace
}  // namespace hemoflux::meshing
