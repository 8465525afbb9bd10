// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

// What is read, and what is refused: each refusal with a sentence that says what and where, and no output
// file.
namespace pellucid::cli {
namespace {

using testing::HasSubstr;

class Input : public ProgramTest {
protected:
    /// The same sentence whatever the command.
    void expectRefusedByAll(const std::string& input, const std::vector<std::string>& options,
                            const std::vector<std::string>& words) const {
        for (std::vector<std::string> command :
             {std::vector<std::string>{"render", input, "-o", "out.png"},
              std::vector<std::string>{"info", input}, std::vector<std::string>{"plan", input}}) {
            command.insert(command.end(), options.begin(), options.end());
            expectRefusal(command, words);
        }
    }
};

std::string nrrd(const std::string& sizes, std::size_t bytes) {
    return "NRRD0004\ntype: uint8\ndimension: 3\nsizes: " + sizes + "\nencoding: raw\n\n" +
           std::string(bytes, '\7');
}

TEST_F(Input, WhatIsNotThereIsRefused) {
    expectRefusedByAll("gone.nrrd", {}, {"gone.nrrd"});
}

TEST_F(Input, AnEmptyFolderIsRefused) {
    std::filesystem::create_directory(path("empty"));
    expectRefusedByAll("empty", {}, {"empty"});
}

TEST_F(Input, ATextIsRefused) {
    write("letter.txt", "Dear radiologist,\n");
    expectRefusedByAll("letter.txt", {}, {"letter.txt"});
}

TEST_F(Input, ATruncatedFileIsRefusedWithBothNumbers) {
    write("whole.nrrd", nrrd("4 5 6", 120));
    EXPECT_EQ(run({"info", "whole.nrrd"}).status, 0);
    write("short.nrrd", nrrd("4 5 6", 119));
    expectRefusedByAll("short.nrrd", {}, {"short.nrrd", "120", "119"});
}

TEST_F(Input, ARawFileOfAnotherSizeIsRefusedWithBothNumbers) {
    writeBall("ball.raw");
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x17"}, {"ball.raw", "4352", "4096"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-type", "int16"},
                       {"ball.raw", "8192", "4096"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-header", "4"}, {"ball.raw", "4096"});
}

TEST_F(Input, RawOptionsAreRefusedByName) {
    writeBall("ball.raw");
    expectRefusedByAll("ball.raw", {"--raw-type", "uint8"}, {"--raw-size"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16"}, {"--raw-size", "16x16", "64x64x93"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16x1"}, {"--raw-size", "16x16x16x1"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-type", "int12"}, {"int12"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-endian", "middle"},
                       {"--raw-endian", "middle"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-spacing", "1x1"},
                       {"--raw-spacing", "1x1"});
    expectRefusedByAll("ball.raw", {"--raw-size", "16x16x16", "--raw-spacing", "1x0x1"}, {"spacing"});
    expectRefusedByAll("ball.raw", {"--raw-size", "99999x99999x99999"}, {"99999"});
}

TEST_F(Input, ASceneIsRefusedByThePlaceInIt) {
    writeBall("ball.raw");
    write("broken.json", "{\"pellucid\": 1,\n \"volumes\": [}");
    expectRefusedByAll("broken.json", {}, {"broken.json", "line 2"});
    write("future.json", R"({"pellucid": 2})");
    expectRefusedByAll("future.json", {}, {"future.json", "/pellucid", "2"});
    write("misspelt.json", R"({"pellucid": 1, "volumes": [{"source": "ball.raw", "filtre": "nearest"}]})");
    expectRefusedByAll("misspelt.json", {}, {"misspelt.json", "/volumes/0", "filtre", "filter"});
    write("lost.json", R"({"pellucid": 1, "volumes": [{"source": "lost.raw"}]})");
    expectRefusedByAll("lost.json", {}, {"lost.raw"});
}

TEST_F(Input, RawOptionsSayHowVoxelsLie) {
    // 2x3x1 voxels of big-endian int16 after 3 bytes of header: 256 * i + 512 * j, so the smallest is 0, the
    // largest 1280.
    std::string bytes = "abc";
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 2; ++i) bytes += {static_cast<char>(i + 2 * j), '\0'};
    }
    write("big.bin", bytes);
    const Outcome outcome = run({"info", "big.bin", "--json", "--raw-size", "2x3x1", "--raw-type", "int16",
                                 "--raw-endian", "big", "--raw-header", "3", "--raw-spacing", "0.5x0.25x4",
                                 "--raw-slope", "2", "--raw-intercept", "-1000", "--raw-unit", "HU"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto volume = nlohmann::json::parse(outcome.out)["volumes"][0];
    EXPECT_EQ(volume["size"], nlohmann::json({2, 3, 1}));
    EXPECT_EQ(volume["type"], "int16");
    EXPECT_EQ(volume["spacingMm"], nlohmann::json({0.5, 0.25, 4.0}));
    EXPECT_EQ(volume["ranges"][0]["stored"], nlohmann::json({0.0, 1280.0}));
    EXPECT_EQ(volume["ranges"][0]["physical"], nlohmann::json({-1000.0, 1560.0}));
    EXPECT_EQ(volume["unit"], "HU");
}

TEST_F(Input, InfoTellsTheGeometryInWords) {
    writeBall("ball.raw");
    const Outcome outcome = run({"info", "ball.raw"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const char* word : {"16 x 16 x 16 voxels", "2 x 2 x 2 mm", "axis i", "towards L", "axis j",
                             "towards P", "axis k", "towards S", "uint8", "0 to 200"}) {
        EXPECT_THAT(outcome.out, HasSubstr(word));
    }
}

}  // namespace
}  // namespace pellucid::cli
