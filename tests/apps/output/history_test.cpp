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

TEST_F(HistoryTest, ResumeDropsLaterRowsAndGivesTheFileOfAnUninterruptedRun) {
    const auto row = [](int i) { return std::vector<double>{10.0 * i, std::sin(i)}; };
    {
        History whole(folder_ / "whole.csv", {"step", "x"});
        for (int i = 0; i < 9; ++i) whole.add(row(i));
        History broken(folder_ / "broken.csv", {"step", "x"});
        for (int i = 0; i < 7; ++i) broken.add(row(i));
    }
    put("broken.csv", content("broken.csv") + "70,0.65");  // killed in the middle of a row
    History resumed = History::resume(folder_ / "broken.csv", {"step", "x"}, 40);
    EXPECT_EQ(read_table(folder_ / "broken.csv").rows.size(), 5u);
    for (int i = 5; i < 9; ++i) resumed.add(row(i));
    EXPECT_EQ(content("broken.csv"), content("whole.csv"));
}

TEST_F(HistoryTest, ResumeNamesTheColumnThatDiffers) {
    { History(folder_ / "history.csv", {"step", "time_s", "x"}); }
    try {
        History::resume(folder_ / "history.csv", {"step", "strain", "x"}, 0);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("time_s where this run writes strain"), std::string::npos)
            << error.what();
    }
    EXPECT_THROW(History::resume(folder_ / "history.csv", {"step", "time_s"}, 0), InputError);
    EXPECT_THROW(History::resume(folder_ / "none.csv", {"step"}, 0), FileError);
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
