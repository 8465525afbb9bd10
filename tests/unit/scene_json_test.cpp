// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_json.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/unit/random_scene.h"

namespace pellucid {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string problem(const Result<Scene>& result) {
    return result ? "accepted" : result.error().text();
}

TEST(SceneJson, RandomScenesComeBackBitForBit) {
    std::mt19937_64 random(20240229);
    for (int i = 0; i < 3000; ++i) {
        SCOPED_TRACE(i);
        const Scene scene = test::randomScene(random);
        ASSERT_TRUE(validate(scene)) << validate(scene).error().text();
        const std::string text = sceneText(scene);
        const auto again = sceneFromText(text);
        ASSERT_TRUE(again) << problem(again) << "\n" << text;
        ASSERT_TRUE(*again == scene) << text;
        // Equal texts say more than equal scenes: -0.0 == 0.0, but they are written differently.
        ASSERT_EQ(sceneText(*again), text);
        const auto throughJson = sceneFromJson(nlohmann::json::parse(toJson(scene).dump()));
        ASSERT_TRUE(throughJson && *throughJson == scene) << text;
    }
}

TEST(SceneJson, SignsOfZeroAndDenormalsSurvive) {
    Scene scene;
    scene.volumes.resize(1);
    scene.volumes[0].isovalue = -0.0;
    scene.volumes[0].window = Window{-0.0, std::numeric_limits<double>::denorm_min()};
    scene.densityScale = -0.0;
    scene.camera.nearMm = -0.0;
    const auto again = sceneFromText(sceneText(scene));
    ASSERT_TRUE(again);
    EXPECT_TRUE(std::signbit(*again->volumes[0].isovalue));
    EXPECT_TRUE(std::signbit(again->volumes[0].window->level));
    EXPECT_EQ(again->volumes[0].window->width, std::numeric_limits<double>::denorm_min());
    EXPECT_TRUE(std::signbit(again->densityScale));
    EXPECT_TRUE(std::signbit(again->camera.nearMm));
}

TEST(SceneJson, ADefaultSceneIsOneMember) {
    EXPECT_EQ(toJson(Scene{}).dump(), R"({"pellucid":1})");
    EXPECT_EQ(*sceneFromText(R"({"pellucid": 1})"), Scene{});
    EXPECT_EQ(*sceneFromText(" \t\r\n{\"pellucid\": 1.0} \n"), Scene{});
}

TEST(SceneJson, ASceneIsWrittenAsAPersonWould) {
    Scene scene;
    scene.volumes.resize(1);
    scene.volumes[0].source = "head/";
    scene.volumes[0].transferFunction =
        TransferFunction1D{"", "HU", {{150, {1, 0.2, 0}, 0}, {300.5, {0.3, 0, 0}, 2}}};
    scene.lights = std::vector<Light>{Light{}};
    scene.mode = Mode::FirstHit;
    scene.picture.size = {64, 32};
    EXPECT_EQ(sceneText(scene), R"({
  "pellucid": 1,
  "volumes": [
    {
      "source": "head/",
      "transferFunction": {
        "unit": "HU",
        "points": [
          { "value": 150.0, "color": "#ff3300", "extinction": 0.0 },
          { "value": 300.5, "color": [0.3, 0.0, 0.0], "extinction": 2.0 }
        ]
      }
    }
  ],
  "lights": [{ "kind": "headlight" }],
  "mode": "first-hit",
  "picture": { "size": [64, 32] }
}
)");
}

TEST(SceneJson, ColoursAreHexOnlyWhereThatIsExact) {
    Scene scene;
    scene.picture.background = {16 / 255.0, 32 / 255.0, 48 / 255.0};
    EXPECT_THAT(sceneText(scene), HasSubstr("\"#102030\""));
    scene.picture.background.y = std::nextafter(32 / 255.0, 1.0);
    EXPECT_THAT(sceneText(scene), HasSubstr("[0.0627"));
    scene.picture.background = {-0.0, 0.0, 0.0};
    EXPECT_THAT(sceneText(scene), HasSubstr("[-0.0, 0.0, 0.0]"));
    EXPECT_EQ(sceneFromText(R"({"pellucid":1,"picture":{"background":"#FFfF00"}})")->picture.background,
              glm::dvec3(1, 1, 0));
}

TEST(SceneJson, OpacityIsReadAsExtinctionAndPresetsAsFunctions) {
    const auto scene = sceneFromText(R"({"pellucid": 1, "volumes": [
        {"transferFunction": {"points": [{"value": 1, "opacity": 0.75}, {"value": 2, "color": [1, 0, 0], "opacity": 1}]}},
        {"preset": "CT bone"}]})");
    ASSERT_TRUE(scene) << problem(scene);
    const auto& points = scene->volumes[0].transferFunction->points;
    EXPECT_EQ(points[0].extinction, extinctionFromOpacity(0.75));
    EXPECT_EQ(points[0].color, glm::dvec3(1.0));
    EXPECT_EQ(points[1].extinction, kOpaqueExtinction);
    EXPECT_EQ(scene->volumes[1].transferFunction->name, "CT bone");
    EXPECT_GT(scene->volumes[1].transferFunction->points.size(), 3u);
}

TEST(SceneJson, NumbersThatAreNotJsonAreRefusedInValuesToo) {
    nlohmann::json json{{"pellucid", 1}, {"densityScale", std::nan("")}};
    EXPECT_EQ(problem(sceneFromJson(json)), "/densityScale: found nan, allowed is a finite number");
    json["densityScale"] = nlohmann::json::binary({1, 2});
    EXPECT_FALSE(sceneFromJson(json));
}

struct SettingCase {
    const char* path;
    const char* value;
    const char* found;  ///< Part of the text of the scene, or of the error.
};

TEST(WithSetting, SetsOneMember) {
    Scene scene;
    scene.volumes.resize(2);
    scene.volumes[1].transferFunction = rampFunction(0, 100, 0.5);
    scene.camera.pose = CameraPose{{0, -10, 0}, {0, 0, 0}, {0, 0, 1}, 50};
    scene.unitLengthMm = 2.0;
    const SettingCase cases[] = {
        {"camera.fovDeg", "45", R"("fovDeg": 45.0)"},
        {"quality.stepVoxels", "0.25", R"("stepVoxels": 0.25)"},
        {"quality.stepMm", "0.1", R"("stepMm": 0.1)"},
        {"quality.dither", "true", R"("dither": true)"},
        {"volumes.0.filter", "nearest", R"("filter": "nearest")"},
        {"volumes.0.filter", "\"nearest\"", R"("filter": "nearest")"},
        {"volumes.0.name", "a plain word", R"("name": "a plain word")"},
        {"volumes.2.source", "third.nrrd", R"("source": "third.nrrd")"},
        {"volumes.1.transferFunction.points.1.opacity", "0.75", R"("extinction": 1.38629)"},
        {"volumes.1.transferFunction.points.0.color", "#ff0000", R"("color": "#ff0000")"},
        {"volumes.1.transferFunction.points.0.color.1", "1", R"("color": "#00ff00")"},
        {"volumes.1.preset", "CT bone", R"("name": "CT bone")"},
        {"volumes.0.window", R"({"level": 40, "width": 400})",
         R"("window": { "level": 40.0, "width": 400.0 })"},
        {"mode", "mip", R"("mode": "mip")"},
        {"picture.size.0", "512", R"("size": [512, 768])"},
        {"picture.size", "[10, 20]", R"("size": [10, 20])"},
        {"picture.background", "#102030", R"("background": "#102030")"},
        {"lights", "[]", R"("lights": [])"},
        {"lights.0.kind", "point", R"("lights": [{ "kind": "point" }])"},
        {"camera.pose.eye.1", "-99", R"("eye": [0.0, -99.0, 0.0])"}};
    for (const SettingCase& test : cases) {
        SCOPED_TRACE(fmt::format("{}={}", test.path, test.value));
        const auto changed = withSetting(scene, test.path, test.value);
        ASSERT_TRUE(changed) << problem(changed);
        EXPECT_THAT(sceneText(*changed), HasSubstr(test.found));
    }
}

/// Who states an error and nothing else leaves step and integrator to the program; who states one of those
/// does not.
TEST(WithSetting, AnErrorAskedForLetsTheProgramChoose) {
    const auto automatic = [](std::initializer_list<std::pair<const char*, const char*>> settings) {
        Scene scene;
        for (const auto& [path, value] : settings) scene = withSetting(scene, path, value).value();
        return scene.quality.automatic;
    };
    EXPECT_FALSE(automatic({}));
    EXPECT_TRUE(automatic({{"quality.toleranceGreyLevels", "2"}}));
    EXPECT_FALSE(automatic({{"quality.toleranceGreyLevels", "2"}, {"quality.stepVoxels", "1"}}));
    EXPECT_FALSE(automatic({{"quality.integrator", "adaptive"}, {"quality.toleranceGreyLevels", "2"}}));
    EXPECT_FALSE(automatic({{"quality.integrator", "importance"}, {"quality.toleranceGreyLevels", "2"}}));
    EXPECT_TRUE(automatic({{"quality.integrator", "simpson"}, {"quality.toleranceGreyLevels", "2"}}));
    EXPECT_FALSE(automatic({{"quality.toleranceGreyLevels", "2"}, {"quality.automatic", "false"}}));
    const auto read = [](const char* text) { return sceneFromText(text).value().quality.automatic; };
    EXPECT_TRUE(read(R"({"pellucid": 1, "quality": {"toleranceGreyLevels": 2}})"));
    EXPECT_FALSE(read(R"({"pellucid": 1, "quality": {"toleranceGreyLevels": 2, "stepMm": 1}})"));
    EXPECT_FALSE(read(R"({"pellucid": 1, "quality": {"toleranceGreyLevels": 2, "automatic": false}})"));
    EXPECT_TRUE(read(R"({"pellucid": 1, "quality": {"stepMm": 1, "automatic": true}})"));
}

TEST(WithSetting, NullGoesBackToTheDefault) {
    Scene scene;
    scene.unitLengthMm = 2.0;
    scene.camera.pose = CameraPose{};
    scene.camera.fovDeg = 60.0;
    EXPECT_EQ(withSetting(scene, "unitLengthMm", "null")->unitLengthMm, std::nullopt);
    EXPECT_EQ(withSetting(scene, "camera.pose", "null")->camera.pose, std::nullopt);
    EXPECT_EQ(withSetting(scene, "camera.fovDeg", "null")->camera.fovDeg, 30.0);
}

TEST(WithSetting, LeavesEverythingElseBitForBit) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 200; ++i) {
        const Scene scene = test::randomScene(random);
        const auto changed = withSetting(scene, "mode", name(scene.mode));
        ASSERT_TRUE(changed) << problem(changed);
        EXPECT_EQ(sceneText(*changed), sceneText(scene));
    }
}

TEST(WithSetting, MistakesAreNamed) {
    Scene scene;
    scene.volumes.resize(1);
    const SettingCase cases[] = {
        {"camera.fov", "45",
         R"(/camera/fov: found an unknown member, allowed is one of "projection", "fovDeg")"},
        {"camera.fov", "45", R"(did you mean "fovDeg")"},
        {"camera.fovDeg", "200", "/camera/fovDeg: found 200, allowed is a number in (0, 180)"},
        {"camera.fovDeg", "wide", R"(/camera/fovDeg: found "wide", allowed is a finite number)"},
        {"camera.fovDeg", "1e999", R"(/camera/fovDeg: found "1e999")"},
        {"", "1", "no path"},
        {"camera..zoom", "1", "no path"},
        {".mode", "mip", "no path"},
        {"mode.", "mip", "no path"},
        {"mode.x", "1", R"(/mode: found "composite", which has no member "x")"},
        {"volumes.2.name", "x", R"(/volumes: found index "2", allowed is 0 to 1)"},
        {"volumes.first.name", "x", R"(/volumes: found index "first")"},
        {"volumes.-1.name", "x", R"(/volumes: found index "-1")"},
        {"volumes.99999999999999999999.name", "x", "/volumes: found index"},
        {"pellucid", "2", "/pellucid: found version 2"},
        {"mode", "mpi", R"(did you mean "mip"?)"},
        {"quality", R"({"a": 1, "a": 2})", "/a: found twice"},
        {"camera.pose.up", "[0, 0, 1]", "/camera/pose/eye: found nothing"}};
    for (const SettingCase& test : cases) {
        SCOPED_TRACE(fmt::format("{}={}", test.path, test.value));
        EXPECT_THAT(problem(withSetting(scene, test.path, test.value)), HasSubstr(test.found));
    }
}

}  // namespace
}  // namespace pellucid
