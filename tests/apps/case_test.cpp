#include "apps/case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "exchange/error.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

/// The example is refused with a message that has `part` when `from` is replaced by `to`.
void expect_refused(const std::string& from, const std::string& to, const std::string& part) {
    const std::string message = message_of<InputError>([&] { parse_case(example_with(from, to)); });
    EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
}

TEST(Case, ExampleIsReadInInternalUnits) {
    const Case c = parse_case(example_case);
    EXPECT_EQ(c.kind, CaseKind::coupled);
    EXPECT_DOUBLE_EQ(c.fluid.viscosity, 0.022);
    EXPECT_EQ(c.fluid.initial, InitialFlow::shear);
    EXPECT_EQ(c.grid.kind[2], AxisKind::plateau);
    EXPECT_DOUBLE_EQ(c.grid.length[0], 12);
    EXPECT_DOUBLE_EQ(c.grid.lower[0], -6);
    EXPECT_TRUE(c.periodic(0) && !c.periodic(1) && c.periodic(2));
    EXPECT_EQ(c.boundary[1][1].velocity, VelocityCondition::shear);
    EXPECT_EQ(c.shear_rate, 3);
    ASSERT_EQ(c.cells.size(), 1u);
    EXPECT_DOUBLE_EQ(c.cells[0].shear_modulus, 6.1e-6);
    EXPECT_EQ(c.cells[0].spring_length, 0.285);
    EXPECT_DOUBLE_EQ(c.cells[0].volume_modulus, 1000);
    EXPECT_DOUBLE_EQ(c.cells[0].area_modulus, 1e-3);
    EXPECT_DOUBLE_EQ(c.cells[0].cytosol_viscosity, 0.006);
    EXPECT_EQ(c.time.strain, 25);
    EXPECT_FALSE(c.time.duration || c.time.step || c.numerics.mach || c.numerics.step_strain);
    EXPECT_EQ(c.references.at(0).high, 21.5);
}

TEST(Case, ResolvedTextGivesTheSameCase) {
    const Case c =
        parse_case(example_case, "case", "/x",
                   {"cell.0.nodes=642", "boundary.y-={velocity=['1 mm/s','0 m/s','0 m/s'], density='3 Pa'}"});
    const Case again = parse_case(c.resolved, "again", "/elsewhere");
    EXPECT_EQ(c, again);
    EXPECT_EQ(c.resolved, again.resolved);
    EXPECT_NE(c.resolved.find("bending_modulus"), std::string::npos);
}

TEST(Case, ShippedCasesAreValidAndKnowTheirReference) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(HEMOFLUX_CASES)) {
        if (entry.path().extension() == ".toml") {
            SCOPED_TRACE(entry.path());
            Case c = read_case(entry.path());
            EXPECT_FALSE(c.references.empty());
            c.sweep.reset();  // what is resolved is one run
            EXPECT_EQ(c, parse_case(c.resolved));
            ++count;
        }
    }
    EXPECT_GE(count, 3);
}

TEST(Case, BoundaryConditions) {
    const Case c = parse_case(
        example_with("\"z\" = \"periodic\"",
                     "\"z\" = { velocity = [\"1 mm/s\", \"0 m/s\", \"0 m/s\"], density = \"2 Pa\" }"));
    EXPECT_EQ(c.boundary[2][0].velocity, VelocityCondition::vector);
    EXPECT_DOUBLE_EQ(c.boundary[2][1].vector[0], 1000);
    EXPECT_EQ(c.boundary[2][0].density, DensityCondition::pressure);
    EXPECT_DOUBLE_EQ(c.boundary[2][0].value, 2);
    const Case d = parse_case(example_with("density = \"zero-gradient\"", "density = 1.01"));
    EXPECT_EQ(d.boundary[1][0].density, DensityCondition::density);
    EXPECT_DOUBLE_EQ(d.boundary[1][0].value, 1.01);
}

TEST(Case, RulesBetweenKeys) {
    expect_refused("\"x\" = \"periodic\"", "\"x-\" = \"periodic\"", "side \"x+\" has no boundary condition");
    expect_refused("\"x\" = \"periodic\"", "\"x-\" = \"periodic\"\n\"x+\" = { velocity = \"no-slip\" }",
                   "its opposite side is not");
    expect_refused("\"x\" = \"periodic\"", "\"x\" = \"periodic\"\n\"x-\" = \"periodic\"", "both given");
    expect_refused("[shear]\nrate = \"3 1/s\"\n", "", "there is no shear rate");
    expect_refused("strain = 25", "strain = 25\nduration = \"1 s\"", "both given");
    expect_refused("strain = 25", "", "the run has no length");
    expect_refused("plateau = { a = 10, b = 0.2 }", "", "key \"plateau\" is missing");
    expect_refused("kind = \"plateau\"", "kind = [\"plateau\", \"uniform\", \"explicit\"]",
                   "grid.faces.z is missing");
    expect_refused("cells = [30, 30, 30]", "", "key \"cells\" is missing");
    expect_refused("kind = \"coupled\"", "kind = \"fluid\"", "would have no effect");
    expect_refused("axis = [0, 1, 0]", "axis = [0, 0, 0]", "gives no direction");
    expect_refused("reference = \"uniform\"", "reference = \"file\"", "no reference_file");
    expect_refused("low = 18.5", "low = 118.5", "is above high");
    EXPECT_THROW(parse_case(example_case, "case", "/", {"time.step=1 us", "numerics.step_strain=1e-3"}),
                 InputError);
    EXPECT_THROW(parse_case(example_case, "case", "/", {"output.window_strain=[3, 2]"}), InputError);
    EXPECT_THROW(parse_case(example_case, "case", "/", {"fluid.initial=uniform"}), InputError);
    EXPECT_THROW(
        parse_case(example_case, "case", "/", {"fluid.initial_velocity=[\"1 m/s\", \"0 m/s\", \"0 m/s\"]"}),
        InputError);
}

TEST(Case, CoupledNeedsACell) {
    std::string text = example_case;
    const auto from = text.find("[[cell]]");
    text.erase(from, text.find("[coupling]") - from);
    const std::string message = message_of<InputError>([&] { parse_case(text); });
    EXPECT_NE(message.find("table [[cell]] is missing"), std::string::npos) << message;
}

TEST(Case, GridOfMixedAxes) {
    const Case c =
        parse_case(example_with("kind = \"plateau\"",
                                "kind = [\"uniform\", \"chebyshev\", \"explicit\"]\norigin = \"corner\"\n"
                                "faces = { z = [0, 1, 3], unit = \"mm\" }"));
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    EXPECT_DOUBLE_EQ(grid.axes[0].lower(), 0);
    EXPECT_TRUE(grid.axes[0].uniform());
    EXPECT_DOUBLE_EQ(grid.axes[1].faces[1], 6 * (1 - std::cos(std::numbers::pi / 30)));
    EXPECT_EQ(grid.axes[2].faces, (std::vector<double>{0, 1000, 3000}));
}

TEST(Case, AxisIsNormalised) {
    const Case c = parse_case(example_with("axis = [0, 1, 0]", "axis = [3, 0, 4]"));
    EXPECT_DOUBLE_EQ(c.cells[0].axis[0], 0.6);
    EXPECT_DOUBLE_EQ(c.cells[0].axis[2], 0.8);
}

}  // namespace
}  // namespace hemoflux::apps
