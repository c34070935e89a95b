// Files as gmsh and VTK write them are read; files that contradict themselves are refused before a library sees them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "exchange/error.hpp"
#include "meshing/hex_io.hpp"
#include "meshing/surface_io.hpp"

namespace hemoflux::meshing {
namespace {

namespace fs = std::filesystem;

/// Seeds of the fuzzers, among them files of every encoding.
const fs::path corpus = HEMOFLUX_CORPUS;

std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

class MeshFile : public testing::Test {
  protected:
    MeshFile() {
        std::string pattern = (fs::temp_directory_path() / "hemoflux_mesh_file_XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }
    ~MeshFile() override { fs::remove_all(folder_); }

    std::string refusal(const std::string& extension, const std::string& text) {
        const fs::path path = folder_ / ("a" + extension);
        std::ofstream(path, std::ios::binary) << text;
        try {
            if (extension == ".vtp")
                read_surface(path);
            else
                read_hex_mesh(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    void expect_refused(const std::string& extension, const std::string& text, const std::string& part) {
        const std::string message = refusal(extension, text);
        EXPECT_NE(message.find(part), std::string::npos) << '"' << message << "\" lacks \"" << part << '"';
    }

    fs::path folder_;
};

TEST_F(MeshFile, EveryEncodingIsRead) {
    for (const char* name : {"written_text", "written_bytes", "written_zlib", "written_lz4"}) {
        const HexMesh mesh = read_hex_mesh(corpus / "vtu" / (std::string(name) + ".vtu"));
        EXPECT_EQ(mesh.nodes.size(), 8U) << name;
        ASSERT_EQ(mesh.cells.size(), 1U) << name;
        EXPECT_EQ(mesh.cells[0], (std::array<std::uint32_t, 8>{0, 1, 2, 3, 4, 5, 6, 7})) << name;
    }
    EXPECT_EQ(read_hex_mesh(corpus / "vtu" / "written_pieces.vtu").patches.size(), 1U);
    for (const char* name : {"written_text", "written_bytes", "written_zlib", "written_lzma"})
        EXPECT_EQ(read_surface(corpus / "vtp" / (std::string(name) + ".vtp")).triangles.size(), 4U) << name;
    EXPECT_EQ(read_surface(corpus / "vtp" / "written_pieces.vtp").triangles.size(), 8U);
    for (const char* name : {"bytes2", "bytes4", "periodic2", "periodic4"}) {
        const HexMesh mesh = read_hex_mesh(corpus / "msh" / (std::string(name) + ".msh"));
        EXPECT_EQ(mesh.nodes.size(), 8U) << name;
        EXPECT_EQ(mesh.cells.size(), 1U) << name;
        ASSERT_EQ(mesh.patches.size(), 2U) << name;
        EXPECT_EQ(mesh.patches[1].name, "high") << name;
    }
}

TEST_F(MeshFile, TruncatedFilesAreRefused) {
    for (const char* folder : {"vtu", "vtp", "msh"})
        for (const auto& file : fs::directory_iterator(corpus / folder)) {
            const std::string text = content(file.path());
            for (std::size_t part = 0; part < 20; ++part) {
                const std::string begin = text.substr(0, text.size() * part / 20);
                if (begin.find("$EndElements") != std::string::npos)
                    continue;  // whole but for periodic nodes
                EXPECT_NE(refusal(file.path().extension().string(), begin), "")
                    << file.path() << ", " << part << " of 20";
            }
        }
}

TEST_F(MeshFile, VtkArraysHoldWhatTheirPlaceDemands) {
    const std::string text = content(corpus / "vtu" / "patch.vtu");
    expect_refused(".vtu", content(corpus / "vtu" / "short_arrays.vtu"),
                   "\"types\" holds 2 values instead of 4");
    expect_refused(".vtu", replaced(text, ">-1 0<", ">-1<"), "\"patch\" holds 1 values instead of 2");
    expect_refused(".vtu", replaced(text, ">-1 0<", ">-1 x<"), "\"x\", which is no value of type Int32");
    const std::string real = "type=\"Float32\" Name=\"u\" format=\"ascii\">";
    for (const char* value : {"nan", "-inf", "1e-40", "+3.5"})  // VTK writes the first two
        EXPECT_EQ(
            refusal(".vtu",
                    replaced(text, "type=\"Int32\" Name=\"patch\" format=\"ascii\">-1 0",
                             "type=\"Int32\" Name=\"patch\" format=\"ascii\">-1 0</DataArray><DataArray " +
                                 real + value + " 0")),
            "")
            << value;
    expect_refused(".vtu", replaced(text, ">8 12<", ">8 7<"), "does not ascend");
    expect_refused(".vtu", replaced(text, ">8 12<", ">8 13<"),
                   "\"connectivity\" holds 12 values instead of 13");
    expect_refused(".vtu", replaced(text, ">8 12<", ">0 0<"),
                   "\"connectivity\" holds 12 values instead of 0");
    expect_refused(".vtu", replaced(text, ">8 12<", ">8 2305843009213693952<"),
                   "claim 2305843009213693952 nodes, more than its bytes can hold");
    expect_refused(".vtu", replaced(text, ">-1 0<", ">+-1 0<"), "\"+-1\", which is no value of type Int32");
    expect_refused(".vtu", replaced(text, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""),
                   "3 components");
    expect_refused(".vtu", replaced(text, "\"Int32\"", "\"Bit\""), "type \"Bit\"");
    expect_refused(".vtu", content(corpus / "vtu" / "field_type.vtu"), "type \"Float66\"");
    expect_refused(".vtp", content(corpus / "vtp" / "field_type.vtp"), "type \"Float66\"");
    expect_refused(".vtp", content(corpus / "vtp" / "empty_packed.vtp"), "array");
    expect_refused(".vtu", replaced(text, "<Points>", "<Points/><Points>"), "<Points> twice");
    expect_refused(".vtu", replaced(text, "</Cells>", "</Cell>"), "an end without begin");
    expect_refused(".vtu", "<!DOCTYPE a>" + text, "a declaration");
    expect_refused(".vtu", replaced(text, "</CellData>", "<DataArray Name=\"patch\"/></CellData>"),
                   "two arrays");
    expect_refused(".vtu", replaced(text, "</Piece>", "</Piece><Piece NumberOfPoints=\"0\"/>"),
                   "the same arrays");
    const std::string packed = content(corpus / "vtu" / "written_zlib.vtu");
    expect_refused(".vtu", replaced(packed, "vtkZLib", "vtkBLib"), "compressor");
    expect_refused(".vtu", replaced(packed, "\"UInt64\"", "\"UInt32\""), "array");
    expect_refused(".vtu", replaced(packed, "offset=\"0\"", "offset=\"99999\""), "behind the end");
    std::string damaged = packed;
    damaged[damaged.find('_', damaged.find("<AppendedData")) + 1 + 4 * 8 + 3] ^=
        '\x55';  // its first zlib stream
    expect_refused(".vtu", damaged, "array");
}

TEST_F(MeshFile, MshSectionsHoldWhatTheyClaim) {
    const std::string lists = content(corpus / "msh" / "patch2.msh"),
                      blocks = content(corpus / "msh" / "periodic4.msh");
    expect_refused(".msh", content(corpus / "msh" / "count_line.msh"), "more stands there than it claims");
    expect_refused(".msh", replaced(lists, "$Elements\n2\n2 3", "$Elements\n2 2 3"),
                   "$Elements, its line 1: \" 2 3");
    expect_refused(".msh", replaced(lists, "$Nodes\n8", "$Nodes\n7"),
                   "$Nodes, its line 9: more stands there");
    expect_refused(".msh", replaced(lists, "2 3 2 1 1", "2 3 1 1"), "instead of at least 2");
    expect_refused(".msh", replaced(lists, "2 3 2 1 1", "2 3 4 1 1 1 1"), "partitions");
    expect_refused(".msh", replaced(lists, "2 1 \"wall\"", "7 1 \"wall\""), "dimension 7");
    expect_refused(".msh", replaced(lists, "\"wall\"", "\"wall"),
                   "$PhysicalNames, its line 2: a name is not between quotes");
    expect_refused(".msh", replaced(lists, "2 1 \"wall\"", "2 -9223372036854775808 \"wall\""), "32 bits");
    expect_refused(".msh", lists + "$NodeData\n$EndNodeData\n", "$NodeData is not read");
    expect_refused(".msh", lists + "$Nodes\n0\n$EndNodes\n", "behind $Elements");
    expect_refused(".msh", replaced(lists, "$Nodes", "$PhysicalNames\n0\n$EndPhysicalNames\n$Nodes"),
                   "twice");
    expect_refused(".msh", replaced(lists, "$Nodes", "a\n$Nodes"), "where a section should begin");
    expect_refused(".msh", replaced(blocks, "3 1 5 1", "2 1 5 1"), "on an entity of dimension 2");
    expect_refused(".msh", replaced(blocks, "3 1 5 1", "3 9 5 1"), "entity 9 of dimension 3 is missing");
    expect_refused(".msh", replaced(blocks, "2 2 1\n16", "2 2 8\n16"), "entity 8 of dimension 2 is missing");
    expect_refused(".msh", replaced(blocks, "a cube", "a $ube"), "$Comments");
}

}  // namespace
}  // namespace hemoflux::meshing
