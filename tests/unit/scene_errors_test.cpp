// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "scene/json_parse.h"
#include "scene/scene_json.h"
#include "scene/utf8.h"
#include "tests/unit/random_scene.h"

namespace pellucid {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string repeated(const std::string& text, int count) {
    std::string result;
    for (int i = 0; i < count; ++i) result += text;
    return result;
}

struct ErrorCase {
    std::string text;
    std::string start;  ///< How the message starts: pointer and what was found.
    std::string part = "allowed is";
};

/// A scene with one more member.
std::string with(const std::string& member) {
    return "{\"pellucid\": 1, " + member + "}";
}
std::string item(const std::string& member) {
    return with("\"volumes\": [{" + member + "}]");
}
std::string points(const std::string& list) {
    return item("\"transferFunction\": {\"points\": [" + list + "]}");
}

std::vector<ErrorCase> errorCases() {
    const std::string at = "/volumes/0/transferFunction/points/0";
    return {
        {"[]", "/: found an array of 0, allowed is an object"},
        {"null", "/: found null, allowed is an object"},
        {"3", "/: found 3, allowed is an object"},
        {"{}", "/pellucid: found nothing"},
        {R"({"pellucid": 2})", "/pellucid: found version 2, allowed is 1"},
        {R"({"pellucid": "1"})", "/pellucid: found \"1\", allowed is an integer"},
        {R"({"pellucid": 1.5})", "/pellucid: found 1.5, allowed is an integer"},
        {R"({"pellucid": 1e300})", "/pellucid: found 1e+300, allowed is an integer"},
        {R"({"pellucid": 18446744073709551615})", "/pellucid: found 18446744073709551615"},
        {R"({"pellucid": null})", "/pellucid: found null"},
        {with(R"("camra": {})"), "/camra: found an unknown member", R"(did you mean "camera"?)"},
        {with(R"("a/b~c": {})"), "/a~1b~0c: found an unknown member"},
        {with(R"("": {})"), "/: found an unknown member"},
        {with("\"" + std::string(100000, 'x') + "\": 1"),
         "/" + std::string(60, 'x') + "...: found an unknown member"},
        {with(R"("mode": "compost")"), R"(/mode: found "compost", allowed is one of "composite", "mip")",
         R"(did you mean "composite"?)"},
        {with(R"("mode": "MIP")"), R"(/mode: found "MIP")", R"(did you mean "mip"?)"},
        {with(R"("mode": 3)"), R"(/mode: found 3, allowed is one of "composite")"},
        {with("\"mode\": \"" + std::string(5000, 'y') + "\""),
         "/mode: found \"" + std::string(40, 'y') + "\"..., allowed"},
        {with(R"("xray": "bright")"),
         R"(/xray: found "bright", allowed is one of "transmittance", "opacity")"},
        {with(R"("space": true)"), "/space: found true"},
        {with(R"("hitOpacity": 0)"), "/hitOpacity: found 0, allowed is a number in [1e-9, 1]"},
        {with(R"("hitOpacity": 1.0000000000000002)"), "/hitOpacity: found 1.0000000000000002"},
        {with(R"("hitOpacity": "0.5")"), R"(/hitOpacity: found "0.5", allowed is a finite number)"},
        {with(R"("unitLengthMm": 0)"), "/unitLengthMm: found 0, allowed is a number in [1e-30, 1e30]"},
        {with(R"("unitLengthMm": null)"), "/unitLengthMm: found null"},
        {with(R"("densityScale": -1e-300)"), "/densityScale: found -1e-300"},
        {with(R"("volumes": {})"), "/volumes: found an object, allowed is an array"},
        {with(R"("volumes": [3])"), "/volumes/0: found 3, allowed is an object"},
        {with(R"("volumes": [{}, {"source": 7}])"), "/volumes/1/source: found 7, allowed is text in quotes"},
        {item(R"("sorce": "x")"), "/volumes/0/sorce: found an unknown member", R"(did you mean "source"?)"},
        {item(R"("component": 4)"), "/volumes/0/component: found 4, allowed is an integer in [0, 3]"},
        {item(R"("component": -1)"), "/volumes/0/component: found -1"},
        {item(R"("component": 0.5)"), "/volumes/0/component: found 0.5, allowed is an integer"},
        {item(R"("component": 4294967296)"), "/volumes/0/component: found 4294967296, allowed is an integer"},
        {item(R"("filter": "linear")"),
         R"(/volumes/0/filter: found "linear", allowed is one of "nearest", "trilinear")"},
        {item(R"("preset": "CT bones")"), R"(/volumes/0/preset: found "CT bones")",
         R"(did you mean "CT bone"?)"},
        {item(R"("preset": 1)"), "/volumes/0/preset: found 1"},
        {item(R"("preset": "CT bone", "transferFunction": {"points": [{"value": 0, "opacity": 0}]})"),
         R"(/volumes/0/preset: found beside "transferFunction", allowed is one of the two)"},
        {item(R"("window": {"level": 40})"), "/volumes/0/window/width: found nothing"},
        {item(R"("window": {"level": 40, "width": 0})"), "/volumes/0/window/width: found 0"},
        {item(R"("window": [40, 400])"), "/volumes/0/window: found an array of 2, allowed is an object"},
        {item(R"("isovalue": [1])"), "/volumes/0/isovalue: found an array of 1"},
        {item(R"("classification": "before")"), R"(/volumes/0/classification: found "before")"},
        {item(R"("isosurfaces": [{}])"), "/volumes/0/isosurfaces/0/value: found nothing"},
        {item(R"("isosurfaces": [{"value": 1, "opacity": 0}])"),
         "/volumes/0/isosurfaces/0/opacity: found 0, allowed is a number in (0, 1]"},
        {item(R"("isosurfaces": [{"value": 1, "color": [0, 2, 0]}])"),
         "/volumes/0/isosurfaces/0/color/1: found 2"},
        {item(R"("isosurfaces": [{"value": 1}, {"value": 1}, {"value": 1}, {"value": 1}, {"value": 1},
                                 {"value": 1}, {"value": 1}, {"value": 1}, {"value": 1}])"),
         "/volumes/0/isosurfaces: found 9, allowed is at most 8 surfaces"},
        {item(R"("transferFunction": {})"), "/volumes/0/transferFunction/points: found nothing"},
        {points(""), "/volumes/0/transferFunction/points: found 0 points", "allowed are 1 to 65536"},
        {points("[1, 2]"), at + ": found an array of 2, allowed is an object"},
        {points(R"({"at": 1, "opacity": 0})"), at + "/at: found an unknown member",
         R"("value", "color", "opacity")"},
        {points(R"({"opacity": 0})"), at + "/value: found nothing"},
        {points(R"({"value": 1})"), at + "/extinction: found nothing", "\"opacity\" in its place"},
        {points(R"({"value": 1, "opacity": 0, "extinction": 0})"),
         at + "/extinction: found beside \"opacity\""},
        {points(R"({"value": 1, "opacity": 1.5})"),
         at + "/opacity: found 1.5, allowed is a number in [0, 1]"},
        {points(R"({"value": 1, "extinction": -2})"),
         at + "/extinction: found -2, allowed is a number in [0, 1e30]"},
        {points(R"({"value": "1", "extinction": 2})"), at + "/value: found \"1\""},
        {points(R"({"value": 1, "extinction": 2}, {"value": 0, "extinction": 2})"),
         "/volumes/0/transferFunction/points/1/value: found 0 after 1", "do not descend"},
        {points(R"({"value": 1, "extinction": 2, "color": "red"})"), at + "/color: found \"red\"", "#rrggbb"},
        {points(R"({"value": 1, "extinction": 2, "color": "#12345"})"), at + "/color: found \"#12345\""},
        {points(R"({"value": 1, "extinction": 2, "color": "#12345g"})"), at + "/color: found \"#12345g\""},
        {points(R"({"value": 1, "extinction": 2, "color": [1, 0]})"), at + "/color: found an array of 2"},
        {points(R"({"value": 1, "extinction": 2, "color": [1, 0, "0"]})"), at + "/color/2: found \"0\""},
        {points(R"({"value": 1, "extinction": 2, "color": [1, 2, 0]})"), at + "/color/1: found 2"},
        {with(R"("lights": {"kind": "headlight"})"), "/lights: found an object, allowed is an array"},
        {with(R"("lights": [{}])"), "/lights/0/kind: found nothing"},
        {with(R"("lights": [{"kind": "spot"}])"), R"(/lights/0/kind: found "spot")"},
        {with(R"("lights": [{"kind": "headlight", "intensity": -1}])"), "/lights/0/intensity: found -1"},
        {with(R"("lights": [{"kind": "headlight", "color": [1, 1, -1]}])"), "/lights/0/color/2: found -1"},
        {with(R"("lights": [{"kind": "directional", "directionMm": [0, 0, 0]}])"),
         "/lights/0/directionMm: found 0"},
        {with(R"("lights": [{"kind": "point", "positionMm": "here"}])"),
         R"(/lights/0/positionMm: found "here")"},
        {with(R"("material": {"shininess": 0})"), "/material/shininess: found 0"},
        {with(R"("material": {"ambient": -0.1})"), "/material/ambient: found -0.1"},
        {with(R"("camera": {"fovDeg": 200})"), "/camera/fovDeg: found 200, allowed is a number in (0, 180)"},
        {with(R"("camera": {"view": "front"})"), R"(/camera/view: found "front")"},
        {with(R"("camera": {"zoom": 0})"), "/camera/zoom: found 0"},
        {with(R"("camera": {"pose": {"eye": [0, 0, 0]}})"), "/camera/pose/target: found nothing"},
        {with(R"("camera": {"pose": {"eye": [0, 0, 0], "target": [0, 0, 0]}})"),
         "/camera/pose/target: found the place"},
        {with(R"("quality": {"stepVoxels": 0})"), "/quality/stepVoxels: found 0"},
        {with(R"("quality": {"earlyTermination": 1})"),
         "/quality/earlyTermination: found 1, allowed is a number in [0, 1)"},
        {with(R"("quality": {"dither": 1})"), "/quality/dither: found 1, allowed is true or false"},
        {with(R"("picture": {"size": [0, 10]})"),
         "/picture/size/0: found 0, allowed is an integer in [1, 16384]"},
        {with(R"("picture": {"size": [10, 16385]})"), "/picture/size/1: found 16385"},
        {with(R"("picture": {"size": [10]})"),
         "/picture/size: found an array of 1, allowed is an array of 2 integers"},
        {with(R"("picture": {"size": [1e10, 5]})"),
         "/picture/size/0: found 10000000000, allowed is an integer"},
        {with(R"("picture": {"background": [0, 0, 1.1]})"), "/picture/background/2: found 1.1"},
        // Documents that no reader should take for something else.
        {R"({"pellucid": 1, "pellucid": 1})", "/pellucid: found twice", "allowed is once"},
        {with(R"("camera": {"zoom": 1, "zoom": 2})"), "/camera/zoom: found twice", "once"},
        {with(R"("volumes": [{}, {"name": "", "name": ""}])"), "/volumes/1/name: found twice", "once"},
        {repeated("[", 65), repeated("/0", 63) + ": found nesting deeper than 64 levels", "64"},
        {repeated("[", 1000000), repeated("/0", 63) + ": found nesting deeper", "64"},
        {repeated("{\"a\":", 1000000), repeated("/a", 63) + ": found nesting deeper", "64"}};
}

TEST(SceneErrors, NameThePointerWhatWasFoundAndWhatIsAllowed) {
    const auto cases = errorCases();
    EXPECT_GE(cases.size(), 40u);
    for (const ErrorCase& test : cases) {
        SCOPED_TRACE(test.text.substr(0, 200));
        const auto result = sceneFromText(test.text);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(result.error().message, StartsWith(test.start));
        EXPECT_THAT(result.error().message, HasSubstr(test.part));
        EXPECT_LT(result.error().message.size(), 1200u);
        EXPECT_TRUE(isUtf8(result.error().message));
    }
}

TEST(SceneErrors, TextThatIsNotJsonIsRefusedWithLineAndColumn) {
    const struct {
        const char* name;
        std::string text;
        const char* place;
    } cases[] = {{"empty", "", "line 1, column 1:"},
                 {"blank lines", "\n\n  ", "line 3, column 3:"},
                 {"not closed", "{\"pellucid\": 1", "line 1, column 15:"},
                 {"trailing comma", "{\"pellucid\": 1,\n}", "line 2, column 1:"},
                 {"second value", "{\"pellucid\": 1}\n {}", "line 2, column 2:"},
                 {"comment", "{\n// hello\n}", "line 2, column 1:"},
                 {"single quotes", "{'pellucid': 1}", "line 1, column 2:"},
                 {"NaN", "{\"pellucid\": NaN}", "line 1, column 14:"},
                 {"infinity", "{\"pellucid\": -Infinity}", "line 1, column 15:"},
                 {"too large", "{\"pellucid\": 1e999}", "line 1, column 18:"},
                 {"leading zero", "{\"pellucid\": 01}", "line 1, column 15:"},
                 {"hexadecimal", "{\"pellucid\": 0x1}", "line 1, column 15:"},
                 {"bad escape", "{\"pelluc\\id\": 1}", "line 1, column 10:"},
                 {"half a surrogate pair", "{\"a\": \"\\ud800\"}", "line 1"},
                 {"not UTF-8", "{\"a\": \"\xff\"}", "line 1, column 8:"},
                 {"overlong UTF-8", "{\"a\": \"\xc0\x80\"}", "line 1, column 8:"},
                 {"letters before count once", "{\"\xc3\xa9\": ?}", "line 1, column 7:"},
                 {"zero byte", std::string("{\"pellucid\": 1}\0", 16), "line 1, column 16:"},
                 {"a picture", "\x89PNG\r\n\x1a\n", "line 1, column 1:"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        const auto result = sceneFromText(test.text);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::Corrupt);
        EXPECT_THAT(result.error().message, StartsWith("not JSON at line "));
        EXPECT_THAT(result.error().message, HasSubstr(test.place));
        EXPECT_TRUE(isUtf8(result.error().message));
    }
}

TEST(SceneErrors, DamagedTextNeverCrashesAndNeverPassesSilently) {
    std::mt19937_64 random(99);
    int accepted = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = sceneText(test::randomScene(random));
        for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        if (random() % 4 == 0) text.resize(random() % text.size());
        const auto result = sceneFromText(text);
        if (!result) {
            EXPECT_FALSE(result.error().message.empty());
            continue;
        }
        ++accepted;
        // Whatever is accepted is a valid scene.
        EXPECT_TRUE(validate(*result));
    }
    EXPECT_GT(accepted, 0);     // A changed digit is still a scene,
    EXPECT_LT(accepted, 3000);  // and most damage is seen.
}

TEST(SceneErrors, DeepNestingUpToTheLimitIsRead) {
    EXPECT_TRUE(parseJson(repeated("[", 64) + repeated("]", 64)));
    EXPECT_FALSE(parseJson(repeated("[", 65) + repeated("]", 65)));
}

}  // namespace
}  // namespace pellucid
