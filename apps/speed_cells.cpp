#include "apps/speed_cells.hpp"

#include <fmt/format.h>

#include "apps/cell_builder.hpp"
#include "apps/coupled_run.hpp"
#include "coupling/motion.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::apps {
namespace {

constexpr double table_iterations = 25000;

/// The problems of sections 7.2 to 7.4, as in the shipped cases.
struct Problem {
    const char *name, *fluid, *flow, *cell, *numerics;
    int edge;  ///< cells along each axis
    double simulated_s, thesis_iterations, thesis_seconds;
};
constexpr Problem problems[] = {
    {"optical tweezers, 160 pN", "1.2 mPa s", "[tweezers]\nforce = \"160 pN\"\n",
     "reference = \"stress-free\"\nshear_modulus = \"4 uN/m\"\naxis = [0, 0, 1]\n", "reynolds = 40\n", 40,
     0.69, 14.7e6, 25897},
    {"wheel, 60 /s", "0.7075 mPa s", "[shear]\nrate = \"60 1/s\"\n",
     "reference = \"stress-free\"\nshear_modulus = \"4 uN/m\"\naxis = [0, 0, 1]\n", "reynolds = 2\n", 20,
     0.49, 4.87e6, 11531},
    {"tank treading, 1.6 /s", "22 mPa s", "[shear]\nrate = \"1.6 1/s\"\n",
     "reference = \"uniform\"\nshear_modulus = \"6.1 uN/m\"\naxis = [0, 1, 0]\n", "reynolds = 2\n", 30, 37.5,
     12.0e6, 15709}};

Case case_of(const Problem& p, bool quick) {
    const bool sheared = std::string(p.flow).starts_with("[shear]");
    const double length = sheared && p.edge == 30 ? 12 : 24;
    const int edge = quick ? 30 : p.edge;
    std::string sides;
    for (const char axis : {'x', 'y', 'z'})
        sides += fmt::format("{} = {{ velocity = \"{}\", density = \"zero-gradient\" }}\n", axis,
                             sheared ? "shear" : "no-slip");
    return parse_case(fmt::format(
        "title = \"{}\"\nkind = \"coupled\"\n[fluid]\ndensity = \"1000 kg/m^3\"\nviscosity = \"{}\"\n"
        "[grid]\nkind = \"plateau\"\nlength = [\"{} um\", \"{} um\", \"{} um\"]\ncells = [{}, {}, {}]\n"
        "plateau = {{ a = {}, b = 0.2 }}\n[boundary]\n{}{}[[cell]]\nmesh = \"icosphere\"\nnodes = {}\n"
        "shape = \"discocyte\"\ncytosol_viscosity = \"6 mPa s\"\n{}[coupling]\nrecentre = true\n"
        "[time]\nduration = \"{} s\"\n[numerics]\nlattice_viscosity = 0.5\n{}",
        p.name, p.fluid, length, length, length, edge, edge, edge, edge / 3.0, sides, p.flow,
        quick ? 642 : 2562, p.cell, p.simulated_s, p.numerics));
}

/// Forces of one cell and its nodes moved by a hair.
double membrane_seconds(membrane::Batch& cells, int samples, double least) {
    constexpr double hair = 1e-9;
    return median_seconds(
        [&] {
            cells.compute_forces();
            coupling::move(cells.x().size(), hair, cells.fx().data(), cells.fy().data(), cells.fz().data(),
                           cells.x().data(), cells.y().data(), cells.z().data());
        },
        samples, least);
}

}  // namespace

CellSpeed time_cells(bool quick) {
    const int samples = quick ? 1 : 5;
    const double least = quick ? 0.005 : 0.5;
    constexpr int warm_up = 5;
    CellSpeed speed;
    for (const Problem& p : problems) {
        const Case c = case_of(p, quick);
        CoupledSystem system(c);
        system.add_cells(c);
        for (int step = 0; step < warm_up; ++step) system.loop->step(system.numerics.step);
        CellRun run{p.name, p.simulated_s, system.fluid->cells(), p.thesis_iterations, p.thesis_seconds};
        run.steps = system.plan.steps;
        run.step_seconds = median_seconds([&] { system.loop->step(system.numerics.step); }, samples, least);
        system.loop->check();
        speed.runs.push_back(run);
        speed.nodes = system.cells->vertices();
        if (speed.runs.size() == 1) speed.membrane_seconds = membrane_seconds(*system.cells, samples, least);
    }
    return speed;
}

std::string table_8_5_and_8_6(const Machine& m, const CellSpeed& s) {
    std::string text = fmt::format(
        "Tables 8.5 and 8.6: seconds of 25,000 iterations of optical tweezers, a cell of {} nodes; {} "
        "threads "
        "here.\n{:<34} {:>12} {:>10} {:>10} {:>12}\n",
        s.nodes, m.threads, "", "AMD FX-6300", "Tesla K40", "V100", "this machine");
    text += fmt::format("{:<34} {:>12} {:>10} {:>10} {:>12.1f}\n", "8.5  without fluid", 483, 20, 12,
                        table_iterations * s.membrane_seconds);
    return text + fmt::format("{:<34} {:>12} {:>10} {:>10} {:>12.1f}\n",
                              fmt::format("8.6  in {} cells of fluid", s.runs.front().cells), "-", 126, 28,
                              table_iterations * s.runs.front().step_seconds);
}

std::string table_7_1(const Machine& m, const CellSpeed& s) {
    std::string text = fmt::format(
        "Table 7.1: whole runs, the thesis's on a V100, ours from measured steps in proportion ({} threads, "
        "a "
        "cell of {} nodes).\n{:<26} {:>8} {:>10} {:>16} {:>12} {:>12} {:>12} {:>8}\n",
        m.threads, s.nodes, "", "cells", "time, s", "iterations, 1e6", "thesis, s", "our steps", "ours, s",
        "ratio");
    for (const CellRun& r : s.runs)
        text += fmt::format("{:<26} {:>8} {:>10} {:>16} {:>12} {:>12} {:>12.1f} {:>8.0f}\n", r.problem,
                            r.cells, r.simulated_s, r.thesis_iterations * 1e-6, r.thesis_seconds, r.steps,
                            r.seconds(), r.thesis_seconds / r.seconds());
    return text;
}

}  // namespace hemoflux::apps
