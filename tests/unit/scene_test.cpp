// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/unit/random_scene.h"
#include "tests/unit/test_volumes.h"

namespace pellucid {
namespace {

using test::makeVolume;
using testing::StartsWith;

VolumePtr smallCt() {
    VolumeInfo info;
    info.name = "head";
    info.modality = "CT";
    return makeVolume<std::int16_t>({2, 2, 2}, {-1000, 0, 50, 100, 300, 700, 1000, 2000}, {1.0, 0.0, "HU"}, 1,
                                    info);
}

TEST(Completed, FillsInEverythingFromTheData) {
    const Scene full = completed(Scene{}, {smallCt()});
    ASSERT_EQ(full.volumes.size(), 1u);
    EXPECT_EQ(full.volumes[0].name, "head");
    ASSERT_TRUE(full.volumes[0].transferFunction);
    EXPECT_EQ(full.volumes[0].transferFunction->unit, "HU");
    EXPECT_TRUE(full.volumes[0].window);
    EXPECT_EQ(full.volumes[0].isovalue, 300.0);
    ASSERT_TRUE(full.lights);
    EXPECT_EQ(*full.lights, std::vector<Light>{Light{}});
    EXPECT_EQ(full.unitLengthMm, 1.0);
    EXPECT_TRUE(validate(full));
}

TEST(Completed, LightsOnlyModesThatAreLit) {
    for (const auto& [mode, modeName] : enumNames<Mode>()) {
        Scene scene;
        scene.mode = mode;
        EXPECT_EQ(completed(scene, {smallCt()}).lights->size(), usesLights(mode) ? 1u : 0u) << modeName;
    }
    Scene unlit;
    unlit.lights.emplace();
    EXPECT_TRUE(completed(unlit, {smallCt()}).lights->empty());
}

TEST(Completed, KeepsWhatIsSetAndIsIdempotent) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 300; ++i) {
        Scene scene = test::randomScene(random);
        for (VolumeItem& item : scene.volumes) item.component = 0;
        const std::vector<VolumePtr> volumes(std::max<std::size_t>(1, scene.volumes.size()), smallCt());
        const Scene once = completed(scene, volumes);
        EXPECT_TRUE(validate(once));
        EXPECT_EQ(completed(once, volumes), once);
        for (std::size_t v = 0; v < scene.volumes.size(); ++v) {
            const VolumeItem &before = scene.volumes[v], &after = once.volumes[v];
            EXPECT_EQ(after.transferFunction,
                      before.transferFunction ? before.transferFunction : after.transferFunction);
            EXPECT_EQ(after.window, before.window ? before.window : after.window);
        }
        EXPECT_EQ(once.camera, scene.camera);
        EXPECT_EQ(once.unitLengthMm, scene.unitLengthMm ? scene.unitLengthMm : once.unitLengthMm);
    }
}

TEST(Completed, LeavesAMissingComponentUnset) {
    Scene scene;
    scene.volumes.resize(1);
    scene.volumes[0].component = 2;
    const Scene full = completed(scene, {smallCt()});
    EXPECT_FALSE(full.volumes[0].transferFunction);
    EXPECT_FALSE(full.volumes[0].window);
}

TEST(Scene, TheStepIsInVoxelsUnlessItIsGivenInMm) {
    const Grid grid = axisAlignedGrid({4, 4, 4}, {3.0, 0.5, 2.0});
    Quality quality;
    EXPECT_EQ(stepMm(quality, grid), 0.25);
    quality.stepVoxels = 2.0;
    EXPECT_EQ(stepMm(quality, grid), 1.0);
    quality.stepMm = 0.125;
    EXPECT_EQ(stepMm(quality, grid), 0.125);
}

TEST(Scene, EveryModeIsShownByAFunctionOrAWindow) {
    for (const auto& [mode, modeName] : enumNames<Mode>()) {
        EXPECT_NE(usesTransferFunction(mode), usesWindow(mode)) << modeName;
        EXPECT_FALSE(usesLights(mode) && usesWindow(mode)) << modeName;
    }
}

TEST(Names, LeadBackToTheEnumerator) {
    for (const auto& [mode, modeName] : enumNames<Mode>()) {
        EXPECT_STREQ(name(mode), modeName);
        EXPECT_EQ(enumFromName<Mode>(modeName), mode);
    }
    EXPECT_STREQ(name(Filter::TricubicBSpline), "tricubic-bspline");
    EXPECT_STREQ(name(Mode::FirstHit), "first-hit");
    EXPECT_EQ(enumFromName<Filter>("cubic"), std::nullopt);
}

TEST(ErrorText, GoesFromTheOutsideIn) {
    const Result<int> inner = fail(ErrorCode::Corrupt, "wrong size");
    const Result<int> outer = fail(Error{fail(inner.error(), "slice 14").value()}, "series 1.2.3");
    EXPECT_EQ(outer.error().text(), "series 1.2.3: slice 14: wrong size");
    EXPECT_EQ(outer.error().code, ErrorCode::Corrupt);
}

TEST(Validate, ScenesMadeInCodeAreCheckedLikeFiles) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const struct {
        const char* start;
        std::function<void(Scene&)> spoil;
    } cases[] = {{"/volumes/0/name: ", [](Scene& s) { s.volumes[0].name = "\xff"; }},
                 {"/volumes/0/source: ", [](Scene& s) { s.volumes[0].source = "\xc3"; }},
                 {"/volumes/0/component: ", [](Scene& s) { s.volumes[0].component = 4; }},
                 {"/volumes/0/transferFunction/name: ",
                  [](Scene& s) { s.volumes[0].transferFunction->name = "\xed\xa0\x80"; }},
                 {"/volumes/0/transferFunction/unit: ",
                  [](Scene& s) { s.volumes[0].transferFunction->unit = "\xf5"; }},
                 {"/volumes/0/transferFunction/points: ",
                  [](Scene& s) { s.volumes[0].transferFunction->points.clear(); }},
                 {"/volumes/0/window/level: ",
                  [=](Scene& s) {
                      s.volumes[0].window = Window{nan, 1};
                  }},
                 {"/volumes/0/window/width: ",
                  [=](Scene& s) {
                      s.volumes[0].window = Window{0, inf};
                  }},
                 {"/volumes/0/isovalue: ", [=](Scene& s) { s.volumes[0].isovalue = inf; }},
                 {"/lights/0/color/1: ", [=](Scene& s) { s.lights->at(0).color.y = nan; }},
                 {"/lights/0/intensity: ", [=](Scene& s) { s.lights->at(0).intensity = inf; }},
                 {"/lights/0/directionMm/2: ", [=](Scene& s) { s.lights->at(0).directionMm.z = nan; }},
                 {"/lights/0/positionMm/0: ", [=](Scene& s) { s.lights->at(0).positionMm.x = inf; }},
                 {"/material/ambient: ", [=](Scene& s) { s.material.ambient = nan; }},
                 {"/material/diffuse: ", [](Scene& s) { s.material.diffuse = -1; }},
                 {"/material/specular: ", [=](Scene& s) { s.material.specular = inf; }},
                 {"/material/shininess: ", [](Scene& s) { s.material.shininess = -0.0; }},
                 {"/camera/fovDeg: ", [=](Scene& s) { s.camera.fovDeg = nan; }},
                 {"/camera/pose/eye: ",
                  [=](Scene& s) {
                      s.camera.pose = CameraPose{{nan, 0, 0}, {}, {0, 0, 1}, 1};
                  }},
                 {"/hitOpacity: ", [=](Scene& s) { s.hitOpacity = nan; }},
                 {"/unitLengthMm: ", [=](Scene& s) { s.unitLengthMm = inf; }},
                 {"/densityScale: ", [=](Scene& s) { s.densityScale = inf; }},
                 {"/quality/stepVoxels: ", [=](Scene& s) { s.quality.stepVoxels = nan; }},
                 {"/quality/stepMm: ", [](Scene& s) { s.quality.stepMm = 0; }},
                 {"/quality/earlyTermination: ", [=](Scene& s) { s.quality.earlyTermination = nan; }},
                 {"/picture/size/1: ", [](Scene& s) { s.picture.size.y = 0; }},
                 {"/picture/background/0: ", [=](Scene& s) { s.picture.background.x = nan; }}};
    Scene good;
    good.volumes.resize(1);
    good.volumes[0].transferFunction = rampFunction(0, 1, 0.5);
    good.lights = std::vector<Light>{Light{}};
    ASSERT_TRUE(validate(good));
    for (const auto& test : cases) {
        SCOPED_TRACE(test.start);
        Scene scene = good;
        test.spoil(scene);
        const auto result = validate(scene);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(result.error().message, StartsWith(test.start));
    }
}

}  // namespace
}  // namespace pellucid
