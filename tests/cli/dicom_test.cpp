// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/synthetic_dicom.h"

// DICOM series from the command line: what is refused, what is read, and how one of several is chosen.
namespace pellucid::cli {
namespace {

namespace fs = std::filesystem;
using test::SyntheticSeries;

class Dicom : public ProgramTest {
protected:
    void expectRefusedByAll(const std::string& input, const std::vector<std::string>& words) const {
        expectRefusal({"render", input, "-o", "out.png"}, words);
        expectRefusal({"info", input}, words);
        expectRefusal({"plan", input}, words);
    }
};

TEST_F(Dicom, ASeriesIsDescribedAsItWasWritten) {
    const SyntheticSeries series;
    test::writeSeries(series, path("ct"));
    const Outcome outcome = run({"info", "ct", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto volume = nlohmann::json::parse(outcome.out)["volumes"][0];
    EXPECT_EQ(volume["size"], nlohmann::json({series.size.x, series.size.y, series.slices}));
    EXPECT_EQ(volume["spacingMm"], nlohmann::json({series.spacingMm.x, series.spacingMm.y, series.stepMm.z}));
    EXPECT_EQ(volume["originMm"], nlohmann::json({series.originMm.x, series.originMm.y, series.originMm.z}));
    EXPECT_EQ(volume["unit"], "HU");
    EXPECT_EQ(volume["axes"][2]["towards"], "S");
    // i + 10 j + 100 k - 1024 over 7x5x4 voxels
    EXPECT_EQ(volume["ranges"][0]["physical"], nlohmann::json({-1024.0, 6.0 + 40.0 + 300.0 - 1024.0}));
    EXPECT_EQ(run({"render", "ct", "-o", "ct.png", "--size", "16x16"}).status, 0);
}

TEST_F(Dicom, AMissingSliceIsRefusedWithTheGap) {
    const auto files = test::writeSeries(SyntheticSeries{}, path("ct"));
    fs::remove(files[1]);
    expectRefusedByAll("ct", {files[0].filename().string(), files[2].filename().string(), "5", "2.5", "mm"});
}

TEST_F(Dicom, TwoSeriesInOneFolderAreRefusedAndOneCanBeChosen) {
    SyntheticSeries first;
    first.fileName = [](int k) { return "a" + std::to_string(k); };
    SyntheticSeries second;
    second.seriesUid = "1.2.3.99";
    second.slices = 3;
    second.description = "Thin";
    second.fileName = [](int k) { return "b" + std::to_string(k); };
    test::writeSeries(first, path("both"));
    test::writeSeries(second, path("both"));
    expectRefusedByAll("both", {"1.2.3.4.5", "1.2.3.99", "Thin", "--series"});
    const Outcome chosen = run({"info", "both", "--json", "--series", "1.2.3.99"});
    ASSERT_EQ(chosen.status, 0) << chosen.err;
    EXPECT_EQ(nlohmann::json::parse(chosen.out)["volumes"][0]["size"][2], 3);
    expectRefusal({"info", "both", "--series", "1.2.3.7"}, {"1.2.3.7", "1.2.3.99"});
}

TEST_F(Dicom, ATruncatedSliceIsRefusedByName) {
    const auto files = test::writeSeries(SyntheticSeries{}, path("ct"));
    fs::resize_file(files[2], fs::file_size(files[2]) - 8);
    expectRefusedByAll("ct", {files[2].filename().string()});
}

}  // namespace
}  // namespace pellucid::cli
