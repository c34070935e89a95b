#include "apps/schema.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hemoflux::apps {
namespace {

/// Calls `visit` for every table of the schema, the top level first.
template <class Visit>
void for_each_table(const Table& table, const Visit& visit) {
    visit(table);
    for (const Key& key : table.keys) {
        for (const Form& form : key.forms) {
            for (const Table& inner : form.members) {
                for_each_table(inner, visit);
            }
        }
    }
}

TEST(Schema, EveryKeyIsDescribedOnce) {
    for_each_table(case_schema(), [](const Table& table) {
        std::set<std::string> names;
        EXPECT_FALSE(table.meaning.empty()) << table.name;
        for (const Key& key : table.keys) {
            EXPECT_TRUE(names.insert(key.name).second) << table.name << "." << key.name;
            EXPECT_FALSE(key.meaning.empty()) << table.name << "." << key.name;
            EXPECT_FALSE(key.forms.empty()) << table.name << "." << key.name;
            EXPECT_FALSE(key.required && !key.standard.empty()) << table.name << "." << key.name;
        }
    });
}

TEST(Schema, PageHasEveryTableAndKey) {
    const std::string page = schema_page();
    for_each_table(case_schema(), [&](const Table& table) {
        for (const Key& key : table.keys) {
            EXPECT_NE(page.find("| `" + key.name + "` |"), std::string::npos)
                << table.name << "." << key.name;
            EXPECT_NE(page.find(key.meaning), std::string::npos) << table.name << "." << key.name;
        }
    });
    EXPECT_NE(page.find("## [[cell]]"), std::string::npos);
    EXPECT_NE(page.find("## [fluid]"), std::string::npos);
    EXPECT_NE(page.find("`\"6.1 uN/m\"`"), std::string::npos);
}

TEST(Schema, NearestName) {
    const std::vector<std::string> known{"viscosity", "density", "a"};
    EXPECT_EQ(nearest_name("viscsity", known), "viscosity");
    EXPECT_EQ(nearest_name("densities", known), "density");
    EXPECT_EQ(nearest_name("temperature", known), "");
    EXPECT_EQ(suggestion("temperature", known), "Known are: viscosity, density, a");
}

TEST(Schema, RangesInWords) {
    EXPECT_EQ(number().above(0, "").range(), "> 0");
    EXPECT_EQ(number().within(42, 162, "").range(), "42 .. 162");
    EXPECT_EQ(number().range(), "");
}

}  // namespace
}  // namespace hemoflux::apps
