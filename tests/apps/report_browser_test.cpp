// The report page in headless Chromium: what a reader sees, not what the page's source says.
#include <fmt/format.h>
#include <json/json.h>

#include <chrono>
#include <sstream>

#include "apps/output/atomic_file.hpp"
#include "apps/output/child.hpp"
#include "apps/report/page.hpp"
#include "tests/apps/report_folder.hpp"

namespace hemoflux::report {
namespace {

/// Runs in the page before its own script: collects errors.
constexpr const char* watcher = R"(<script>
window.errors = [];
addEventListener("error", (e) => errors.push(String(e.message)));
addEventListener("unhandledrejection", (e) => errors.push(String(e.reason)));
const complain = console.error;
console.error = (...words) => { errors.push(words.join(" ")); complain(...words); };
</script>)";

/// Runs when the page is there: looks at it, moves the slider, plays, turns the view, and leaves its findings in the
/// attribute data-found of <html>.
constexpr const char* prober = R"(<script>
addEventListener("load", async () => {
  const rest = () => new Promise((done) => setTimeout(done, 50));
  await rest();
  const found = { errors, charts: [], width: document.documentElement.scrollWidth, room: innerWidth };
  document.querySelectorAll("figure.chart > svg").forEach((svg) => {
    const box = svg.getBoundingClientRect();
    const lines = [...svg.querySelectorAll("path.line")].filter((p) => p.getTotalLength() > 20).length;
    const sizes = [...svg.querySelectorAll("text")].map((t) => t.getBoundingClientRect().height);
    found.charts.push({ width: box.width, height: box.height, lines, texts: sizes.length, smallest: Math.min(...sizes) });
  });
  const canvas = document.querySelector("canvas"), slider = document.querySelector("input[type=range]");
  const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const look = () => {
    copy.canvas.width = canvas.width;
    copy.canvas.height = canvas.height;
    copy.drawImage(canvas, 0, 0);
    const data = copy.getImageData(0, 0, canvas.width, canvas.height).data;
    let sum = 0, drawn = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 0) drawn++;
      sum = (sum * 31 + data[i] + 7 * data[i + 1] + 13 * data[i + 2]) % 1000000007;
    }
    return { sum, part: drawn / (data.length / 4) };
  };
  const at = (value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
    return { ...look(), label: document.querySelector("output").textContent };
  };
  found.first = at(0);
  found.last = at(slider.max);
  found.again = at(0);
  canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
  found.turned = look();
  document.querySelector("button.play").click();
  await new Promise((done) => setTimeout(done, 2500));
  found.played = Number(slider.value) !== 0 || look().sum !== found.turned.sum;
  document.querySelector("button.play").click();
  found.reachable = [...document.querySelectorAll("canvas, input, button, summary")].every((e) => e.tabIndex >= 0);
  document.documentElement.setAttribute("data-found", JSON.stringify(found));
});
</script>)";

/// The page in a frame, which hands the findings on; braces as fmt wants them.
constexpr const char* frame_page = R"(<!DOCTYPE html><body style="margin:0">
<iframe id="page" src="page.html" style="border:0;width:{}px;height:900px"></iframe><script>
const wait = setInterval(() => {{
  const found = document.getElementById("page").contentDocument?.documentElement?.getAttribute("data-found");
  if (!found) return;
  clearInterval(wait);
  document.documentElement.setAttribute("data-found", btoa(found));
}}, 50);
</script></body>)";

class ReportInBrowser : public ReportFolder {
  protected:
    void SetUp() override {
        ReportFolder::SetUp();
        if (!output::find_program("chromium"))
            GTEST_SKIP()
                << "chromium is not installed (Debian package chromium): the report page is not looked at";
    }

    /// What the prober finds in a window of this width. A frame makes the width: windows have a least one.
    Json::Value found_in(const std::string& page, int width) const {
        std::string probed = page;
        probed.insert(probed.find("<meta charset"), watcher);
        probed.insert(probed.rfind("</body>"), prober);
        put("page.html", probed);
        put("frame.html", fmt::format(fmt::runtime(frame_page), width));
        const output::ChildResult result = output::run_child(
            {"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             "--no-first-run", "--allow-file-access-from-files", "--enable-logging=stderr",
             "--window-size=1280,1000", "--virtual-time-budget=20000",
             "--user-data-dir=" + (folder_ / "profile").string(), "--dump-dom",
             "file://" + (folder_ / "frame.html").string()},
            "", std::chrono::seconds(240));
        EXPECT_TRUE(result.ok()) << result.why();
        EXPECT_EQ(result.output.find(":CONSOLE"), std::string::npos)
            << result.output.substr(result.output.find(":CONSOLE"), 400);
        const std::string mark = "data-found=\"";
        const auto from = result.output.find(mark);
        if (from == std::string::npos) {
            ADD_FAILURE() << "the page's script did not come to its end:\n" << result.output.substr(0, 3000);
            return {};
        }
        const std::string text = result.output.substr(
            from + mark.size(), result.output.find('"', from + mark.size()) - from - mark.size());
        return decoded(text);
    }

    static Json::Value decoded(const std::string& base64) {
        static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        unsigned bits = 0, count = 0;
        for (const char c : base64) {
            const auto digit = digits.find(c);
            if (digit == std::string::npos) break;
            bits = bits << 6 | static_cast<unsigned>(digit);
            if ((count += 6) >= 8) text += static_cast<char>(bits >> (count -= 8) & 0xFF);
        }
        std::istringstream stream(text);
        Json::Value value;
        stream >> value;
        return value;
    }

    static void expect_sound(const Json::Value& found, int width) {
        ASSERT_TRUE(found.isObject());
        EXPECT_EQ(found["errors"].size(), 0U) << found["errors"];
        EXPECT_LE(found["width"].asInt(), width) << "the page overflows at " << width << " px";
        ASSERT_GE(found["charts"].size(), 3U);
        for (const Json::Value& chart : found["charts"]) {
            EXPECT_GE(chart["lines"].asInt(), 1);
            EXPECT_GE(chart["texts"].asInt(), 6);
            EXPECT_GT(chart["width"].asDouble(), 0.8 * std::min(width, 420));
            EXPECT_LE(chart["width"].asDouble(), width);
            EXPECT_GE(chart["smallest"].asDouble(), 10) << "texts too small to read";
        }
        EXPECT_GT(found["first"]["part"].asDouble(), 0.05) << "the canvas is empty";
        EXPECT_NE(found["first"]["sum"], found["last"]["sum"]) << "the animation does not move";
        EXPECT_EQ(found["first"]["sum"], found["again"]["sum"]);
        EXPECT_EQ(found["first"]["label"].asString(), "strain 0");
        EXPECT_EQ(found["last"]["label"].asString(), "strain 1.5");
        EXPECT_NE(found["first"]["sum"], found["turned"]["sum"]) << "arrow keys do not turn the view";
        EXPECT_TRUE(found["played"].asBool());
        EXPECT_TRUE(found["reachable"].asBool());
    }
};

TEST_F(ReportInBrowser, OneRunAtDesktopAndPhoneWidth) {
    const std::string page = build_page({read_run(make_run("out"))});
    for (const int width : {1100, 360}) expect_sound(found_in(page, width), width);
}

TEST_F(ReportInBrowser, SeveralRunsAtPhoneWidth) {
    const auto runs = read_runs(
        {make_run("a/a_rather_long_name_of_a_folder_of_a_run"), make_run("b/out"), make_run("c/fine")});
    expect_sound(found_in(build_page(runs), 360), 360);
}

}  // namespace
}  // namespace hemoflux::report
