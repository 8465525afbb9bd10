// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/plan.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

using test::rampScene;

const VolumeFacts kFacts{axisAlignedGrid({512, 512, 300}, {0.7, 0.7, 1.0}), VoxelType::Int16, {-1024, 3071}};

Plan planOf(const Scene& scene, const VolumeFacts& facts = kFacts) {
    auto plan = makePlan(scene, {facts});
    EXPECT_TRUE(plan) << (plan ? "" : plan.error().text());
    return plan.value_or(Plan{});
}

std::vector<std::string> rowNames(const Plan& plan) {
    std::vector<std::string> names;
    for (const auto& row : plan.stages) names.push_back(row.stage + " " + row.variant);
    for (const auto& row : plan.passes) names.push_back(row.name);
    for (const auto& row : plan.resources) names.push_back(row.name);
    return names;
}

TEST(Plan, ALightAddsExactlyGradientShadeAndLights) {
    Scene scene = rampScene();
    const Plan unlit = planOf(scene);
    scene.lights->push_back(Light{});
    scene.quality.gradients = Gradients::OnTheFly;
    const Plan lit = planOf(scene);
    std::vector<std::string> added = rowNames(lit);
    for (const auto& name : rowNames(unlit)) {
        const auto found = std::find(added.begin(), added.end(), name);
        ASSERT_NE(found, added.end()) << name;
        added.erase(found);
    }
    EXPECT_THAT(added,
                testing::UnorderedElementsAre("gradient central_difference", "shade blinn_phong", "lights"));
    EXPECT_EQ(lit.totalBytes - unlit.totalBytes, 32u);  // one light: two vec4
    const auto leftOut = [](const Plan& plan, const char* what) {
        return std::any_of(plan.leftOut.begin(), plan.leftOut.end(),
                           [&](const LeftOutRow& row) { return row.what == what; });
    };
    for (const char* what : {"gradient", "shade", "lights"}) {
        EXPECT_TRUE(leftOut(unlit, what)) << what;
        EXPECT_FALSE(leftOut(lit, what)) << what;
    }
}

TEST(Plan, BytesAreThoseOfTheVolumeAndThePicture) {
    const Plan plan = planOf(rampScene());
    EXPECT_EQ(plan.resources[0].bytes, 512ull * 512 * 300 * 2);  // int16 as R16
    EXPECT_EQ(plan.passes[0].bytes, 48ull * 40 * 16);            // RGBA32F
    EXPECT_EQ(plan.resources[1].bytes, static_cast<std::uint64_t>(plan.table.size) * 16);
    VolumeFacts floats = kFacts;
    floats.type = VoxelType::Float64;
    EXPECT_EQ(planOf(rampScene(), floats).resources[0].bytes, 512ull * 512 * 300 * 4);
}

TEST(Plan, NumbersDoNotChangeFeatures) {
    Scene scene = rampScene();
    const Features features = featuresOf(scene);
    scene.volumes[0].transferFunction->points[1].extinction = 3.0;
    scene.volumes[0].window = Window{1, 2};
    scene.camera.fovDeg = 60;
    scene.quality.stepVoxels = 0.1;
    scene.densityScale = 2.0;
    scene.picture.background = {1, 1, 1};
    EXPECT_EQ(featuresOf(scene), features);
}

/// The errors of many short steps add up to those of few long ones: the table must not get coarser.
TEST(Plan, TheTransferTableDoesNotDependOnTheStep) {
    Scene scene = rampScene();
    scene.volumes.front().transferFunction =
        TransferFunction1D{"", "", {{0.1, {1, 1, 1}, 0.0}, {99.37, {1, 1, 1}, 2.0}, {900, {1, 1, 1}, 0.5}}};
    scene.quality.stepVoxels = 2.0;
    const TableLayout coarse = planOf(scene).table;
    scene.quality.stepVoxels = 0.01;
    EXPECT_EQ(planOf(scene).table, coarse);
}

TEST(Plan, WhatCannotMatterIsDropped) {
    Scene scene = rampScene(Mode::Mip);
    scene.lights->push_back(Light{});
    scene.space = CompositingSpace::Linear;
    const Features features = featuresOf(scene);
    EXPECT_FALSE(features.lit);
    EXPECT_EQ(features.lights, 0);
    EXPECT_EQ(features.space, CompositingSpace::Display);
    EXPECT_FALSE(features.earlyTermination);
    EXPECT_EQ(planOf(scene).table.size, 0);
}

TEST(Plan, RefusalsSayWhatAndHowMuch) {
    const auto refusal = [](const Scene& scene, const std::vector<VolumeFacts>& facts) {
        const auto plan = makePlan(scene, facts);
        return plan ? std::string("no refusal") : plan.error().text();
    };
    Scene scene = rampScene();
    EXPECT_THAT(refusal(scene, {kFacts, kFacts}), testing::HasSubstr("2 volumes"));
    VolumeFacts tooLarge = kFacts;
    tooLarge.grid.size.x = 5000;
    EXPECT_THAT(refusal(scene, {tooLarge}),
                testing::AllOf(testing::HasSubstr("5000"), testing::HasSubstr("2048")));
    VolumeFacts unbounded = kFacts;
    unbounded.physicalRange = {-1.7e308, 1.7e308};
    EXPECT_THAT(refusal(scene, {unbounded}), testing::HasSubstr("float64"));
    VolumeFacts allNaN = kFacts;
    allNaN.hasValues = false;
    EXPECT_THAT(refusal(scene, {allNaN}), testing::HasSubstr("no voxel of the volume is a finite number"));
    scene.quality.stepMm = 1e-6;
    EXPECT_THAT(refusal(scene, {kFacts}), testing::HasSubstr("16777216"));
}

TEST(Plan, LargePicturesAreDrawnInBands) {
    EXPECT_EQ(targetSize({1024, 768}), glm::ivec2(1024, 768));
    EXPECT_EQ(targetSize({16384, 16384}), glm::ivec2(16384, 512));
}

TEST(Plan, TextAndJsonNameEveryRow) {
    Scene scene = rampScene();
    scene.lights->push_back(Light{});
    const Plan plan = planOf(scene);
    const std::string text = planText(plan);
    const auto json = planJson(plan);
    for (const auto& row : plan.stages) EXPECT_THAT(text, testing::HasSubstr(row.variant));
    for (const auto& row : plan.resources) EXPECT_THAT(text, testing::HasSubstr(row.name));
    for (const auto& row : plan.leftOut) EXPECT_THAT(text, testing::HasSubstr(row.reason));
    EXPECT_EQ(json["stages"].size(), plan.stages.size());
    EXPECT_EQ(json["totalBytes"], plan.totalBytes);
    EXPECT_EQ(json["mainBytes"], plan.mainBytes);
    EXPECT_THAT(text, testing::HasSubstr("times the stored volume"));
}

}  // namespace
}  // namespace pellucid::renderer
