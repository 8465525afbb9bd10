// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/skipping.h"

#include <gmock/gmock.h>

#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

const VolumeFacts kFacts{axisAlignedGrid({510, 512, 300}, {0.7, 0.7, 1.0}), VoxelType::Int16, {-1024, 3071}};

std::string reasonFor(const Plan& plan, const char* what) {
    for (const auto& row : plan.leftOut)
        if (row.what == what) return row.reason;
    return "";
}

bool hasStage(const Plan& plan, const char* stage) {
    return std::any_of(plan.stages.begin(), plan.stages.end(),
                       [&](const StageRow& row) { return row.stage == stage; });
}

const ResourceRow* leapField(const Plan& plan) {
    for (const auto& row : plan.resources)
        if (row.name == "leap field") return &row;
    return nullptr;
}

TEST(SkippingPlan, LeapsAreListedWithTheirBytes) {
    Scene scene = test::rampScene();
    const Plan plan = makePlan(scene, {kFacts}).value();
    EXPECT_EQ(plan.features.skipping, Skipping::Leaps);
    EXPECT_TRUE(hasStage(plan, "bounds") && hasStage(plan, "leap"));
    ASSERT_NE(leapField(plan), nullptr);
    EXPECT_EQ(leapField(plan)->bytes, 128u * 128 * 75);
    scene.quality.skipEmpty = false;
    const Plan without = makePlan(scene, {kFacts}).value();
    EXPECT_EQ(plan.totalBytes - without.totalBytes, 128u * 128 * 75);
    EXPECT_FALSE(hasStage(without, "bounds") || hasStage(without, "leap"));
    EXPECT_THAT(reasonFor(without, "empty blocks"), testing::HasSubstr("not asked for"));
}

TEST(SkippingPlan, WhereItCannotHelpItIsLeftOut) {
    const auto reason = [](const Scene& scene, const VolumeFacts& facts = kFacts) {
        const Plan plan = makePlan(scene, {facts}).value();
        EXPECT_EQ(plan.features.skipping, Skipping::None);
        EXPECT_EQ(leapField(plan), nullptr);
        return reasonFor(plan, "empty blocks");
    };
    EXPECT_THAT(reason(test::rampScene(Mode::Slice)), testing::HasSubstr("one sample"));
    EXPECT_THAT(reason(test::rampScene(Mode::Average)), testing::HasSubstr("every value"));
    Scene scene = test::rampScene();
    scene.quality.integrator = Integrator::Adaptive;
    EXPECT_THAT(reason(scene), testing::HasSubstr("adaptive"));
    scene = test::rampScene();
    scene.volumes[0].transferFunction->points.front().extinction = 1e-6;
    EXPECT_THAT(reason(scene), testing::HasSubstr("every value"));
    VolumeFacts small = kFacts;
    small.grid.size = {4, 3, 4};
    EXPECT_THAT(reason(test::rampScene(), small), testing::HasSubstr("single block"));
    // The darkest value of the window is below all data.
    scene = test::rampScene(Mode::Mip);
    scene.volumes[0].window = Window{1000, 4100};
    EXPECT_THAT(reason(scene), testing::HasSubstr("every value"));
}

TEST(SkippingPlan, LeapsNeedTurnsOfTheDriversLoops) {
    // A largest value is not cut into slabs; composites are, with leaps.
    Scene scene = test::rampScene(Mode::Mip);
    scene.volumes[0].window = Window{500, 1000};
    DeviceLimits limits;
    limits.maxLoopTurns = 65535.0;
    EXPECT_EQ(makePlan(scene, {kFacts}, limits).value().features.skipping, Skipping::Leaps);
    scene.quality.stepMm = 0.02;  // 29 000 samples
    const Plan plan = makePlan(scene, {kFacts}, limits).value();
    EXPECT_EQ(plan.features.skipping, Skipping::Box);
    EXPECT_THAT(reasonFor(plan, "leaps"), testing::HasSubstr("turns"));
    EXPECT_EQ(leapField(plan), nullptr);
    scene.mode = Mode::Composite;
    const Plan slabs = makePlan(scene, {kFacts}, limits).value();
    EXPECT_EQ(slabs.features.skipping, Skipping::Leaps);
    EXPECT_GT(slabs.slabs, 1);
}

TEST(SkippingPlan, WhatTheBlocksSayIsTakenIn) {
    const Plan plan = makePlan(test::rampScene(), {kFacts}).value();
    const auto refined = [&](OccupancyFacts facts) {
        Plan copy = plan;
        refineSkipping(copy, facts);
        return copy;
    };
    const Plan sparse = refined({1000, 100, 500});
    EXPECT_EQ(sparse.features, plan.features);
    EXPECT_THAT(planText(sparse),
                testing::HasSubstr("80 % of the blocks in the box of what shows are empty"));
    EXPECT_EQ(refined({1000, 0, 0}).features.skipping, Skipping::Box);
    EXPECT_EQ(refined({1000, 490, 500}).features.skipping, Skipping::Box);
    const Plan full = refined({1000, 990, 1000});
    EXPECT_EQ(full.features.skipping, Skipping::None);
    EXPECT_EQ(leapField(full), nullptr);
    EXPECT_EQ(full.totalBytes, plan.totalBytes - leapField(plan)->bytes);
    EXPECT_THAT(reasonFor(full, "empty blocks"), testing::HasSubstr("1 %"));
}

}  // namespace
}  // namespace pellucid::renderer
