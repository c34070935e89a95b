#include "meshing/surface_io.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "exchange/error.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/surface_check.hpp"

namespace hemoflux::meshing {
namespace {

namespace fs = std::filesystem;

class SurfaceIo : public testing::Test {
  protected:
    SurfaceIo() { fs::create_directories(folder_); }
    ~SurfaceIo() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }

    fs::path put(const std::string& name, const std::string& text) const {
        std::ofstream(at(name), std::ios::binary) << text;
        return at(name);
    }

    static std::string get(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    // Reads the file, which must be refused with an InputError; returns the message.
    std::string refusal(const std::string& name, const std::string& text) const {
        const fs::path path = put(name, text);
        std::string message = "not refused";
        testing::internal::CaptureStderr();
        try {
            read_surface(path);
        } catch (const InputError& error) {
            message = error.what();
            EXPECT_NE(message.find(path.string()), std::string::npos) << message;
            EXPECT_EQ(error.code(), Exit::bad_input);
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // no words of the libraries beside ours
        return message;
    }

  private:
    fs::path folder_ =
        fs::temp_directory_path() / ("hemoflux_" + std::to_string(getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

bool same(const Vec3d& a, const Vec3d& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

TEST_F(SurfaceIo, RoundTripKeepsEveryDigitAndNumber) {
    const SurfaceMesh disc = evans_fung(icosphere(3, 1));
    for (const char* name : {"cell.vtp", "cell.ply", "cell.obj", "CELL.VTP"}) {
        write_surface(at(name), disc);
        const SurfaceMesh back = read_surface(at(name));
        ASSERT_EQ(back.vertices.size(), disc.vertices.size()) << name;
        EXPECT_EQ(back.triangles, disc.triangles) << name;
        for (std::size_t v = 0; v < disc.vertices.size(); ++v)
            ASSERT_TRUE(same(back.vertices[v], disc.vertices[v])) << name << " vertex " << v;
    }
}

TEST_F(SurfaceIo, StlMergesCoincidentVertices) {
    const SurfaceMesh disc = evans_fung(icosphere(3, 1));
    write_surface(at("cell.stl"), disc);
    const SurfaceMesh back = read_surface(at("cell.stl"));
    ASSERT_EQ(back.vertices.size(), disc.vertices.size());
    ASSERT_EQ(back.triangles.size(), disc.triangles.size());
    for (std::size_t t = 0; t < disc.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_TRUE(same(back.vertices[static_cast<std::size_t>(back.triangles[t][i])],
                             disc.vertices[static_cast<std::size_t>(disc.triangles[t][i])]));
    EXPECT_NO_THROW(check_surface(back, "cell.stl"));
}

TEST_F(SurfaceIo, BinaryStl) {
    const SurfaceMesh sphere = icosphere(2, 1);
    std::string text(80, ' ');
    const auto put_raw = [&text](auto value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put_raw(static_cast<std::uint32_t>(sphere.triangles.size()));
    for (const Triangle& t : sphere.triangles) {
        for (int i = 0; i < 3; ++i) put_raw(0.0F);
        for (const int v : t) {
            const Vec3d& p = sphere.vertices[static_cast<std::size_t>(v)];
            put_raw(static_cast<float>(p.x)), put_raw(static_cast<float>(p.y)),
                put_raw(static_cast<float>(p.z));
        }
        put_raw(std::uint16_t{0});
    }
    const SurfaceMesh back = read_surface(put("binary.stl", text));
    EXPECT_EQ(back.vertices.size(), sphere.vertices.size());
    EXPECT_NEAR(area(back), area(sphere), 1e-6);
    EXPECT_NO_THROW(check_surface(back, "binary.stl"));
    EXPECT_NE(refusal("short.stl", text.substr(0, 3000)).find("320 triangles"), std::string::npos);
}

TEST_F(SurfaceIo, ObjWithSlashesAndNegativeNumbers) {
    const std::string text =
        "# a tetrahedron\no solid\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvt 0 0\n"
        "f 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 4//1\nf -4 -1 -2\nf 2 3 4\n";
    const SurfaceMesh mesh = read_surface(put("slashes.obj", text));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
    EXPECT_NEAR(volume(mesh), 1.0 / 6, 1e-15);
}

TEST_F(SurfaceIo, TruncatedFilesAreRefused) {
    const SurfaceMesh sphere = icosphere(2, 1);
    for (const char* name : {"cell.vtp", "cell.ply", "cell.stl"}) {
        write_surface(at(name), sphere);
        const std::string text = get(at(name));
        for (const double share : {0.02, 0.3, 0.7, 0.97}) {
            const auto length = static_cast<std::size_t>(share * static_cast<double>(text.size()));
            const std::string message = refusal(name, text.substr(0, length));
            EXPECT_NE(message.find("malformed"), std::string::npos)
                << name << " " << share << ": " << message;
        }
    }
}

TEST_F(SurfaceIo, MalformedFilesAreRefusedWithTheReason) {
    for (const char* name : {"empty.vtp", "empty.ply", "empty.stl", "empty.obj"})
        EXPECT_NE(refusal(name, "").find("it is empty"), std::string::npos);
    for (const char* name : {"noise.vtp", "noise.ply", "noise.stl", "noise.obj"})
        EXPECT_NE(refusal(name, "what is this\n42 {").find("malformed"), std::string::npos);
    EXPECT_NE(refusal("noise.vtp", "what is this\n42 {").find("line 1"), std::string::npos);
    EXPECT_NE(
        refusal("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").find("face 0 has 4 corners"),
        std::string::npos);
    EXPECT_NE(refusal("range.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n")
                  .find("face 0 names a vertex beyond the 3"),
              std::string::npos);
    EXPECT_NE(refusal("zero.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n").find("face 0 names a vertex"),
              std::string::npos);
    EXPECT_NE(refusal("lists.ply",
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n0 0 0\n")
                  .find("no triangles"),
              std::string::npos);
    const std::string vtp =
        "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"3\" "
        "NumberOfPolys=\"1\">"
        "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
        "0</DataArray>"
        "</Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 "
        "CORNER</DataArray>"
        "<DataArray type=\"Int64\" Name=\"offsets\" "
        "format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>";
    const auto with = [&vtp](const std::string& corner) {
        return std::string(vtp).replace(vtp.find("CORNER"), 6, corner);
    };
    EXPECT_EQ(read_surface(put("good.vtp", with("2"))).triangles.size(), 1U);
    EXPECT_NE(refusal("range.vtp", with("7")).find("face 0 names vertex 7 of 3"), std::string::npos);
    EXPECT_NE(refusal("short.vtp", with("")).find("array \"connectivity\" holds 2 values instead of 3"),
              std::string::npos);
}

TEST_F(SurfaceIo, UnknownExtensionIsRefused) {
    EXPECT_NE(refusal("cell.msh", "x").find("Use .vtp, .ply, .stl or .obj"), std::string::npos);
    EXPECT_THROW(write_surface(at("cell"), icosphere(1, 1)), InputError);
}

TEST_F(SurfaceIo, UnreadableAndUnwritableFiles) {
    fs::create_directory(at("folder.vtp"));
    for (const char* name : {"missing.vtp", "missing.ply", "missing.stl", "missing.obj", "folder.vtp"}) {
        try {
            read_surface(at(name));
            ADD_FAILURE() << name;
        } catch (const FileError& error) {
            const std::string message = error.what();
            EXPECT_EQ(error.code(), Exit::file);
            EXPECT_NE(message.find(at(name).string()), std::string::npos) << message;
            EXPECT_NE(message.find(std::string(name) == "folder.vtp" ? "Is a directory" : "No such file"),
                      std::string::npos)
                << message;
        }
    }
    EXPECT_THROW(write_surface(at("none") / "cell.vtp", icosphere(1, 1)), FileError);
    EXPECT_THROW(write_surface(at("folder.vtp"), icosphere(1, 1)), FileError);
    if (fs::exists("/dev/full")) {
        fs::create_symlink("/dev/full", at("full.ply"));
        EXPECT_THROW(write_surface(at("full.ply"), icosphere(1, 1)), FileError);
    }
}

}  // namespace
}  // namespace hemoflux::meshing
