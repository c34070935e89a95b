#include "apps/case_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "apps/cell_surface.hpp"
#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/surface_io.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

/// A file in a folder of its own that vanishes with the test.
class ScratchFile {
  public:
    explicit ScratchFile(const std::string& name)
        : folder_(std::filesystem::temp_directory_path() /
                  ("hemoflux_" + std::to_string(std::random_device{}()))) {
        std::filesystem::create_directories(folder_);
        file_ = folder_ / name;
    }
    ~ScratchFile() { std::filesystem::remove_all(folder_); }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    [[nodiscard]] std::string path() const { return file_.string(); }

  private:
    std::filesystem::path folder_, file_;
};

Case example(const std::vector<std::string>& sets) {
    std::vector<std::string> all{"cell.0.nodes=642"};
    all.insert(all.end(), sets.begin(), sets.end());
    return parse_case(example_case, "case", "/", all);
}

void expect_refused(const std::vector<std::string>& sets, const std::string& part) {
    const std::string message = message_of<InputError>([&] { check_case(example(sets)); });
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}

TEST(CaseCheck, ExamplePassesWithoutWarning) { EXPECT_TRUE(check_case(example({})).empty()); }

TEST(CaseCheck, CellOutsideTheBox) {
    expect_refused({"cell.0.position=['0 um', '7 um', '0 um']"}, "cell.0 is outside the box");
    expect_refused({"cell.0.position=['7 um', '0 um', '0 um']"}, "cell.0 is outside the box");
}

TEST(CaseCheck, CellOverWall) {
    expect_refused({"cell.0.position=['0 um', '5.5 um', '0 um']"}, "overlaps the side \"y+\"");
    expect_refused({"cell.0.position=['0 um', '-5.5 um', '0 um']"}, "overlaps the side \"y-\"");
    // the same reach across a periodic side is no overlap
    EXPECT_NO_THROW(check_case(example({"cell.0.position=['5.5 um', '0 um', '0 um']"})));
    // a disc turned on edge is too tall for a flat box that it fits into lying down
    EXPECT_NO_THROW(check_case(example({"grid.length=['12 um', '5 um', '12 um']"})));
    expect_refused({"grid.length=['12 um', '5 um', '12 um']", "cell.0.axis=[1, 0, 0]"}, "overlaps the side");
}

TEST(CaseCheck, WarnsWhenTheGridIsCoarserThanTheCellIsThin) {
    const std::vector<std::string> warnings =
        check_case(example({"grid.kind=uniform", "grid.cells=[6, 6, 6]"}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("thinnest part"), std::string::npos);
}

TEST(CaseCheck, NodesMustBeAnIcosphere) { expect_refused({"cell.0.nodes=1000"}, "642"); }

TEST(CaseCheck, SurfaceFiles) {
    const ScratchFile closed("sphere.vtp");
    meshing::SurfaceMesh sphere = meshing::icosphere(2, 2.0);
    meshing::write_surface(closed.path(), sphere);
    EXPECT_NO_THROW(check_case(example({"cell.0.file=" + closed.path()})));

    const ScratchFile open("open.vtp");
    sphere.triangles.pop_back();
    meshing::write_surface(open.path(), sphere);
    expect_refused({"cell.0.file=" + open.path()}, "open.vtp");

    const ScratchFile coarse("coarse.vtp");
    meshing::write_surface(coarse.path(), meshing::icosphere(0, 2.0));
    expect_refused({"cell.0.file=" + coarse.path()}, "42");

    expect_refused({"cell.0.reference=file", "cell.0.reference_file=" + closed.path()},
                   "are not those of the cell's mesh");
    EXPECT_THROW(check_case(example({"cell.0.file=/nowhere/rbc.vtp"})), FileError);
}

TEST(CellSurface, DiscLiesWithItsAxisWhereAsked) {
    const Case c = example({"cell.0.axis=[0, 1, 0]", "cell.0.position=['1 um', '2 um', '3 um']"});
    meshing::SurfaceMesh mesh = start_shape(c.cells[0]);
    const double volume = meshing::volume(mesh);
    place(mesh, c.cells[0].axis, c.cells[0].position);
    EXPECT_NEAR(meshing::volume(mesh), volume, 1e-10);
    double low = 1e9, high = -1e9, widest = 0;
    for (const Vec3d& v : mesh.vertices) {
        low = std::min(low, v.y), high = std::max(high, v.y);
        widest = std::max(widest, std::hypot(v.x - 1, v.z - 3));
    }
    EXPECT_NEAR((low + high) / 2, 2, 1e-3);
    EXPECT_LT(high - low, 2.7);
    EXPECT_NEAR(2 * widest, 7.82, 0.02);
}

TEST(CellSurface, PlacesAlongEveryAxis) {
    for (const Triple& axis : {Triple{0, 0, 1}, Triple{0, 0, -1}, Triple{0.6, 0, -0.8}, Triple{1, 0, 0}}) {
        meshing::SurfaceMesh mesh{{{0, 0, 2}, {1, 0, 0}, {0, 1, 0}}, {}};
        place(mesh, axis, {1, 1, 1});
        EXPECT_NEAR(mesh.vertices[0].x, 1 + 2 * axis[0], 1e-14);
        EXPECT_NEAR(mesh.vertices[0].y, 1 + 2 * axis[1], 1e-14);
        EXPECT_NEAR(mesh.vertices[0].z, 1 + 2 * axis[2], 1e-14);
        const Vec3d x = mesh.vertices[1] - Vec3d{1, 1, 1};
        const Vec3d y = mesh.vertices[2] - Vec3d{1, 1, 1};
        const Vec3d z = cross(x, y);  // a rotation keeps the handedness
        EXPECT_NEAR(z.x, axis[0], 1e-14);
        EXPECT_NEAR(z.z, axis[2], 1e-14);
    }
}

TEST(CellSurface, ThinnestPartOfTheDiscIsItsCentre) {
    const Case c = example({"cell.0.shape=evans-fung", "grid.kind=uniform"});
    meshing::SurfaceMesh mesh = start_shape(c.cells[0]);
    place(mesh, c.cells[0].axis, c.cells[0].position);
    const ThinnestPart thin = thinnest_part(mesh, make_grid(c.grid));
    EXPECT_NEAR(thin.thickness, 0.81, 0.02);  // D a0 2 = 7.82 x 0.0518 x 2
    EXPECT_NEAR(thin.grid_cells, thin.thickness / 0.4, 0.03);
    EXPECT_LT(std::hypot(thin.where.x, thin.where.z), 0.5);
}

}  // namespace
}  // namespace hemoflux::apps
