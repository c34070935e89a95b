#include "exchange/field.hpp"

#include <gtest/gtest.h>

using namespace hemoflux::exchange;

TEST(FieldTable, ReaderMustAgreeOnShapeAndUnit) {
    FieldTable table;
    double values[4] = {};
    table.offer("fluid", {"density", Shape::scalar, "1"}, {{values, nullptr, nullptr}, 4});
    EXPECT_EQ(table.read("fluid.density", Shape::scalar, "1").component[0], values);
    EXPECT_THROW(table.offer("fluid", {"density", Shape::scalar, "1"}, {}), std::logic_error);
    EXPECT_THROW((void)table.read("fluid.density", Shape::vector, "1"), std::logic_error);
    EXPECT_THROW((void)table.read("fluid.density", Shape::scalar, "Pa"), std::logic_error);
    EXPECT_THROW((void)table.read("fluid.velocity", Shape::vector, "c"), std::logic_error);
    ASSERT_EQ(table.list().size(), 1u);
    EXPECT_EQ(table.list()[0].name, "fluid.density");
}
