#include "apps/toml_input.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

std::string refusal(const std::string& text) {
    return message_of<InputError>([&] { resolve(case_schema(), parse_toml(text, "case.toml"), "/cases"); });
}

void expect_all(const std::string& message, std::initializer_list<const char*> parts) {
    ASSERT_NE(message, "");
    for (const char* part : parts) {
        EXPECT_NE(message.find(part), std::string::npos) << "\"" << part << "\" is not in: " << message;
    }
}

TEST(TomlInput, UnknownKeyNamesLineTableAndNearestName) {
    expect_all(refusal(example_with("viscosity = \"22", "viscsity = \"22")),
               {"case.toml, line 5", "unknown key \"viscsity\"", "[fluid]", "\"viscosity\" was meant"});
    expect_all(refusal("titel = \"x\"\n"), {"line 1", "\"titel\"", "the top level", "\"title\""});
    expect_all(refusal(example_with("[coupling]", "[cuopling]")), {"line 28", "\"coupling\" was meant"});
}

TEST(TomlInput, MissingKeyNamesTable) {
    expect_all(refusal(example_with("viscosity = \"22 mPa s\"\n", "")),
               {"case.toml, line 3", "\"viscosity\" is missing in [fluid]", "Add viscosity = "});
}

TEST(TomlInput, WrongUnit) {
    expect_all(refusal(example_with("22 mPa s", "22 um")),
               {"case.toml, line 5", "fluid.viscosity", "22 um", "measures something else", "Pa s"});
    expect_all(refusal(example_with("\"22 mPa s\"", "0.022")),
               {"case.toml, line 5", "fluid.viscosity = 0.022", "the unit is missing", "\"1 Pa s\""});
    expect_all(refusal(example_with("\"12 um\", \"12 um\"]", "\"12 umm\", \"12 um\"]")),
               {"case.toml, line 8", "\"umm\" is not a unit"});
}

TEST(TomlInput, OutOfRangeNamesValueBoundAndReason) {
    expect_all(refusal(example_with("22 mPa s", "-22 mPa s")),
               {"case.toml, line 5", "-22 mPa s", "a viscosity is positive", "> 0 Pa s"});
    expect_all(refusal(example_with("nodes = 2562", "nodes = 12")),
               {"case.toml, line 20", "cell.nodes = 12", "an icosphere has 10 4^level + 2 nodes"});
    expect_all(refusal(example_with("reynolds = 2", "reynolds = nan")), {"out of range"});
}

TEST(TomlInput, WrongTypeSaysWhatIsExpected) {
    expect_all(refusal(example_with("nodes = 2562", "nodes = 2562.5")), {"a whole number"});
    expect_all(refusal(example_with("cells = [30, 30, 30]", "cells = [30, 30]")),
               {"a list of 3 whole numbers"});
    expect_all(refusal(example_with("\"lagrange\"", "\"lagrang\"")),
               {"no such choice", "\"lagrange\" was meant"});
    expect_all(refusal(example_with("axis = [0, 1, 0]", "axis = \"y\"")),
               {"cell.axis = \"y\"", "a list of 3 numbers"});
    expect_all(refusal(example_with("velocity = \"shear\"", "velocity = \"sheer\"")),
               {"boundary", "\"shear\""});
}

TEST(TomlInput, MalformedFileNamesLineAndColumn) {
    const auto parse = [] { parse_toml("title = \"x\"\nkind = = 3\n", "case.toml"); };
    expect_all(message_of<InputError>(parse), {"case.toml, line 2, column 8", "not valid TOML"});
}

TEST(TomlInput, UnreadableFileIsAFileError) {
    expect_all(message_of<FileError>([] { read_toml("/nowhere/case.toml"); }),
               {"/nowhere/case.toml", "cannot be read"});
    EXPECT_THROW(read_toml("/tmp"), FileError);
}

TEST(TomlInput, OverridesReachTablesAndArrays) {
    toml::table values = parse_toml(example_case, "case.toml");
    override_value(values, "fluid.viscosity=6 mPa s");  // bare text
    override_value(values, "fluid.density=\"1025 kg/m^3\"");
    override_value(values, "cell.0.nodes=642");
    override_value(values, "cell.0.axis.2=1");
    override_value(values, "coupling.recentre=true");
    override_value(values, "body_force.acceleration=[\"1 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]");
    EXPECT_EQ(values["fluid"]["viscosity"].value<std::string>(), "6 mPa s");
    EXPECT_EQ(values["fluid"]["density"].value<std::string>(), "1025 kg/m^3");
    EXPECT_EQ(values["cell"][0]["nodes"].value<int>(), 642);
    EXPECT_EQ(values["cell"][0]["axis"][2].value<int>(), 1);
    EXPECT_EQ(values["coupling"]["recentre"].value<bool>(), true);
    EXPECT_EQ(values["body_force"]["acceleration"][0].value<std::string>(), "1 m/s^2");
    EXPECT_NO_THROW(resolve(case_schema(), values, "/"));
}

TEST(TomlInput, OverridesThatCannotBeReadAreRefused) {
    toml::table values = parse_toml(example_case, "case.toml");
    for (const char* bad :
         {"nodes", "=3", "cell..nodes=3", "cell.1.nodes=642", "cell.x.nodes=3", "title.x=3"}) {
        EXPECT_THROW(override_value(values, bad), InputError) << bad;
    }
    override_value(values, "cell.0.nods=3");
    expect_all(message_of<InputError>([&] { resolve(case_schema(), values, "/"); }),
               {"--set cell.0.nods=3", "unknown key \"nods\"", "\"nodes\""});
}

TEST(TomlInput, PathsAreSeenFromTheFolderOfTheCase) {
    const std::string text = example_with("mesh = \"icosphere\"", "mesh = \"../rbc.vtp\"");
    const toml::table resolved = resolve(case_schema(), parse_toml(text, "case.toml"), "/data/cases");
    EXPECT_EQ(resolved["cell"][0]["mesh"].value<std::string>(), "/data/rbc.vtp");
}

TEST(TomlInput, EveryDefaultIsValid) {
    const toml::table resolved = resolve(case_schema(), parse_toml(example_case, "case.toml"), "/");
    EXPECT_EQ(resolved["cell"][0]["bending_modulus"].value<std::string>(), "2.5e-19 J");
    EXPECT_EQ(resolved["numerics"]["mach"].value<std::string>(), "auto");
    EXPECT_EQ(resolved["output"]["fields"].as_array()->size(), 3u);
}

}  // namespace
}  // namespace hemoflux::apps
