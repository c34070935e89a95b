// An output folder as a coupled run leaves it, made by hand.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/output/history.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "apps/output/vtk_writer.hpp"
#include "meshing/icosphere.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::report {

namespace fs = std::filesystem;

/// Whether a text has this part.
inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

class ReportFolder : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "hemoflux-report-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    void put(const fs::path& file, const std::string& text) const {
        fs::create_directories((folder_ / file).parent_path());
        std::ofstream(folder_ / file, std::ios::binary) << text;
    }

    static output::Summary example_summary() {
        output::Summary s;
        s.case_name = "Tank treading at 3 /s";
        s.version = "0.1.0";
        s.backend = "OMP";
        s.observables = {{"inclination_deg", 17.744872}, {"taylor_d", 0.4467}, {"period_strain", NAN},
                         {"axial_um_at_100_pN", 14.6},   {"strain", 6.0},      {"drag_coefficient", 2.04}};
        s.labels = {{"mode", "tank treading"}};
        s.references["inclination_deg"] = {20.0, 18.5, 21.5, "prototype & friends"};
        s.references["taylor_d"] = {{}, 0.4, 0.5, ""};
        s.references["drag_coefficient"] = {2.0, {}, {}, ""};
        s.conservation.volume = 4.6e-5;
        s.performance.wall_s = 12.5;
        s.performance.steps = 4087;
        s.errors_estimated["volume_leak"] = 0.02;
        return s;
    }

    static std::string example_log() {
        return "2026-11-25 22:34:53.567 debug: environment   version 0.1.0; backend OMP; threads 1; cores 2; "
               "processor "
               "Example (R) CPU\n"
               "2026-11-25 22:34:54.056 info: Tank treading at 3 /s, quick\n"
               "  grid          30 x 30 x 30 cells, smallest 0.2687 um\n"
               "  conversion    length 1 um; velocity c = 476.2 um/s; stress = 77.97 Pa;\n"
               "                membrane force 1e-11 N = 0.1283 lattice units\n"
               "2026-11-25 22:35:27.000 info: results are in tt\n";
    }

    /// A coupled run of this many frames of a turning ellipsoid, with history and log.
    fs::path make_run(const fs::path& name, int frames = 4) const {
        put(name / "resolved.toml", apps::example_case);
        put(name / "log.txt", example_log());
        const fs::path run = folder_ / name;
        output::write_summary(run / "summary.json", example_summary());
        output::Table history{
            {"step", "time_s", "strain", "0.x_um", "0.inclination_deg", "0.axial_um", "0.transverse_um",
             "0.area_error", "0.volume_error", "mean_density", "residual", "dt_s"},
            {}};
        for (int i = 0; i < 40; ++i) {
            const double t = 0.15 * i;
            history.rows.push_back({1.0 * i, t / 3, t, 1e-15 * i, 20 - 15 * std::exp(-t), 8 + 0.1 * t,
                                    7 - 0.1 * t, 1e-5 * t, -2e-5 * t, 1, i == 0 ? NAN : 1e-4, 5e-4});
        }
        output::write_table(run / "history.csv", history);
        output::PvdSeries series(run / "cells.pvd");
        for (int i = 0; i < frames; ++i) {
            const fs::path file = run / ("cells_000" + std::to_string(i) + ".vtp");
            output::write_cells(file, {frame(i)}, {}, 0.5 * i);
            series.add(0.5 * i, file);
        }
        return run;
    }

    static meshing::SurfaceMesh frame(int i) {
        meshing::SurfaceMesh mesh = meshing::icosphere(2, 1.0);
        const double angle = 0.4 * i, c = std::cos(angle), s = std::sin(angle);
        for (Vec3d& v : mesh.vertices) {
            const double x = 4 * v.x, y = 1.5 * v.y;
            v = {c * x - s * y, s * x + c * y, 3 * v.z};
        }
        return mesh;
    }

    fs::path folder_;
};

}  // namespace hemoflux::report
