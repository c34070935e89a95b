#include "apps/output/history.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class HistoryTest : public TemporaryFolder {};

TEST_F(HistoryTest, NumbersReadBackAsTheSameDoubles) {
    const std::vector<double> row{7,      0.1, 1.0 / 3.0, -1e-300, std::numeric_limits<double>::denorm_min(),
                                  6.02e23};
    {
        History history(folder_ / "history.csv", {"step", "a", "b", "c", "d", "e"});
        history.add(row);
        history.add({8, NAN, INFINITY, -INFINITY, -0.0, 2});
    }
    EXPECT_TRUE(content("history.csv").starts_with("step,a,b,c,d,e\n7,0.1,0.3333333333333333,"));
    const Table table = read_table(folder_ / "history.csv");
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0], row);
    EXPECT_TRUE(std::isnan(table.rows[1][1]));
    EXPECT_EQ(table.rows[1][3], -INFINITY);
    EXPECT_TRUE(std::signbit(table.rows[1][4]));
    EXPECT_EQ(table.column("b").front(), 1.0 / 3.0);
    EXPECT_THROW((void)table.column("z"), InputError);
}

TEST_F(HistoryTest, RowsAreOnDiskBeforeTheFileIsClosed) {
    History history(folder_ / "history.csv", {"step", "x"});
    history.add({0, 1.5});
    EXPECT_EQ(content("history.csv"), "step,x\n0,1.5\n");
}

TEST_F(HistoryTest, ARowThatWasNotFinishedIsLeftOut) {
    { History(folder_ / "broken.csv", {"step", "x"}).add({10, 0.5}); }
    put("broken.csv", content("broken.csv") + "70,0.65");  // killed in the middle of a row
    EXPECT_EQ(read_table(folder_ / "broken.csv").rows, (std::vector<std::vector<double>>{{10, 0.5}}));
}

TEST_F(HistoryTest, MalformedTablesNameTheirLine) {
    put("a.csv", "step,x\n0,1\n1,abc\n");
    put("b.csv", "step,x\n0\n");
    put("c.csv", "");
    for (const auto& [name, part] : {std::pair{"a.csv", "line 3: \"abc\""},
                                     {"b.csv", "line 2: 1 values for 2"},
                                     {"c.csv", "no header"}}) {
        try {
            read_table(folder_ / name);
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
}

TEST_F(HistoryTest, RefusesRowsAndColumnsThatDoNotFit) {
    History history(folder_ / "history.csv", {"step", "x"});
    EXPECT_THROW(history.add({1}), std::invalid_argument);
    EXPECT_THROW(History(folder_ / "b.csv", {"x", "step"}), std::invalid_argument);
    EXPECT_THROW(History(folder_ / "b.csv", {"step", "x", "x"}), std::invalid_argument);
    EXPECT_THROW(History(folder_ / "none" / "b.csv", {"step"}), FileError);
}

}  // namespace
}  // namespace hemoflux::output
