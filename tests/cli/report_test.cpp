// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Without what times decide.
json withoutTimes(json value) {
    if (value.is_object()) value.erase("time");
    if (value.is_structured())
        for (json& member : value) member = withoutTimes(member);
    return value;
}

/// Rows without the columns that times decide; of automatic, which chooses by times, only the setting.
std::vector<std::vector<std::string>> csvWithoutTimes(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::vector<bool> kept;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        const std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        std::vector<std::string> cells;
        for (std::size_t at = 0; at <= line.size();) {
            const std::size_t comma = std::min(line.find(',', at), line.size());
            cells.push_back(line.substr(at, comma - at));
            at = comma + 1;
        }
        if (kept.empty())
            for (const std::string& name : cells)
                kept.push_back(!name.ends_with("_ms") && name != "warm_frames" && name != "pareto");
        const bool automatic = cells[1] == "automatic";
        std::vector<std::string> row;
        for (std::size_t i = 0; i < cells.size() && (i < 8 || !automatic); ++i)
            if (kept.at(i)) row.push_back(cells[i]);
        rows.push_back(std::move(row));
    }
    return rows;
}

class Report : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        writeBallScene("scene.json", R"(, "lights": [])");
    }
    [[nodiscard]] Outcome quick(const std::string& folder) const {
        return run({"report", "scene.json", "-o", folder, "--quick"});
    }
    [[nodiscard]] std::ptrdiff_t count(const std::string& file, const std::string& word) const {
        const std::string text = read(file);
        std::ptrdiff_t found = 0;
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
        return found;
    }
};

TEST_F(Report, QuickIsCompleteInUnderAMinute) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = quick("r");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
    const json report = json::parse(read("r/report.json"));
    for (const char* section :
         {"scene", "machine", "scope", "references", "measurements", "series", "stalls"})
        EXPECT_FALSE(report.at(section).empty()) << section;
    EXPECT_FALSE(report.at("time").at("paretoFronts").at("trilinear").empty());
    EXPECT_FALSE(report.at("scope").at("reductions").empty());
    EXPECT_EQ(report.at("measurements").size(), report.at("planned"));
    EXPECT_EQ(count("r/report.csv", "\n"), static_cast<std::ptrdiff_t>(report.at("measurements").size()) + 1);
    for (const json& m : report.at("measurements")) {
        EXPECT_GT(m.at("time").at("wallMs"), 0.0);
        const json& found = m.at("setting").at("automatic") ? m.at("time") : m;
        EXPECT_GT(found.at("bytes"), 16 * 16 * 16);
        EXPECT_GE(found.at("error").at("max"), found.at("error").at("rmse"));
    }
    // The reference and the renderer are independent: at half a voxel they agree to a fraction of a grey
    // level.
    for (const json& m : report.at("measurements")) {
        if (m.at("name") != "simpson, trilinear, float32, step 0.5") continue;
        EXPECT_LT(m.at("error").at("rmse"), 1e-3);
    }
}

TEST_F(Report, ThePageNeedsNothingElse) {
    ASSERT_EQ(quick("r").status, 0);
    const std::string html = read("r/index.html");
    for (const char* word : {"http:", "https:", "<script", "url(", "<link"})
        EXPECT_THAT(html, testing::Not(HasSubstr(word)));
    for (const char* id : {"work-precision", "convergence", "formats", "filters", "jitter"})
        EXPECT_THAT(html, HasSubstr(std::string("<svg id=\"") + id + "\""));
    for (const char* id : {"time-to-error", "orders", "pareto", "tolerances", "stalls", "differences",
                           "references", "measurements"})
        EXPECT_THAT(html, HasSubstr(std::string("<h2 id=\"") + id + "\""));
    EXPECT_EQ(count("r/index.html", "src=\""),
              count("r/index.html", "src=\"data:image/png;base64,iVBORw0KGgo"));
    EXPECT_GE(count("r/index.html", "<figure>"), 11);  // the reference, nine integrators, two formats
    EXPECT_THAT(html, HasSubstr("32 times as bright"));
    const std::string head = html.substr(0, html.find("<h2"));
    EXPECT_THAT(
        head,
        HasSubstr(
            "<dt>References</dt><dd>last two pictures, at half the step, differ by at most trilinear "));
    EXPECT_EQ(html.find("id=\"left-out\""), std::string::npos) << "nothing was";
}

TEST_F(Report, TwoRunsAreEqualApartFromTimes) {
    ASSERT_EQ(quick("a").status, 0);
    ASSERT_EQ(quick("b").status, 0);
    EXPECT_EQ(withoutTimes(json::parse(read("a/report.json"))),
              withoutTimes(json::parse(read("b/report.json"))));
    EXPECT_EQ(csvWithoutTimes(read("a/report.csv")), csvWithoutTimes(read("b/report.csv")));
}

TEST_F(Report, ASecondRunMeasuresNothingAgain) {
    ASSERT_EQ(quick("r").status, 0);
    const std::string kept = read("r/measurements.jsonl");
    const std::string before = read("r/report.json");
    ASSERT_EQ(quick("r").status, 0);
    EXPECT_EQ(read("r/measurements.jsonl"), kept);
    EXPECT_EQ(read("r/report.json"), before) << "the times are those of the first run";
}

TEST_F(Report, WhatTheTimeDoesNotAllowIsLeftOutAndSaidAndMeasuredByTheNextRun) {
    const Outcome outcome = run({"report", "scene.json", "-o", "r", "--quick", "--budget", "0.00001"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("0 of "));
    EXPECT_THAT(outcome.out, HasSubstr("the time was up"));
    const json report = json::parse(read("r/report.json"));
    EXPECT_EQ(report.at("measurements").size(), 0u);
    EXPECT_EQ(report.at("time").at("leftOut").size(), report.at("planned"));
    EXPECT_EQ(report.at("time").at("leftOut").front().at("setting"), "riemann, trilinear, float32, step 4");
    EXPECT_THAT(read("r/index.html"), HasSubstr("<h2 id=\"left-out\""));
    ASSERT_EQ(quick("r").status, 0);
    const json complete = json::parse(read("r/report.json"));
    EXPECT_EQ(complete.at("measurements").size(), complete.at("planned"));
    EXPECT_TRUE(complete.at("time").at("leftOut").empty());
}

TEST_F(Report, WhatACutOffLineHeldIsMeasuredAgain) {
    ASSERT_EQ(quick("r").status, 0);
    const std::string kept = read("r/measurements.jsonl");
    write("r/measurements.jsonl", kept.substr(0, kept.size() - 30));
    ASSERT_EQ(quick("r").status, 0);
    const json report = json::parse(read("r/report.json"));
    EXPECT_EQ(report.at("measurements").size(), report.at("planned"));
    EXPECT_EQ(count("r/measurements.jsonl", "\"key\""), std::count(kept.begin(), kept.end(), '\n') / 2 + 1);
}

TEST_F(Report, AnotherSceneDoesNotUseTheMeasurements) {
    ASSERT_EQ(quick("r").status, 0);
    const json before = json::parse(read("r/report.json"));
    writeBallScene("scene.json", R"(, "lights": [], "densityScale": 2)");
    ASSERT_EQ(quick("r").status, 0);
    const json after = json::parse(read("r/report.json"));
    EXPECT_NE(after.at("scene").at("hash"), before.at("scene").at("hash"));
    EXPECT_NE(withoutTimes(after.at("measurements")), withoutTimes(before.at("measurements")));
}

TEST_F(Report, CancelledItKeepsWhatIsFinishedAndGoesOn) {
    const auto full = [&](int interruptAfterMs) {
        return run({"report", "scene.json", "-o", "r", "--size", "16x16"}, interruptAfterMs);
    };
    const Outcome cancelled = full(3000);
    ASSERT_EQ(cancelled.status, 130) << cancelled.err;
    EXPECT_THAT(cancelled.err, HasSubstr("goes on from there"));
    EXPECT_FALSE(exists("r/report.json"));
    const std::string kept = read("r/measurements.jsonl");
    ASSERT_FALSE(kept.empty());
    EXPECT_EQ(full(3000).status, 130);
    const std::string later = read("r/measurements.jsonl");
    EXPECT_TRUE(later.starts_with(kept));
    EXPECT_GT(later.size(), kept.size());
}

TEST_F(Report, PeersWithoutADisplayAreLeftOutWithASentence) {
    const Outcome outcome = run({"report", "scene.json", "-o", "r", "--quick", "--peers"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, HasSubstr("Peers were left out"));
    EXPECT_THAT(json::parse(read("r/report.json")).at("notes").dump(), HasSubstr("Peers were left out"));
}

TEST_F(Report, WhatCannotBeReadIsRefused) {
    expectRefusal({"report", "gone.json", "-o", "r"}, {"gone.json"});
}

}  // namespace
}  // namespace pellucid::cli
