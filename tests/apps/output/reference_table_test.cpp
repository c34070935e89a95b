#include "apps/output/reference_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"
#include "tests/apps/output/temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class ReferenceTableTest : public TemporaryFolder {
  protected:
    [[nodiscard]] ReferenceTable read(const std::string& text) const {
        put("table.csv", text);
        return read_reference_table(folder_ / "table.csv");
    }
};

TEST_F(ReferenceTableTest, SkipsCommentsAndKeepsWords) {
    const ReferenceTable t =
        read("# where it comes from\n# confidence\nline,y,u_min\nu,0.5,-0.21\nv,0.25,\r\nu,1,3e-2\n");
    EXPECT_EQ(t.columns, (std::vector<std::string>{"line", "y", "u_min"}));
    EXPECT_EQ(t.numbers("y"), (std::vector<double>{0.5, 0.25, 1}));
    EXPECT_TRUE(std::isnan(t.numbers("u_min")[1]));
    EXPECT_EQ(t.where("line", "u").numbers("u_min"), (std::vector<double>{-0.21, 0.03}));
}

TEST_F(ReferenceTableTest, RefusesWhatCannotBeCompared) {
    const ReferenceTable t = read("line,y\nu,0.5\n");
    EXPECT_THROW((void)t.numbers("x"), InputError);
    EXPECT_THROW((void)t.numbers("line"), InputError);
    EXPECT_THROW((void)t.where("line", "w"), InputError);
    EXPECT_THROW((void)read("a,b\n1,2\n3\n"), InputError);
    EXPECT_THROW((void)read("# nothing\na,b\n"), InputError);
    EXPECT_THROW((void)read_reference_table(folder_ / "missing.csv"), FileError);
}

}  // namespace
}  // namespace hemoflux::output
