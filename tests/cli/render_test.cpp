// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <chrono>
#include <cstring>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

class Render : public ProgramTest {};

TEST_F(Render, TheSameSceneGivesTheSameBytesTwice) {
    writeBallScene("scene.json", R"(, "lights": [{"kind": "headlight"}], "quality": {"dither": true})");
    for (const std::string name : {"once", "twice"}) {
        ASSERT_EQ(run({"render", "scene.json", "-o", name + ".png", "--float"}).status, 0);
    }
    EXPECT_GT(read("once.png").size(), 100u);
    EXPECT_EQ(read("once.png"), read("twice.png"));
    EXPECT_EQ(read("once.npy"), read("twice.npy"));
}

TEST_F(Render, PrintsSizeTimeAndErrorOnOneLine) {
    writeBallScene("scene.json");
    const Outcome outcome = run({"render", "scene.json", "-o", "a.png", "--size", "40x30"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(
        outcome.out,
        MatchesRegex(
            "a\\.png: 40x30, [0-9.]+ ms \\(GPU [0-9.]+ ms\\), loaded in [0-9.]+ ms, error [0-9.e-]+ grey "
            "levels RMSE, [0-9.e-]+ at most .*\n"));
    EXPECT_THAT(run({"render", "scene.json", "-o", "a.png", "--no-error"}).out, HasSubstr("not estimated"));
}

TEST_F(Render, TheFloatPictureIsWhatThePngWasRoundedFrom) {
    writeBallScene("scene.json", R"(, "lights": [])");  // a highlight may be brighter than a PNG can hold
    ASSERT_EQ(run({"render", "scene.json", "-o", "a.png", "--float"}).status, 0);
    ASSERT_EQ(run({"render", "scene.json", "-o", "a.pfm"}).status, 0);
    // Rounding to nearest moves a value by at most half a grey level (and a hair of float).
    EXPECT_EQ(run({"compare", "a.png", "a.npy", "--max", "0.50001"}).status, 0);
    EXPECT_EQ(run({"compare", "a.pfm", "a.npy", "--max", "0"}).status, 0);
    const std::string npy = read("a.npy");
    EXPECT_THAT(npy, HasSubstr("'shape': (32, 32, 4)"));
    // Not quantised: somewhere in the edge of the ball is a value that is no multiple of 1/255.
    bool between = false;
    for (std::size_t i = npy.size() - 32 * 32 * 16; i < npy.size(); i += 4) {
        float value = 0.0f;
        std::memcpy(&value, npy.data() + i, sizeof value);
        const float levels = value * 255.0f;
        between |= levels > 0.0f && levels - static_cast<float>(static_cast<int>(levels)) > 0.1f &&
                   levels - static_cast<float>(static_cast<int>(levels)) < 0.9f;
    }
    EXPECT_TRUE(between);
}

TEST_F(Render, SettingsChangeThePicture) {
    writeBallScene("scene.json");
    ASSERT_EQ(run({"render", "scene.json", "-o", "a.npy"}).status, 0);
    for (const std::string setting :
         {"densityScale=0.5", "camera.zoom=2", "mode=mip", "picture.background=[0.2,0.3,0.4]"}) {
        ASSERT_EQ(run({"render", "scene.json", "-o", "b.npy", "--set", setting}).status, 0) << setting;
        EXPECT_EQ(run({"compare", "a.npy", "b.npy", "--max", "1"}).status, 1) << setting;
    }
    ASSERT_EQ(
        run({"render", "scene.json", "-o", "c.npy", "--set", "mode=mip", "--set", "mode=composite"}).status,
        0);
    EXPECT_EQ(run({"compare", "a.npy", "c.npy", "--max", "0"}).status, 0)
        << "the last setting of a key holds";
}

TEST_F(Render, AScanNeedsNoScene) {
    writeBall("ball.raw");
    const Outcome outcome = run({"render", "ball.raw", "-o", "ball.png", "--size", "24x24"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(exists("ball.png"));
}

TEST_F(Render, AStartWithoutADisplayDrawsToAPictureNamedAfterTheScan) {
    writeBall("ball.one.raw");
    const Outcome outcome = run({"ball.one.raw"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("no display"));
    EXPECT_TRUE(
        outcome.out.starts_with(std::filesystem::canonical(path("pellucid-ball.png")).string() + ": "))
        << outcome.out;
}

TEST_F(Render, TheSampleIsThere) {
    const Outcome outcome = run({"--sample"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(exists("pellucid-sample.png"));
}

TEST_F(Render, CtrlCEndsItSoonAndLeavesNoPicture) {
    // 16 megapixels with 18000 samples each: minutes on any machine of today, while a tile takes some
    // milliseconds.
    writeBallScene("long.json", R"(, "quality": {"stepVoxels": 0.0015, "earlyTermination": 0})");
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run({"render", "long.json", "-o", "long.png", "--size", "4096x4096"}, 1000);
    const auto took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(outcome.status, 130);
    EXPECT_THAT(outcome.err, testing::StartsWith("pellucid: "));  // its own words: it was not just killed
    EXPECT_LT(took, std::chrono::seconds(20));
    EXPECT_FALSE(exists("long.png"));
}

TEST_F(Render, AMissingFolderIsRefusedBeforeAnythingIsDrawn) {
    writeBallScene("scene.json");
    expectRefusal({"render", "scene.json", "-o", "nowhere/a.png"}, {"nowhere", "no folder"});
    std::filesystem::create_directory(path("folder.png"));
    expectRefusal({"render", "scene.json", "-o", "folder.png"}, {"folder.png", "is a folder"});
}

}  // namespace
}  // namespace pellucid::cli
