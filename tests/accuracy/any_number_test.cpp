// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Whatever number a scene states, it is refused with a sentence or drawn in finite numbers.
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/plan/features.h"
#include "scene/scene_json.h"
#include "scene/scene_json_parts.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

using nlohmann::json;

/// Every number that a scene can state is stated.
Scene fullScene(const Grid& grid) {
    Scene scene = sceneOf(colourfulFunction(), perspectiveAlong(grid, {0.4, 1.0, -0.3}, 3.0), {8, 8});
    scene.volumes.front().isosurfaces = {{0.4, {1.0, 0.5, 0.2}, 0.5}, {0.6, {0.2, 0.5, 1.0}, 1.0}};
    scene.lights = {Light{}, Light{LightKind::Directional}, Light{LightKind::Point}};
    scene.lights->back().positionMm = {20.0, -30.0, 10.0};
    scene.quality.toleranceGreyLevels = 1.0;
    scene.quality.interpolationGreyLevels = 1.0;
    scene.quality.stepMm = 0.5;
    scene.picture.background = {0.1, 0.2, 0.3};
    return scene;
}

/// What is drawn otherwise than a lit composite: other shaders, other numbers.
struct Variant {
    std::string name;
    std::function<void(Scene&)> change;
    bool isTabulated = false;  ///< By a table that takes longer to make than a picture.
};

std::vector<Variant> variants() {
    std::vector<Variant> all;
    for (const auto& mode : enumNames<Mode>())
        all.push_back({mode.name, [m = mode.value](Scene& s) {
                           s.mode = m;
                           s.volumes.front().isosurfaces.clear();
                       }});
    for (const auto& integrator : enumNames<Integrator>())
        all.push_back({integrator.name,
                       [i = integrator.value](Scene& s) {
                           s.quality.integrator = i;
                           s.lights->clear();
                       },
                       renderer::usesPreintegration(integrator.value)});
    all.push_back({"several surfaces", [](Scene& s) { s.mode = Mode::Isosurface; }});
    all.push_back({"transmittance", [](Scene& s) {
                       s.mode = Mode::XRay;
                       s.xray = XRayDisplay::Transmittance;
                       s.quality.integrator = Integrator::IntegralFunctions;
                   }});
    all.push_back({"half, linear", [](Scene& s) {
                       s.quality.accumulation = Accumulation::Half;
                       s.space = CompositingSpace::Linear;
                   }});
    all.push_back({"8-bit, riemann", [](Scene& s) {
                       s.quality.accumulation = Accumulation::EightBit;
                       s.quality.integrator = Integrator::Riemann;
                   }});
    all.push_back({"voxel steps, jitter, orthographic", [](Scene& s) {
                       s.quality.stepMm.reset();
                       s.quality.jitter = true;
                       s.camera.projection = Projection::Orthographic;
                   }});
    all.push_back({"framing, pre-classified", [](Scene& s) {
                       s.camera.pose.reset();
                       s.volumes.front().classification = Classification::Pre;
                   }});
    return all;
}

/// The pointers of all numbers in a document.
void findNumbers(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& found) {
    if (value.is_number()) found.push_back(at);
    if (value.is_object())
        for (const auto& [key, member] : value.items()) findNumbers(member, at / key, found);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) findNumbers(value[i], at / i, found);
}

/// Names of members, elements of arrays under the array's.
std::string memberName(json::json_pointer at) {
    while (at.back().find_first_not_of("0123456789") == std::string::npos) at.pop_back();
    return at.back();
}

bool isFinite(const ImageF& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& p) {
        return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a);
    });
}

class AnyNumber : public GpuTest {
protected:
    static const VolumePtr& volume() {
        static const VolumePtr made =
            accuracy::sampledVolume(axisAlignedGrid({5, 6, 4}), VoxelType::Float32,
                                    [](glm::ivec3 i) { return ((i.x * 7 + i.y * 5 + i.z * 3) % 12) / 11.0; });
        return made;
    }
    static json documentOf(const Variant& variant) {
        Scene scene = fullScene(volume()->grid());
        variant.change(scene);
        return toFullJson(scene);
    }
    /// Empty when the scene is drawn in finite numbers or refused with a sentence.
    static std::string faultOf(const json& document) {
        const auto scene = sceneFromJson(document);
        if (!scene) return scene.error().message.size() > 20 ? "" : "refused without a sentence";
        const auto frame = gpu().render(*scene, {volume()});
        if (!frame)
            return frame.error().code == ErrorCode::Gpu ? "failed: " + frame.error().text() : std::string();
        return isFinite(frame->image) ? "" : "a pixel is not finite";
    }
};

TEST_F(AnyNumber, IsRefusedWithASentenceOrDrawnInFiniteNumbers) {
    for (const Variant& variant : variants()) {
        json document = documentOf(variant);
        EXPECT_EQ(faultOf(document), "") << variant.name;
        std::vector<json::json_pointer> numbers;
        findNumbers(document, json::json_pointer(), numbers);
        EXPECT_GT(numbers.size(), 60u);
        for (const auto& at : numbers) {
            if (memberName(at) == "pellucid" || memberName(at) == "size") continue;
            // Each function takes a new table; one point stands for all.
            const std::string place = at.to_string();
            const bool isOtherPoint =
                place.find("/points/") != place.npos && place.find("/points/1/") == place.npos;
            if (variant.isTabulated && isOtherPoint) continue;
            const json stated = document[at];
            for (const double number : {1e300, 1e39, 1e-45, -1e39, 0.0}) {
                document[at] = number;
                EXPECT_EQ(faultOf(document), "") << fmt::format("{}: {} = {}", variant.name, place, number);
            }
            document[at] = stated;
        }
    }
}

/// Each of two numbers is allowed alone; together they may be more than a float.
TEST_F(AnyNumber, AndAnyOtherAreRefusedOrDrawnInFiniteNumbers) {
    const std::string points = "/volumes/0/transferFunction/points/";
    const std::vector<std::pair<std::string, double>> extremes{
        {"/densityScale", 1e30},     {"/densityScale", 1e-30},        {"/unitLengthMm", 1e-30},
        {"/unitLengthMm", 1e30},     {points + "1/extinction", 1e30}, {points + "0/value", -1e300},
        {points + "3/value", 1e300}, {"/quality/stepMm", 1e30},       {"/lights/0/intensity", 1e30},
        {"/lights/2/color/1", 1e30}, {"/material/diffuse", 1e30},     {"/material/specular", 1e30},
        {"/material/ambient", 1e30}, {"/material/shininess", 1e4}};
    for (const Variant& variant : variants()) {
        if (variant.isTabulated) continue;  // as the integral functions, whose plan has the same limits
        const json document = documentOf(variant);
        for (std::size_t a = 0; a < extremes.size(); ++a)
            for (std::size_t b = 0; b < a; ++b) {
                json changed = document;
                for (const auto& [place, number] : {extremes[a], extremes[b]})
                    if (const json::json_pointer at(place); changed.contains(at)) changed[at] = number;
                EXPECT_EQ(faultOf(changed), "")
                    << fmt::format("{}: {} = {}, {} = {}", variant.name, extremes[a].first,
                                   extremes[a].second, extremes[b].first, extremes[b].second);
            }
    }
}

/// The walk above meets every number that the form has.
TEST(AnyNumberSchema, EveryNumberOfTheFormIsWalked) {
    std::ifstream file(PELLUCID_SOURCE_DIR "/resources/schemas/scene.schema.json");
    const json schema = json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    const Grid grid = axisAlignedGrid({5, 6, 4});
    Scene scene = fullScene(grid);
    std::set<std::string> walked{"opacity"};  // of a point: written as its extinction
    for (const bool inVoxels : {false, true}) {
        if (inVoxels) scene.quality.stepMm.reset();
        std::vector<json::json_pointer> numbers;
        findNumbers(toFullJson(scene), json::json_pointer(), numbers);
        for (const auto& at : numbers) walked.insert(memberName(at));
    }
    std::vector<json> objects{schema};
    for (const auto& [name, definition] : schema["definitions"].items()) objects.push_back(definition);
    int found = 0;
    for (const json& object : objects) {
        if (!object.contains("properties")) continue;
        for (const auto& [name, property] : object["properties"].items()) {
            const json& kind = property.contains("items") ? property["items"] : property;
            const std::string type = kind.value("type", "");
            const bool isColour = kind.value("$ref", "").ends_with("Color");
            if (type != "number" && type != "integer" && !isColour) continue;
            EXPECT_TRUE(walked.contains(name)) << name;
            ++found;
        }
    }
    EXPECT_GT(found, 35);
}

}  // namespace
}  // namespace pellucid::test
