// Bad inputs of every reader through the built program: each ends with one message that names the place, the reason and a
// remedy, and with the exit code of its kind, before anything is computed or written.
#include "tests/apps/bad_input.hpp"

#include <map>

namespace hemoflux::apps {
namespace {

std::string membrane_with(const std::string& more) {
    return "title = \"m\"\nkind = \"membrane\"\n[[cell]]\nnodes = 162\n[membrane]\n" + more;
}

TEST_F(BadInput, Toml) {
    expect_refused({
        {"", {"case.toml", "\"title\" is missing"}},
        {"title = \"abc\n", {"case.toml, line 1", "not valid TOML"}},
        {std::string("title = \"x\"\n\x01\x02"), {"case.toml, line 2", "not valid TOML"}},
        {"title = \"\xff\xfe\"\n", {"case.toml, line 1", "not valid TOML"}},
        {cell_with("kind = \"coupled\"", "kind = \"coupled\"\nkind = \"fluid\""),
         {"case.toml, line 3", "kind"}},
        {shear_flow + "[fluid]\n", {"case.toml, line 16", "fluid"}},
        {cell_with("[fluid]", "[[fluid]]"), {"case.toml, line 3", "fluid", "table"}},
        {"title = \"x\"\ncell = [1, 2]\n", {"case.toml, line 2", "cell", "[[cell]]"}},
        {cell_with("strain = 25", "strain = 1979-05-27"), {"case.toml, line 32", "time.strain", "a number"}},
        {cell_with("nodes = 2562", "nodes = 99999999999999999999"), {"case.toml, line 20", "not valid TOML"}},
        {"a = " + std::string(3000, '[') + std::string(3000, ']') + "\n",
         {"case.toml, line 1", "not valid TOML"}},
    });
}

TEST_F(BadInput, Units) {
    const auto viscosity = [](const std::string& text) {
        return flow_with("viscosity = \"1 mPa s\"", "viscosity = " + text);
    };
    const std::string place = "case.toml, line 4: fluid.viscosity";
    expect_refused({
        {viscosity("1"), {place, "the unit is missing"}},
        {viscosity("\"\""), {place, "does not start with a finite number"}},
        {viscosity("\"mPa s\""), {place, "does not start with a finite number"}},
        {viscosity("\"nan Pa s\""), {place, "does not start with a finite number"}},
        {viscosity("\"1e999 Pa s\""), {place, "does not start with a finite number"}},
        {viscosity("\"1 mPs\""), {place, "\"mPs\" is not a unit"}},
        {viscosity("\"1 m\""), {place, "measures something else"}},
        {viscosity("\"1 lg(re 1 mW)\""), {place, "lg(re 1 mW)"}},
        {viscosity("\"1 seconds since 1970-01-01\""), {place, "measures something else"}},
        {viscosity("\"1e300 YPa s\""), {place, "finite"}},
        {viscosity("\"0 Pa s\""), {place, "a viscosity is positive"}},
        {viscosity("\"1 " + std::string(20000, '(') + "\""), {place, "is not a unit"}},
    });
}

TEST_F(BadInput, GridAndBoundary) {
    const std::string box = "length = [\"4 um\", \"8 um\", \"4 um\"]\ncells = [4, 8, 4]";
    const auto faces = [&](const std::string& y) {
        return flow_with(box, "kind = \"explicit\"\nfaces = { x = [0, 1, 2], y = " + y + ", z = [0, 1, 2] }");
    };
    const std::string side = "y = { velocity = \"shear\" }";
    const auto expression = [&](const std::string& u) {
        return flow_with(
            side, "y = { velocity = \"expression\", velocity_expression = [\"" + u + "\", \"0\", \"0\"] }");
    };
    expect_refused({
        {flow_with("cells = [4, 8, 4]", "cells = [4, 0, 4]"), {"line 7", "grid.cells", "at least one cell"}},
        {flow_with("cells = [4, 8, 4]", "cells = [4, 8]"), {"line 7", "grid.cells", "3 whole numbers"}},
        {flow_with("\"4 um\", \"8 um\"", "\"-4 um\", \"8 um\""), {"line 6", "grid.length", "positive"}},
        {flow_with("\"4 um\", \"8 um\"", "\"1e200 um\", \"8 um\""),
         {"line 6", "grid.length", "<= 1000000000 um"}},
        {flow_with("[grid]", "[grid]\nkind = \"plato\""), {"line 6", "\"plateau\""}},
        {flow_with("[grid]", "[grid]\nkind = \"plateau\""),
         {"case.toml", "\"plateau\" is missing in [grid]"}},
        {faces("[0, 2, 1]"), {"[grid], axis y", "ascend"}},
        {faces("[0]"), {"[grid], axis y", "two"}},
        {faces("[0, nan, 2]"), {"line 7", "grid.faces.y"}},
        {flow_with("x = \"periodic\"\n", ""), {"case.toml", "no boundary condition"}},
        {flow_with("x = \"periodic\"", "w = { velocity = \"shear\" }"),
         {"case.toml", "unknown key \"w\"", "x-, x+"}},
        {flow_with(side, "y = { velocity = [\"1 m/s\", \"0 m/s\"] }"),
         {"line 11", "boundary", "3 quantities"}},
        {flow_with(side, "y = { velocity = \"expression\" }"), {"case.toml", "velocity_expression"}},
        {expression("sin("), {"boundary.y-.velocity_expression", "formula"}},
        {expression("q"), {"boundary.y-.velocity_expression", "q"}},
        {expression("x = 3"), {"boundary.y-.velocity_expression", "assigns"}},
        {expression("sqrt(x)"), {"boundary.y-.velocity_expression", "not a finite number at"}},
    });
}

TEST_F(BadInput, TimeNumericsAndOutput) {
    expect_refused({
        {flow_with("strain = 0.1", ""), {"case.toml", "the run has no length"}},
        {flow_with("strain = 0.1", "strain = 0.1\nduration = \"1 s\""), {"case.toml", "both given"}},
        {flow_with("strain = 0.1", "strain = 1e300"), {"line 15", "time.strain", "<= 1000000000"}},
        {flow_with("strain = 0.1", "strain = 0.1\nstep = \"1 s\""),
         {"case.toml", "time.step", "longer than the run"}},
        {flow_with("strain = 0.1", "strain = 0.1\nstep = \"1e-30 s\""),
         {"case.toml", "time.step", "never end"}},
        {flow_with("strain = 0.1", "strain = 0.1\nscheme = \"rk3\""), {"line 16", "no such choice"}},
        {flow_with("1e4 1/s", "0 1/s"), {"line 13", "shear.rate", "> 0"}},
        {shear_flow + "[numerics]\nmach = 0.9\n", {"line 17", "numerics.mach", "weakly compressible"}},
        {shear_flow + "[numerics]\nreynolds = 2\n", {"case.toml", "numerics.reynolds", "no effect"}},
        {shear_flow + "[numerics]\nmahc = 0.1\n", {"line 17", "\"mach\" was meant"}},
        {shear_flow + "[output]\nfields = [\"heat\"]\n", {"line 17", "output.fields", "velocity"}},
        {shear_flow + "[output]\nwindow_strain = [5, 1]\n", {"case.toml", "window_strain", "empty"}},
        {shear_flow + "[output]\ncompression = 10\n", {"line 17", "output.compression", "0 .. 9"}},
        {shear_flow + "[output]\nhistory_interval = \"0 s\"\n", {"line 17", "an interval is positive"}},
        {shear_flow + "[watchdog]\ndensity = [0.1, 2]\n", {"line 17", "watchdog.density", "0.5 .. 1.5"}},
        {shear_flow + "[watchdog]\ndensity = [1.2, 0.8]\n",
         {"case.toml", "watchdog.density = [1.2, 0.8]", "lowest density first"}},
        {shear_flow + "[watchdog]\ninterval = 0\n", {"line 17", "watchdog.interval"}},
        {cell_with("reynolds = 2", "reynolds = 2\nspeed = \"1 mm/s\""),
         {"case.toml", "numerics.speed", "no effect"}},
        {cell_with("strain = 25", "strain = 25\nsteady = 1e-6"), {"case.toml", "time.steady", "no effect"}},
        {shear_flow + "[[reference]]\nobservable = \"u\"\nsource = \"x\"\n",
         {"case.toml", "[[reference]] u"}},
        {shear_flow + "[analytical]\nsolution = \"cuette\"\n", {"line 17", "\"couette\" was meant"}},
        {shear_flow + "[body_force]\n", {"case.toml", "[body_force] is empty"}},
    });
}

TEST_F(BadInput, CellsAndBodies) {
    expect_refused({
        {cell_with("nodes = 2562", "nodes = 100"), {"line 20", "cell.nodes", "of 42, 162, 642"}},
        {cell_with("nodes = 2562", "nodes = true"), {"line 20", "cell.nodes", "a whole number"}},
        {cell_with("shape = \"discocyte\"", "shape = \"pancake\""), {"line 21", "cell.shape", "spheroid"}},
        {cell_with("axis = [0, 1, 0]", "axis = [0, 0, 0]"), {"case.toml", "cell.0.axis is zero"}},
        {cell_with("axis = [0, 1, 0]", "axis = [nan, 0, 0]"), {"line 27", "cell.axis"}},
        {cell_with("6.1 uN/m", "-6.1 uN/m"), {"line 23", "cell.shear_modulus", "not negative"}},
        {cell_with("reference = \"uniform\"", "reference = \"file\""), {"case.toml", "no reference_file"}},
        {cell_with("position = [\"0 um\", \"0 um\"", "position = [\"0 um\", \"50 um\""),
         {"cell.0 is outside the box"}},
        {cell_with("\"lagrange\"", "\"phi5\""), {"line 29", "coupling.kernel", "phi2"}},
        {example_case + "[contact]\npressure = \"-1 Pa\"\n", {"contact.pressure"}},
        {example_case + "[packing]\nhaematocrit = 0.9\n", {"packing.haematocrit", "room"}},
        {example_case + "[tweezers]\n", {"\"force\" is missing in [tweezers]"}},
        {shear_flow + "[[cell]]\nnodes = 162\n", {"case.toml", "kind \"fluid\""}},
        {shear_flow + "[contact]\n", {"case.toml", "[contact]", "no effect"}},
        {shear_flow + "[packing]\nhaematocrit = 0.1\n", {"case.toml", "[packing]", "no effect"}},
        {shear_flow + "[tweezers]\nforce = \"1 pN\"\n", {"case.toml", "[tweezers]", "no effect"}},
        {example_case + "[membrane]\n", {"case.toml", "[membrane]", "no effect"}},
        {shear_flow + "[[body]]\n", {"case.toml", "body", "no size"}},
        {shear_flow + "[[body]]\ndiameter = \"2 um\"\nposition = [\"0 um\", \"9 um\", \"0 um\"]\n",
         {"body.0 reaches through the border"}},
        {shear_flow + "[[body]]\nfile = \"none.stl\"\n", {"none.stl"}, 4},
        {membrane_with("task = \"strech\"\n"), {"line 6", "\"stretch\" was meant"}},
        {membrane_with("forces = []\n"), {"case.toml", "membrane.forces is empty"}},
        {membrane_with("task = \"stretch\"\nexperiment = \"e.csv\"\n"),
         {"e.csv", "line 2", "2 values for 3"},
         2,
         "e.csv",
         "F_pN,DA_um,DT_um\n1,2\n"},
        {membrane_with("task = \"stretch\"\nexperiment = \"e.csv\"\n"),
         {"e.csv", "line 2", "\"x\" is not a number"},
         2,
         "e.csv",
         "F_pN,DA_um,DT_um\n1,2,x\n"},
        {membrane_with("task = \"stretch\"\nexperiment = \"e.csv\"\n"),
         {"e.csv", "no header"},
         2,
         "e.csv",
         ""},
    });
}

TEST_F(BadInput, Sweeps) {
    const auto sweep = [](const std::string& values) {
        return shear_flow + "[sweep]\nvalues = {" + values + "}\n";
    };
    expect_refused(
        {{sweep(""), {"case.toml", "sweep.values is empty"}},
         {sweep("\"shear.rate\" = [\"1 1/s\", \"2 1/s\"], \"time.strain\" = [1]"), {"case.toml", "2"}},
         {sweep("\"shear.rat\" = [\"1 1/s\"]"), {"\"rate\" was meant"}},
         {shear_flow, {"case.toml", "sweep"}}},
        "sweep case.toml -o out");
}

TEST_F(BadInput, CommandLine) {
    write("case.toml", shear_flow);
    const std::map<std::string, std::string> all{
        {"run case.toml --set fluid", "--set fluid"},
        {"run case.toml --set =3", "--set =3"},
        {"run case.toml --set fluid.=3", "--set fluid.=3"},
        {"run case.toml --set cell.5.nodes=3", "cell"},
        {"run case.toml --set fluid.viscosity.x=3", "\"viscosity\" is no table"},
        {"run case.toml --set 'fluid.viscosity=3 kg'", "--set fluid.viscosity=3 kg"},
        {"run case.toml --threads x", "--threads"},
        {"run case.toml other.toml", "other.toml"},
        {"run --output", "--output"},
        {"schema --jsno", "--jsno"},
        {"mesh grid --length 12", "12"},
        {"mesh grid --cells 3 3", "cells"},
        {"mesh rbc --nodes 162 --area '1 um'", "um"},
        {"mesh hex box --cells 0 1 1", "cells"},
        {"membrane stretch --nodes 42 --forces 'x pN' -o out", "x pN"},
    };
    for (const auto& [arguments, part] : all) expect_error(arguments, 2, part);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace hemoflux::apps
