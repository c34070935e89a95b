#include "apps/output/summary.hpp"

#include <boost/property_tree/json_parser.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "exchange/error.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class SummaryTest : public TemporaryFolder {};
using Tree = boost::property_tree::ptree;

Summary example() {
    Summary s;
    s.case_name = "Tank treading \"quick\" \xC2\xB5m";
    s.version = "0.1.0";
    s.backend = "OMP";
    s.threads = 2;
    s.observables = {{"inclination_deg", 20.1}, {"period_strain", NAN}, {"third", 1.0 / 3.0}};
    s.references["inclination_deg"] = {20.0, 18.5, 21.5, "prototype"};
    s.references["period_strain"] = {{}, 19, 22, "prototype"};
    s.conservation.volume = 1e-5;
    s.performance.wall_s = 12.5;
    s.performance.steps = 4200;
    s.performance.peak_rss_mib = INFINITY;
    s.errors_estimated["time_step"] = 0.01;
    s.labels["mode"] = "tank treading";
    return s;
}

Tree parse(const Summary& summary) {
    std::istringstream text(to_json(summary));
    Tree tree;
    boost::property_tree::read_json(text, tree);
    return tree;
}

std::set<std::string> keys(const Tree& tree) {
    std::set<std::string> names;
    for (const auto& [name, child] : tree) names.insert(name);
    return names;
}

using Keys = std::set<std::string>;

TEST_F(SummaryTest, HasTheSameShapeForEveryRun) {
    for (const Summary& summary : {example(), Summary{}}) {
        const Tree tree = parse(summary);
        EXPECT_EQ(keys(tree), (Keys{"case", "version", "backend", "threads", "observables", "labels",
                                    "references", "conservation", "performance", "errors_estimated"}));
        EXPECT_EQ(keys(tree.get_child("conservation")),
                  (Keys{"volume", "area", "mean_density_per_strain", "centroid_um"}));
        EXPECT_EQ(keys(tree.get_child("performance")),
                  (Keys{"wall_s", "cpu_s", "steps", "residuals_per_strain", "cell_residuals_per_s",
                        "peak_rss_mib"}));
    }
    EXPECT_NE(to_json(Summary{}).find("\"observables\" : {}"), std::string::npos) << to_json(Summary{});
    EXPECT_EQ(keys(parse(example()).get_child("references.inclination_deg")),
              (Keys{"value", "reference", "low", "high", "source"}));
}

TEST_F(SummaryTest, WritesNullForWhatIsNotAFiniteNumber) {
    const std::string text = to_json(example());
    EXPECT_NE(text.find("\"period_strain\" : null"), std::string::npos) << text;
    EXPECT_NE(text.find("\"peak_rss_mib\" : null"), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
    EXPECT_NE(text.find("\"steps\" : 4200,"), std::string::npos);
}

TEST_F(SummaryTest, ReadsBackExactly) {
    const Summary s = example();
    write_summary(folder_ / "summary.json", s);
    const Summary r = read_summary(folder_ / "summary.json");
    EXPECT_EQ(r.case_name, s.case_name);
    EXPECT_EQ(r.threads, 2);
    EXPECT_EQ(r.observables.at("third"), 1.0 / 3.0);
    EXPECT_TRUE(std::isnan(r.observables.at("period_strain")));
    EXPECT_EQ(r.references.at("inclination_deg").high, 21.5);
    EXPECT_FALSE(r.references.at("period_strain").reference.has_value());
    EXPECT_EQ(r.conservation.volume, 1e-5);
    EXPECT_TRUE(std::isnan(r.conservation.area));
    EXPECT_EQ(r.performance.steps, 4200);
    EXPECT_EQ(r.errors_estimated.at("time_step"), 0.01);
    EXPECT_EQ(r.labels.at("mode"), "tank treading");
    EXPECT_EQ(to_json(r), to_json([&] {
                  Summary finite = s;
                  finite.performance.peak_rss_mib = NAN;
                  return finite;
              }()));
}

TEST_F(SummaryTest, RefusesWhatIsNoSummary) {
    put("a.json", "{\"case\": ");
    put("b.json", "{\"case\": \"x\", \"threads\": \"two\"}");
    EXPECT_THROW(read_summary(folder_ / "a.json"), InputError);
    EXPECT_THROW(read_summary(folder_ / "b.json"), InputError);
    EXPECT_THROW(read_summary(folder_ / "none.json"), FileError);
}

TEST_F(SummaryTest, ComparesWithReferences) {
    Summary s = example();
    s.observables["area_um2"] = 135;
    s.references["area_um2"] = {100.0, {}, {}, "x"};
    s.observables["error"] = 0.2;
    s.references["error"] = {{}, {}, 0.1, "x"};
    s.references["missing"] = {1.0, {}, {}, "x"};
    using V = Comparison::Verdict;
    std::map<std::string, Comparison> by_name;
    for (const Comparison& c : compare(s)) by_name.emplace(c.name, c);
    EXPECT_EQ(by_name.at("inclination_deg").verdict, V::inside);
    EXPECT_NEAR(by_name.at("inclination_deg").relative.value(), 0.005, 1e-14);
    EXPECT_EQ(by_name.at("period_strain").verdict, V::outside);  // the run did not measure it
    EXPECT_FALSE(by_name.at("period_strain").relative.has_value());
    EXPECT_EQ(by_name.at("area_um2").verdict, V::reported);
    EXPECT_NEAR(by_name.at("area_um2").relative.value(), 0.35, 1e-14);
    EXPECT_EQ(by_name.at("error").verdict, V::outside);
    EXPECT_EQ(by_name.at("missing").verdict, V::outside);
    s.observables["inclination_deg"] = 18.5;  // the ends belong to the interval
    EXPECT_EQ(compare(s).at(2).name, "inclination_deg");
    EXPECT_EQ(compare(s).at(2).verdict, V::inside);
}

TEST_F(SummaryTest, TableSaysHowFarEachObservableIs) {
    const std::string table = to_table(example());
    for (const char* part : {"inclination_deg", "20.1", "+0.50 %", "18.5 .. 21.5", "inside", "OUTSIDE",
                             "prototype", "third", "1.00e-05", "12.5 s"})
        EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
    EXPECT_EQ(table.find("centroid"), std::string::npos) << "what was not measured is left out";
}

TEST_F(SummaryTest, MeasuresThisProcess) {
    EXPECT_GT(peak_rss_mib(), 1);
    const double before = cpu_seconds();
    volatile double sum = 0;
    while (cpu_seconds() < before + 0.02) sum = sum + 1;
    EXPECT_LT(cpu_seconds(), before + 10);
}

}  // namespace
}  // namespace hemoflux::output
