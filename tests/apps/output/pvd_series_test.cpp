#include "apps/output/pvd_series.hpp"

#include <boost/property_tree/xml_parser.hpp>

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class PvdSeriesTest : public TemporaryFolder {};

TEST_F(PvdSeriesTest, IsValidAfterEveryFrame) {
    PvdSeries series(folder_ / "cells.pvd");
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(series.next(), i);
        series.add(0.1 * i, folder_ / ("cells_000" + std::to_string(i) + ".vtp"));
        boost::property_tree::ptree tree;
        boost::property_tree::read_xml((folder_ / "cells.pvd").string(), tree);
        EXPECT_EQ(tree.get<std::string>("VTKFile.<xmlattr>.type"), "Collection");
        EXPECT_EQ(tree.get_child("VTKFile.Collection").count("DataSet"), static_cast<std::size_t>(i) + 1);
        const auto frames = read_pvd(folder_ / "cells.pvd");
        ASSERT_EQ(frames.size(), static_cast<std::size_t>(i) + 1);
        EXPECT_EQ(frames.back().time, 0.1 * i);  // all digits
        EXPECT_EQ(frames.back().file, "cells_000" + std::to_string(i) + ".vtp");
    }
}

TEST_F(PvdSeriesTest, ResumeDropsLaterFrames) {
    {
        PvdSeries series(folder_ / "fluid.pvd");
        for (int i = 0; i < 4; ++i) series.add(i, folder_ / "x.vtr");
    }
    PvdSeries series = PvdSeries::resume(folder_ / "fluid.pvd", 1);
    EXPECT_EQ(series.next(), 2);
    series.add(1.5, folder_ / "y.vtr");
    EXPECT_EQ(read_pvd(folder_ / "fluid.pvd").size(), 3u);
    EXPECT_EQ(PvdSeries::resume(folder_ / "none.pvd", 1).next(), 0);
}

TEST_F(PvdSeriesTest, RefusesOtherFiles) {
    put("a.pvd", "step,time\n0,1\n");
    put("b.pvd", "<VTKFile><Collection><DataSet file=\"x\"/></Collection></VTKFile>");
    put("c.pvd", "");
    for (const char* name : {"a.pvd", "b.pvd", "c.pvd"})
        EXPECT_THROW(read_pvd(folder_ / name), InputError) << name;
    EXPECT_THROW(read_pvd(folder_ / "none.pvd"), FileError);
}

}  // namespace
}  // namespace hemoflux::output
