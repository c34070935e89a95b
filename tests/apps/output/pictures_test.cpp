#include "apps/output/pictures.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <set>

#include "apps/output/child.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/vtk_writer.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/rectilinear.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class PicturesTest : public TemporaryFolder {
  protected:
    /// A disc that turns in a shear flow: not physics, but all that a picture shows.
    void write_run(int frames) const {
        const auto disc = meshing::evans_fung(meshing::icosphere(3, 1.0));
        const auto axis = meshing::plateau_axis(-6, 6, 30, 10, 0.2);
        const auto centres = axis.centres();
        PvdSeries cells(folder_ / "cells.pvd"), fluid(folder_ / "fluid.pvd");
        for (int f = 0; f < frames; ++f) {
            const double angle = (70 - 10 * f) * std::numbers::pi / 180;
            auto cell = disc;
            // the disc's axis z is turned into the plane of shear, then by the angle
            for (Vec3d& v : cell.vertices)
                v = {v.x * std::cos(angle) - v.z * std::sin(angle),
                     v.x * std::sin(angle) + v.z * std::cos(angle), v.y};
            DataArray velocity{"velocity_um_per_s", 3, {}};
            for (const double z : centres)
                for (const double y : centres)
                    for (const double x : centres) {
                        const double near = std::exp(-(x * x + y * y + z * z) / 12);
                        velocity.values.insert(velocity.values.end(),
                                               {3 * y * (1 - 0.5 * near), -x * near, 0});
                    }
            const auto name = [&](const char* kind, const char* end) {
                return folder_ / (kind + std::to_string(f) + end);
            };
            write_cells(name("cells_000", ".vtp"), {cell}, {}, f);
            cells.add(f, name("cells_000", ".vtp"));
            write_fluid(name("fluid_000", ".vtr"), {axis, axis, axis}, {velocity}, f);
            fluid.add(f, name("fluid_000", ".vtr"));
        }
    }

    /// Sets an environment variable until the end of the test.
    void set(const char* name, const std::string& value) {
        const char* old = std::getenv(name);
        restore_.push_back([name, had = old != nullptr, before = std::string(old ? old : "")] {
            had ? ::setenv(name, before.c_str(), 1) : ::unsetenv(name);
        });
        ::setenv(name, value.c_str(), 1);
    }
    void TearDown() override {
        for (const auto& action : restore_) action();
        TemporaryFolder::TearDown();
    }

  private:
    std::vector<std::function<void()>> restore_;
};

std::set<std::array<int, 3>> colours(const std::filesystem::path& file, int& width, int& height) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    int size[3];
    reader->GetOutput()->GetDimensions(size);
    width = size[0];
    height = size[1];
    const auto* p = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer());
    std::set<std::array<int, 3>> found;
    for (long i = 0; i < static_cast<long>(width) * height; ++i, p += 3) found.insert({p[0], p[1], p[2]});
    return found;
}

TEST_F(PicturesTest, ShowTheCellTheSliceAndTheMark) {
    if (!std::getenv("DISPLAY") && (!find_program("xvfb-run") || !find_program("xauth")))
        GTEST_SKIP() << "no display and no xvfb-run";
    write_run(5);
    PictureSpec spec;
    spec.count = 3;
    spec.width = 600;
    spec.height = 450;
    const Pictures pictures = make_pictures(folder_, spec, RENDER_CHILD);
    EXPECT_EQ(pictures.message, "");
    std::vector<std::string> names;
    for (const auto& file : pictures.files) names.push_back(file.filename());
    ASSERT_EQ(names, (std::vector<std::string>{"picture_01.png", "picture_02.png", "picture_03.png",
                                               "picture_series.png"}));

    int width = 0, height = 0;
    bool red = false, blue = false, yellow = false;
    for (const auto& [r, g, b] : colours(pictures.files[0], width, height)) {
        red |= r > 120 && g < 60 && b < 60;
        blue |= b > 100 && r < 60 && g < 120;
        yellow |= r > 200 && g > 150 && b < 100;
    }
    EXPECT_EQ(width, 600);
    EXPECT_EQ(height, 450);
    EXPECT_TRUE(red) << "the cell";
    EXPECT_TRUE(blue) << "fast flow on the slice";
    EXPECT_TRUE(yellow) << "the marked vertex";
    EXPECT_NE(content("picture_01.png"), content("picture_03.png")) << "the cell has turned";
    colours(pictures.files[3], width, height);
    EXPECT_EQ(width, 900);
    EXPECT_EQ(height, 225);
}

TEST_F(PicturesTest, AreSkippedWithOneLineWithoutADisplay) {
    write_run(1);
    set("DISPLAY", "");
    set("PATH", folder_.string());
    const Pictures pictures = make_pictures(folder_, {}, RENDER_CHILD);
    EXPECT_TRUE(pictures.files.empty());
    EXPECT_EQ(pictures.message,
              "no pictures: there is no display and xvfb-run is missing (Debian packages xvfb, xauth)");
}

TEST_F(PicturesTest, NeverThrow) {
    EXPECT_EQ(make_pictures(folder_, {}, RENDER_CHILD).message, "no pictures: the run has written no frames");
    put("cells.pvd", "damaged");
    set("DISPLAY", "");
    const Pictures damaged = make_pictures(folder_, {}, RENDER_CHILD);
    EXPECT_TRUE(damaged.files.empty());
    EXPECT_TRUE(damaged.message.starts_with("no pictures: ")) << damaged.message;
    EXPECT_TRUE(make_pictures(folder_, {}, "/no/such/program").message.starts_with("no pictures: "));
    EXPECT_NE(render_pictures_main({}), 0);
}

}  // namespace
}  // namespace hemoflux::output
