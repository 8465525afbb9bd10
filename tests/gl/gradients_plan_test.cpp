// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/gradients.h"

#include <gmock/gmock.h>

#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

const VolumeFacts kFacts{
    axisAlignedGrid({510, 512, 300}, {0.7, 0.7, 1.0}), VoxelType::Int16, {-1024, 3071}, false, 4095};

Scene litScene(Mode mode = Mode::Composite) {
    Scene scene = test::rampScene(mode);
    scene.lights->push_back(Light{});
    return scene;
}

const ResourceRow* fieldRow(const Plan& plan) {
    for (const auto& row : plan.resources)
        if (row.name == "values and gradients") return &row;
    return nullptr;
}

std::string reasonFor(const Plan& plan) {
    for (const auto& row : plan.leftOut)
        if (row.what == "gradient texture") return row.reason;
    return "";
}

TEST(GradientsPlan, ATextureIsListedWithItsBytesAndItsError) {
    Scene scene = litScene();
    const Plan plan = makePlan(scene, {kFacts}).value();
    EXPECT_EQ(plan.features.gradients, GradientSource::Texture);
    ASSERT_NE(fieldRow(plan), nullptr);
    EXPECT_EQ(fieldRow(plan)->bytes, 512ull * 514 * 302 * 8);
    EXPECT_EQ(fieldRow(plan)->kind, "texture 3D RGBA16");
    EXPECT_THAT(fieldRow(plan)->reason, testing::HasSubstr("exact"));
    EXPECT_THAT(planText(plan), testing::HasSubstr("lit_midpoints_by_four"));
    scene.quality.gradients = Gradients::OnTheFly;
    const Plan without = makePlan(scene, {kFacts}).value();
    EXPECT_EQ(plan.totalBytes - without.totalBytes, fieldRow(plan)->bytes);
    EXPECT_EQ(without.features.gradients, GradientSource::OnTheFly);
    EXPECT_EQ(reasonFor(without), "not asked for");
    // What is passed over does not depend on where gradients come from.
    EXPECT_EQ(plan.features.skipping, without.features.skipping);
}

TEST(GradientsPlan, TexelsAreAsExactAsTheDataNeed) {
    VolumeFacts facts = kFacts;
    EXPECT_EQ(layoutField(facts).texelsPerStored, 8.0);  // 32767 / 4095
    facts.storedExtent = 0.0;                            // a constant volume
    EXPECT_EQ(layoutField(facts).texelsPerStored, 32767.0);
    EXPECT_EQ(layoutField(facts).worstError(), 0.0);
    facts.storedExtent = 65535.0;
    EXPECT_LT(layoutField(facts).texelsPerStored, 1.0);
    // Half a texel of a difference over two voxels, of which 32767 are the range.
    EXPECT_NEAR(layoutField(facts).worstError(), 0.5 * 0.5 / 32767.0, 1e-12);
    EXPECT_THAT(fieldRow(makePlan(litScene(), {facts}).value())->reason, testing::HasSubstr("7.6e-06"));
    facts.type = VoxelType::Float32;
    EXPECT_EQ(layoutField(facts).worstError(), 0.0);
    EXPECT_EQ(layoutField(facts).bytes(), 512ull * 514 * 302 * 16);
}

TEST(GradientsPlan, WhereItCannotOrNeedNotBeItIsLeftOut) {
    const auto reason = [](const Scene& scene, const DeviceLimits& limits = {}) {
        const Plan plan = makePlan(scene, {kFacts}, limits).value();
        EXPECT_EQ(plan.features.gradients, GradientSource::OnTheFly);
        EXPECT_EQ(fieldRow(plan), nullptr);
        return reasonFor(plan);
    };
    EXPECT_EQ(reason(test::rampScene()), "");  // no light: not even worth a word
    EXPECT_THAT(reason(litScene(Mode::FirstHit)), testing::HasSubstr("few samples"));
    Scene scene = litScene();
    scene.volumes[0].filter = Filter::CatmullRom;
    EXPECT_THAT(reason(scene), testing::HasSubstr("trilinear only"));
    DeviceLimits limits;
    limits.maxFieldBytes = 600 << 20;
    EXPECT_THAT(reason(litScene(), limits), testing::HasSubstr("512 x 514 x 302 texels, 606 MB"));
    limits = {};
    limits.max3dTextureSize = 512;
    EXPECT_THAT(reason(litScene(), limits), testing::HasSubstr("512 along an axis"));
}

TEST(GradientsPlan, WhatIsAskedForAndCannotBeIsRefused) {
    Scene scene = litScene();
    scene.quality.gradients = Gradients::Texture;
    EXPECT_TRUE(makePlan(scene, {kFacts}));
    DeviceLimits limits;
    limits.maxFieldBytes = 1;
    EXPECT_EQ(makePlan(scene, {kFacts}, limits).error().code, ErrorCode::TooLarge);
    scene.volumes[0].filter = Filter::TricubicBSpline;
    EXPECT_EQ(makePlan(scene, {kFacts}).error().code, ErrorCode::Unsupported);
    EXPECT_THAT(makePlan(scene, {kFacts}).error().text(), testing::HasSubstr("/quality/gradients"));
    scene.lights->clear();  // nobody looks at them
    EXPECT_TRUE(makePlan(scene, {kFacts}));
    scene = litScene(Mode::FirstHit);
    scene.quality.gradients = Gradients::Texture;
    EXPECT_EQ(makePlan(scene, {kFacts}).value().features.gradients, GradientSource::Texture);
}

TEST(GradientsPlan, WithoutTheTextureThePlanIsThatOfOnTheFly) {
    Scene scene = litScene();
    Plan plan = makePlan(scene, {kFacts}).value();
    ASSERT_TRUE(dropGradientTexture(plan, {}, "no room"));
    EXPECT_EQ(reasonFor(plan), "no room");
    scene.quality.gradients = Gradients::OnTheFly;
    const Plan onTheFly = makePlan(scene, {kFacts}).value();
    EXPECT_EQ(plan.stages, onTheFly.stages);
    EXPECT_EQ(plan.features, onTheFly.features);
    EXPECT_EQ(plan.resources, onTheFly.resources);
    EXPECT_EQ(plan.totalBytes, onTheFly.totalBytes);
}

}  // namespace
}  // namespace pellucid::renderer
