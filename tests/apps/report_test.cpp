#include <json/json.h>
#include <vtkBase64Utilities.h>

#include <cstdint>
#include <cstring>
#include <regex>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "apps/report/animation.hpp"
#include "apps/report/html.hpp"
#include "apps/report/page.hpp"
#include "exchange/error.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/report_folder.hpp"

namespace hemoflux::report {
namespace {

using Report = ReportFolder;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// The table row of an observable.
std::string row_of(const std::string& page, const std::string& observable) {
    const auto at = page.find("data-observable=\"" + observable + "\"");
    return at == std::string::npos ? "" : page.substr(at, page.find("</tr>", at) - at);
}

/// The data of the first animation.
Json::Value data_of(const std::string& page) {
    const std::string begin = "<script type=\"application/json\">";
    const auto at = page.find(begin) + begin.size();
    std::istringstream text(page.substr(at, page.find("</script>", at) - at));
    Json::Value data;
    text >> data;
    return data;
}

template <class Integer>
std::vector<Integer> unpacked(const std::string& text) {
    std::vector<unsigned char> bytes(text.size());
    const auto length = vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()),
                                                         text.size(), bytes.data(), bytes.size());
    std::vector<Integer> values(length / sizeof(Integer));
    std::memcpy(values.data(), bytes.data(), length);
    return values;
}

TEST_F(Report, HasEveryObservableWithUnitReferenceAndVerdict) {
    const std::string page = build_page({read_run(make_run("out"))});
    const output::Summary summary = example_summary();
    for (const auto& [name, value] : summary.observables) EXPECT_NE(row_of(page, name), "") << name;
    EXPECT_TRUE(has(row_of(page, "mode"), "tank treading"));
    const std::string inclination = row_of(page, "inclination_deg");
    for (const char* part : {"17.745", "degrees", ">20<", "11.28&nbsp;%", "18.5 to 21.5", "OUTSIDE"})
        EXPECT_TRUE(has(inclination, part)) << part << " is not in " << inclination;
    EXPECT_TRUE(has(row_of(page, "taylor_d"), "inside"));
    EXPECT_TRUE(has(row_of(page, "drag_coefficient"), "reported"));
    EXPECT_TRUE(has(row_of(page, "axial_um_at_100_pN"), "Axial at 100\xC2\xA0pN"))
        << row_of(page, "axial_um_at_100_pN");
    EXPECT_TRUE(has(row_of(page, "period_strain"), "\xE2\x80\x93"));
    for (const char* part : {"4.6&nbsp;\xC3\x97&nbsp;10<sup>\xE2\x88\x92"
                             "5</sup>",
                             "4087", "Volume leak", "2&nbsp;%", "prototype &amp; friends"})
        EXPECT_TRUE(has(page, part)) << part;
}

TEST_F(Report, HasCaseConversionEnvironmentAndCharts) {
    const std::string page = build_page({read_run(make_run("out"))});
    for (const char* part :
         {"shear_modulus = &quot;6.1 uN/m&quot;", "<th scope=\"row\">velocity c</th><td>476.2 um/s</td>",
          "<th scope=\"row\">membrane force 1e-11 N</th><td>0.1283 lattice units</td>",
          "<th scope=\"row\">length</th><td>1 um</td>", "Example (R) CPU", "2026-11-25 22:34:53",
          "2026-11-25 22:35:27"})
        EXPECT_TRUE(has(page, part)) << part;
    for (const char* chart : {"inclination", "diameters", "conservation"})
        EXPECT_EQ(count(page, std::string("data-chart=\"") + chart + "\""), 1U) << chart;
    // the centroid moves by rounding only
    EXPECT_FALSE(has(page, "data-chart=\"position\""));
    EXPECT_TRUE(has(page, "class=\"band\"") && has(page, "class=\"window\""));
}

TEST_F(Report, EscapesAllTexts) {
    const fs::path run = make_run("out");
    put("out/resolved.toml",
        apps::example_with("\"Tank treading at 3 /s\"", "'<script>alert(\"x\")</script> & co'"));
    output::Summary summary = example_summary();
    summary.labels["<b>bold</b>"] = "<i>italic</i>";
    summary.references["taylor_d"].source = "\"quoted\" </td>";
    output::write_summary(run / "summary.json", summary);
    put("out/log.txt",
        example_log() + "2026-11-25 22:35:28.000 warning: <img src=x onerror=alert(1)> \xFF\x01\n");
    const std::string page = build_page({read_run(run)});
    for (const char* part : {"<script>alert", "<b>bold", "<i>italic", "\"quoted\" </td>", "<img src=x"})
        EXPECT_FALSE(has(page, part)) << part;
    EXPECT_TRUE(has(page, "&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt; &amp; co"));
    EXPECT_TRUE(has(page, "alert(1)&gt; \xEF\xBF\xBD\xEF\xBF\xBD"));
    EXPECT_EQ(escape("\xED\xA0\x80\xC0\xAF\xE2\x82\xAC"),
              "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xE2\x82\xAC");
}

TEST_F(Report, LoadsNothingFromElsewhere) {
    const fs::path run = make_run("out");
    put("out/picture_01.png", "no real picture");
    put("out/plot_other.svg", "<svg/>");
    const std::string page = build_page({read_run(run), read_run(run)});
    EXPECT_EQ(count(page, "src=\"data:image/png;base64,"), 2U);
    const std::regex outside("(src|href|srcset|action|data)=\"(?!data:|#)|@import|url\\(|https?://");
    std::smatch found;
    EXPECT_FALSE(std::regex_search(page, found, outside)) << found.str();
}

TEST_F(Report, UnfinishedAndFailedRunsSaySo) {
    const fs::path run = make_run("out");
    fs::remove(run / "summary.json");
    EXPECT_EQ(read_run(run).status.ending, Ending::open);
    EXPECT_TRUE(has(build_page({read_run(run)}), "strain 5.85"));
    put("out/log.txt",
        example_log() +
            "2026-11-25 22:36:00.000 warning: interrupted at strain 3; continue with: hemoflux run "
            "--restart out\n");
    EXPECT_EQ(read_run(run).status.ending, Ending::interrupted);
    EXPECT_TRUE(has(build_page({read_run(run)}), "hemoflux run --restart out"));
    const std::string continued = example_log() +
                                  "2026-11-25 22:36:00.000 warning: interrupted at strain 3\n2026-11-25 "
                                  "22:37:00.000 info: continuing from checkpoint_0000000001.bin (step 1)\n";
    put("out/log.txt", continued);
    EXPECT_EQ(read_run(run).status.ending, Ending::open);
    put("out/log.txt",
        continued +
            "2026-11-25 22:38:00.000 debug: node 17 of cell 0 left the domain: it is <lost>. Refine.\n"
            "2026-11-25 22:38:00.000 warning: the last good state (step 3) is kept\n");
    EXPECT_EQ(read_run(run).status.ending, Ending::failed);
    EXPECT_TRUE(has(build_page({read_run(run)}), "node 17 of cell 0 left the domain: it is &lt;lost&gt;."));
    put("out/log.txt",
        "2026-11-25 22:34:53.567 debug: environment   version 0.1.0; backend OMP\n2026-11-25 22:35:00.000 "
        "debug: K_S 5.3 uN/m, c0 1: chi2 3.2\n");
    EXPECT_EQ(read_run(run).status.ending, Ending::open);
}

TEST_F(Report, DoesWithoutWhatIsMissing) {
    put("bare/resolved.toml", "kind = \"membrane\"\n[membrane]\ntask = \"stretch\"\n");
    EXPECT_TRUE(has(build_page({read_run(folder_ / "bare")}), "unfinished"));
    const fs::path run = make_run("out");
    fs::remove(run / "cells_0001.vtp");
    put("out/notes.csv", "not a table, of\nno run");
    std::string page = build_page({read_run(run)});
    EXPECT_TRUE(has(page, "1 of the 4 cell files"));
    EXPECT_EQ(data_of(page)["frames"].size(), 3U);
    for (const char* file : {"cells_0000.vtp", "cells_0002.vtp", "cells_0003.vtp", "history.csv", "log.txt"})
        fs::remove(run / file);
    page = build_page({read_run(run)});
    EXPECT_FALSE(has(page, "<canvas"));
    EXPECT_FALSE(has(page, "data-chart"));
    EXPECT_TRUE(has(row_of(page, "inclination_deg"), "17.745"));
}

TEST_F(Report, RefusesOtherFoldersAndMalformedFiles) {
    put("other/notes.txt", "");
    const std::string message = apps::message_of<InputError>([&] { read_run(folder_ / "other"); });
    EXPECT_TRUE(has(message, "resolved.toml") && has(message, "sweep.toml")) << message;
    EXPECT_THROW(read_run(folder_ / "nowhere"), FileError);
    const fs::path run = make_run("out");
    put("out/summary.json", "{");
    EXPECT_THROW(read_run(run), InputError);
}

TEST_F(Report, SeveralRunsStandSideBySide) {
    const fs::path one = make_run("a/out"), two = make_run("b/out");
    output::Summary summary = example_summary();
    summary.observables["inclination_deg"] = 19;
    summary.observables["only_here_um"] = 3;
    output::write_summary(two / "summary.json", summary);
    const auto runs = read_runs({one, two});
    EXPECT_NE(runs[0].name, runs[1].name);
    const std::string page = build_page(runs);
    const std::string row = row_of(page, "inclination_deg");
    EXPECT_TRUE(has(row, "17.745") && has(row, "OUTSIDE") && has(row, "<td>19<br>") && has(row, "inside"))
        << row;
    EXPECT_TRUE(has(row_of(page, "only_here_um"), "<td>\xE2\x80\x93</td><td>3</td>"));
    EXPECT_EQ(count(page, "<canvas"), 2U);
    EXPECT_EQ(count(page, "data-chart=\"inclination\""), 1U);
    const auto chart = page.substr(page.find("data-chart=\"inclination\""), 20000);
    EXPECT_TRUE(has(chart.substr(0, chart.find("</figure>")), runs[1].name));
    EXPECT_EQ(count(chart.substr(0, chart.find("</figure>")), "class=\"line c1 d1\""),
              2U);  // curve and legend
}

TEST_F(Report, FramesArePackedWithoutLoss) {
    const Json::Value data = data_of(animation(read_run(make_run("out"))));
    ASSERT_EQ(data["frames"].size(), 4U);
    EXPECT_EQ(data["meshes"].size(), 1U);
    EXPECT_EQ(data["at"][3].asDouble(), 1.5);
    EXPECT_EQ(data["label"].asString(), "strain");
    const double step = data["step"].asDouble();
    EXPECT_LT(step, 8.0 / 65000);
    for (int f = 0; f < 4; ++f) {
        const auto packed = unpacked<std::int16_t>(data["frames"][f].asString());
        const meshing::SurfaceMesh mesh = frame(f);
        ASSERT_EQ(packed.size(), 3 * mesh.vertices.size());
        // the ellipsoid is centred
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
            EXPECT_NEAR(packed[3 * v] * step, mesh.vertices[v].x, 2 * step);
            EXPECT_NEAR(packed[3 * v + 1] * step, mesh.vertices[v].y, 2 * step);
            EXPECT_NEAR(packed[3 * v + 2] * step, mesh.vertices[v].z, 2 * step);
        }
    }
    const auto corners = unpacked<std::uint16_t>(data["meshes"][0]["triangles"].asString());
    const auto triangles = frame(0).triangles;
    ASSERT_EQ(corners.size(), 3 * triangles.size());
    for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(corners[i], triangles[i / 3][i % 3]);
}

TEST_F(Report, LongSeriesAreThinnedEvenly) {
    const Json::Value data = data_of(animation(read_run(make_run("out", 9)), 5 * 6 * 162));
    ASSERT_EQ(data["at"].size(), 5U);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(data["at"][i].asDouble(), 1.0 * i);
}

TEST_F(Report, SweepHasItsRunsAndCharts) {
    put("sweep/sweep.toml", "title = \"Orders\"\nkind = \"fluid\"\n[grid]\ncells = [8, 8, 1]\n");
    put("sweep/sweep.csv",
        "grid.cells,error,mode\n\"[8, 8, 1]\",0.4,slow\n\"[16, 16, 1]\",0.1,slow\n\"[32, 32, 1]\",nan,nan\n");
    output::Summary summary;
    summary.observables = {{"order_error", 2.0}};
    output::write_summary(folder_ / "sweep/summary.json", summary);
    const RunRecord run = read_run(folder_ / "sweep");
    ASSERT_TRUE(run.sweep);
    EXPECT_EQ(run.sweep->keys, 1U);
    EXPECT_EQ(run.sweep->abscissas(), (std::vector<double>{8, 16, 32}));
    EXPECT_EQ(run.status.ending, Ending::failed);  // one of the three
    const std::string page = build_page({run});
    EXPECT_TRUE(has(page, "<th scope=\"row\">[16, 16, 1]</th><td>0.1</td><td>slow</td>"));
    EXPECT_TRUE(has(page, "data-chart=\"sweep_error\""));
    put("sweep/sweep.csv", "grid.cells,error\n\"[8, 8, 1]\"\n");
    EXPECT_THROW(read_run(folder_ / "sweep"), InputError);
}

using ReportCommand = apps::Program;

TEST_F(ReportCommand, ReportsARealRunAndRefusesTheRest) {
    ASSERT_EQ(run(apps::small_run + "--output out --set output.interval_strain=0.1").code, 0);
    const Outcome outcome = run("report out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const std::string page = content("out/report.html");
    EXPECT_TRUE(has(page, "<canvas") && has(page, "data-chart=\"tank_treading\"") &&
                has(page, "Processor</th>"));
    for (const auto& [name, value] : output::read_summary(folder_ / "out/summary.json").observables)
        EXPECT_NE(row_of(page, name), "") << name;
    EXPECT_EQ(run("report out out --output both.html").code, 0);
    EXPECT_TRUE(has(content("both.html"), "Comparison of 2 runs"));

    fs::create_directory(folder_ / "empty");
    expect_error("report empty", 2, "resolved.toml");
    expect_error("report nowhere", 4, "nowhere");
    expect_error("report out --output nowhere/page.html", 4, "nowhere/page.html");
    expect_error("report", 2, "DIR");
    std::ofstream(folder_ / "out/cells_0001.vtp") << "torn";
    expect_error("report out --output torn.html", 2, "cells_0001.vtp");
    EXPECT_FALSE(fs::exists(folder_ / "torn.html"));
    // the page belongs to the run and goes with it
    ASSERT_EQ(run(apps::small_run + "--output out").code, 0);
    EXPECT_FALSE(fs::exists(folder_ / "out/report.html"));
}

}  // namespace
}  // namespace hemoflux::report
