// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/presets.h"
#include "scene/scene_json.h"
#include "tests/unit/json_schema.h"
#include "tests/unit/random_scene.h"

// The schema for editors and people, and the reader, are written apart: these tests hold them together.

namespace pellucid {
namespace {

using nlohmann::json;

const json& schema() {
    static const json kSchema = [] {
        std::ifstream file(PELLUCID_SOURCE_DIR "/resources/schemas/scene.schema.json");
        return json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    }();
    return kSchema;
}

/// A small scene in which every object of the form occurs.
json fullScene() {
    return json::parse(R"({"pellucid": 1,
        "volumes": [{"transferFunction": {"points": [{"value": 0, "extinction": 1}]}, "window": {"level": 0, "width": 1},
            "isosurfaces": [{"value": 1}]}],
        "lights": [{"kind": "point"}], "material": {}, "quality": {}, "picture": {},
        "camera": {"pose": {"eye": [0, 0, 0], "target": [0, 1, 0]}}})");
}

struct ObjectPlace {
    const char* definition;  ///< Empty: the root.
    const char* pointer;
};
const ObjectPlace kPlaces[] = {{"", ""},
                               {"volume", "/volumes/0"},
                               {"transferFunction", "/volumes/0/transferFunction"},
                               {"point", "/volumes/0/transferFunction/points/0"},
                               {"window", "/volumes/0/window"},
                               {"surface", "/volumes/0/isosurfaces/0"},
                               {"light", "/lights/0"},
                               {"material", "/material"},
                               {"camera", "/camera"},
                               {"pose", "/camera/pose"},
                               {"quality", "/quality"},
                               {"picture", "/picture"}};

const json& definition(const ObjectPlace& place) {
    return *place.definition ? schema()["definitions"][place.definition] : schema();
}

/// The full scene with one member of one object set; members that exclude it are removed.
json sceneWith(const ObjectPlace& place, const std::string& member, const json& value) {
    json scene = fullScene();
    json& object = scene[json::json_pointer(place.pointer)];
    if (member == "opacity") object.erase("extinction");
    if (member == "preset") object.erase("transferFunction");
    object[member] = value;
    return scene;
}

/// The same verdict of schema and reader.
void expectVerdict(bool accepted, const json& scene, const std::string& what) {
    const std::string fault = test::schemaFault(schema(), schema(), scene);
    const auto result = sceneFromJson(scene);
    EXPECT_EQ(fault.empty(), accepted) << "schema, " << what << ": " << fault;
    EXPECT_EQ(result.has_value(), accepted)
        << "reader, " << what << ": " << (result ? "accepted" : result.error().text());
}

/// Calls f(place, name, property) for every property of every object.
template <class F>
void forEachProperty(F&& f) {
    for (const ObjectPlace& place : kPlaces)
        for (const auto& [name, property] : definition(place)["properties"].items())
            f(place, name, test::resolved(schema(), property));
}

TEST(SceneSchema, EveryDefinitionIsPlacedAndEveryPropertyDescribed) {
    std::set<std::string> placed{"displayColor", "lightColor"};
    for (const ObjectPlace& place : kPlaces) placed.insert(place.definition);
    for (const auto& [name, part] : schema()["definitions"].items())
        EXPECT_TRUE(placed.contains(name)) << name;
    forEachProperty([](const ObjectPlace& place, const std::string& name, const json& property) {
        EXPECT_TRUE(property.contains("description")) << place.definition << "." << name;
    });
    expectVerdict(true, fullScene(), "the scene these tests start from");
}

/// Some value the property allows.
json sample(const ObjectPlace& place, const std::string& name, const json& property) {
    const json scene = fullScene();
    const json& object = scene[json::json_pointer(place.pointer)];
    if (object.contains(name)) return object[name];
    if (property.contains("const")) return property["const"];
    if (property.contains("enum")) return property["enum"][0];
    if (property.contains("oneOf")) return "#102030";
    const std::string type = property["type"];
    if (type == "boolean") return true;
    if (type == "string") return "text";
    if (type == "integer") return 1;
    if (type == "number") return 0.25;
    return name == "size" ? json{64, 32} : json{0.5, 1.0, 1.0};
}

TEST(SceneSchema, EveryPropertyIsReadAndNoOther) {
    int properties = 0;
    forEachProperty([&](const ObjectPlace& place, const std::string& name, const json& property) {
        expectVerdict(true, sceneWith(place, name, sample(place, name, property)),
                      fmt::format("{}/{}", place.pointer, name));
        expectVerdict(false, sceneWith(place, name, nullptr), fmt::format("{}/{} null", place.pointer, name));
        ++properties;
    });
    EXPECT_GT(properties, 50);
    for (const ObjectPlace& place : kPlaces) expectVerdict(false, sceneWith(place, "zzz", 1), place.pointer);
}

TEST(SceneSchema, RequiredMembersAreTheSame) {
    for (const ObjectPlace& place : kPlaces) {
        const json names = fullScene()[json::json_pointer(place.pointer)];
        for (const auto& [name, value] : names.items()) {
            json scene = fullScene();
            scene[json::json_pointer(place.pointer)].erase(name);
            const auto required = definition(place).value("required", json::array());
            const bool needed =
                std::find(required.begin(), required.end(), name) != required.end() || name == "extinction";
            expectVerdict(!needed, scene, fmt::format("{} without {}", place.pointer, name));
        }
    }
}

template <class E>
std::vector<std::string> namesOf() {
    std::vector<std::string> names;
    for (const auto& entry : enumNames<E>()) names.emplace_back(entry.name);
    return names;
}

TEST(SceneSchema, ListsOfNamesAreThoseOfTheCode) {
    std::vector<std::string> presets;
    for (const VolumePreset& preset : volumePresets()) presets.push_back(preset.name);
    const std::map<std::string, std::vector<std::string>> expected{
        {"mode", namesOf<Mode>()},
        {"filter", namesOf<Filter>()},
        {"xray", namesOf<XRayDisplay>()},
        {"space", namesOf<CompositingSpace>()},
        {"classification", namesOf<Classification>()},
        {"kind", namesOf<LightKind>()},
        {"projection", namesOf<Projection>()},
        {"integrator", namesOf<Integrator>()},
        {"accumulation", namesOf<Accumulation>()},
        {"gradients", namesOf<Gradients>()},
        {"toleranceNorm", namesOf<ErrorNorm>()},
        {"view", namesOf<AnatomicalView>()},
        {"preset", presets}};
    std::size_t lists = 0;
    forEachProperty([&](const ObjectPlace& place, const std::string& name, const json& property) {
        if (!property.contains("enum")) return;
        ++lists;
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(property["enum"].get<std::vector<std::string>>(), expected.at(name)) << name;
        for (const json& value : property["enum"]) expectVerdict(true, sceneWith(place, name, value), name);
        expectVerdict(false, sceneWith(place, name, "none of them"), name);
    });
    EXPECT_EQ(lists, expected.size());
}

struct Probe {
    double value;
    bool allowed;
};

/// Values at, just inside and just outside the limits of a number.
std::vector<Probe> probes(const json& number) {
    const double inf = std::numeric_limits<double>::infinity();
    const bool whole = number["type"] == "integer";
    const auto above = [&](double v) { return whole ? v + 1 : std::nextafter(v, inf); };
    const auto below = [&](double v) { return whole ? v - 1 : std::nextafter(v, -inf); };
    std::vector<Probe> result;
    if (number.contains("minimum")) {
        const double limit = number["minimum"];
        result.insert(result.end(), {{limit, true}, {below(limit), false}, {-1e300, false}});
    } else if (number.contains("exclusiveMinimum")) {
        const double limit = number["exclusiveMinimum"];
        result.insert(result.end(), {{limit, false}, {above(limit), true}});
    } else {
        result.push_back({-1e300, true});
    }
    if (number.contains("maximum")) {
        const double limit = number["maximum"];
        result.insert(result.end(), {{limit, true}, {above(limit), false}, {1e300, false}});
    } else if (number.contains("exclusiveMaximum")) {
        const double limit = number["exclusiveMaximum"];
        result.insert(result.end(), {{limit, false}, {below(limit), true}});
    } else {
        result.push_back({1e300, true});
    }
    return result;
}

TEST(SceneSchema, LimitsOfNumbersAreTheSame) {
    int limits = 0;
    forEachProperty([&](const ObjectPlace& place, const std::string& name, const json& property) {
        if (property.contains("const")) return;
        const auto probe = [&](const json& number, const std::function<json(json)>& wrapped) {
            for (const Probe& test : probes(number)) {
                expectVerdict(test.allowed, sceneWith(place, name, wrapped(test.value)),
                              fmt::format("{}/{} = {}", place.pointer, name, test.value));
                ++limits;
            }
        };
        if (property.value("type", "") == "number" || property.value("type", "") == "integer")
            probe(property, [](json value) { return value; });
        const json& array = property.contains("oneOf") ? property["oneOf"][1] : property;
        if (array.value("type", "") != "array" || !array["items"].contains("type")) return;
        const std::size_t size = array["minItems"];
        // Poses with an element of 1e300 are not what is asked here: their distances are no numbers.
        for (std::size_t i = 0; std::string(place.definition) != "pose" && i < size; ++i)
            probe(array["items"], [&](json value) {
                json list(size, 1);
                list[i] = std::move(value);
                return list;
            });
        expectVerdict(false, sceneWith(place, name, json(size - 1, 1)), name + " too short");
        expectVerdict(false, sceneWith(place, name, json(size + 1, 1)), name + " too long");
    });
    EXPECT_GT(limits, 120);
}

TEST(SceneSchema, NumbersOfPointsAreTheSame) {
    const ObjectPlace function = kPlaces[2];
    const json point{{"value", 1}, {"extinction", 2}};
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{65536}, std::size_t{65537}})
        expectVerdict(count >= 1 && count <= 65536, sceneWith(function, "points", json(count, point)),
                      fmt::format("{} points", count));
}

TEST(SceneSchema, AlternativesExcludeEachOther) {
    json scene = fullScene();
    scene["volumes"][0]["preset"] = "CT bone";
    expectVerdict(false, scene, "preset beside transferFunction");
    scene = fullScene();
    scene["volumes"][0]["transferFunction"]["points"][0]["opacity"] = 0.5;
    expectVerdict(false, scene, "opacity beside extinction");
}

TEST(SceneSchema, EverySavedSceneFits) {
    std::mt19937_64 random(11);
    for (int i = 0; i < 1000; ++i) {
        const json saved = json::parse(sceneText(test::randomScene(random)));
        ASSERT_EQ(test::schemaFault(schema(), schema(), saved), "") << saved.dump(2);
    }
}

}  // namespace
}  // namespace pellucid
