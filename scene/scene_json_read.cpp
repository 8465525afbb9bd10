// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/json_parse.h"
#include "scene/json_reader.h"
#include "scene/presets.h"
#include "scene/scene_json.h"
#include "scene/scene_json_parts.h"

namespace pellucid {

namespace {

using nlohmann::json;

TransferPoint readPoint(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"value", "color", "opacity", "extinction"});
    TransferPoint point;
    object.require("value", "a finite number");
    object.read("value", point.value);
    object.readColor("color", point.color);
    object.exclude("opacity", "extinction");
    if (!object.find("opacity")) object.require("extinction", "a number >= 0, or \"opacity\" in its place");
    object.read("extinction", point.extinction);
    double opacity = 0.0;
    object.read("opacity", opacity);
    if (!(opacity >= 0.0 && opacity <= 1.0))
        complaints.add(object.pointerTo("opacity"), fmt::format("{}", opacity), "a number in [0, 1]");
    else if (object.find("opacity"))
        point.extinction = extinctionFromOpacity(opacity);
    return point;
}

TransferFunction1D readPreset(const JsonObject& item) {
    std::string wanted;
    item.read("preset", wanted);
    if (const VolumePreset* preset = findVolumePreset(wanted)) return preset->function;
    std::vector<std::string> names;
    for (const VolumePreset& preset : volumePresets()) names.push_back(preset.name);
    item.complaints().add(item.pointerTo("preset"), foundText(*item.find("preset")), oneOf(wanted, names));
    return {};
}

Window readWindow(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"level", "width"});
    Window window;
    object.require("level", "a finite number");
    object.require("width", "a finite number above 0");
    object.read("level", window.level);
    object.read("width", window.width);
    return window;
}

SurfaceLayer readSurface(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"value", "color", "opacity"});
    SurfaceLayer surface;
    object.require("value", "a finite number");
    object.read("value", surface.value);
    object.readColor("color", surface.color);
    object.read("opacity", surface.opacity);
    return surface;
}

VolumeItem readItem(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints,
                            {"name", "source", "component", "filter", "classification", "transferFunction",
                             "preset", "window", "isovalue", "isosurfaces"});
    VolumeItem item;
    object.read("name", item.name);
    object.read("source", item.source);
    object.read("component", item.component);
    object.readName("filter", item.filter);
    object.readName("classification", item.classification);
    object.exclude("transferFunction", "preset");
    if (const json* function = object.find("transferFunction"))
        item.transferFunction =
            readTransferFunction(*function, object.pointerTo("transferFunction"), complaints);
    if (object.find("preset")) item.transferFunction = readPreset(object);
    if (const json* window = object.find("window"))
        item.window = readWindow(*window, object.pointerTo("window"), complaints);
    object.read("isovalue", item.isovalue);
    object.forEach("isosurfaces", [&](const json& surface, const std::string& at) {
        item.isosurfaces.push_back(readSurface(surface, at, complaints));
    });
    return item;
}

Light readLight(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints,
                            {"kind", "color", "intensity", "directionMm", "positionMm"});
    Light light;
    object.require("kind", R"(one of "headlight", "directional", "point")");
    object.readName("kind", light.kind);
    object.readColor("color", light.color);
    object.read("intensity", light.intensity);
    object.read("directionMm", light.directionMm);
    object.read("positionMm", light.positionMm);
    return light;
}

CameraPose readPose(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"eye", "target", "up", "heightMm"});
    CameraPose pose;
    object.require("eye", "an array of 3 numbers");
    object.require("target", "an array of 3 numbers");
    object.read("eye", pose.eye);
    object.read("target", pose.target);
    object.read("up", pose.up);
    object.read("heightMm", pose.heightMm);
    return pose;
}

Camera readCamera(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints,
                            {"projection", "fovDeg", "view", "zoom", "nearMm", "pose"});
    Camera camera;
    object.readName("projection", camera.projection);
    object.read("fovDeg", camera.fovDeg);
    object.readName("view", camera.view);
    object.read("zoom", camera.zoom);
    object.read("nearMm", camera.nearMm);
    if (const json* pose = object.find("pose"))
        camera.pose = readPose(*pose, object.pointerTo("pose"), complaints);
    return camera;
}

Quality readQuality(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints,
                            {"stepVoxels", "stepMm", "earlyTermination", "integrator", "accumulation",
                             "jitter", "toleranceGreyLevels", "toleranceNorm", "automatic", "dither",
                             "skipEmpty", "interpolationGreyLevels", "gradients"});
    Quality quality;
    // Who states an error and nothing else leaves the rest to the program.
    quality.automatic = object.find("toleranceGreyLevels") && !object.find("integrator") &&
                        !object.find("stepVoxels") && !object.find("stepMm");
    object.read("stepVoxels", quality.stepVoxels);
    object.read("stepMm", quality.stepMm);
    object.read("earlyTermination", quality.earlyTermination);
    object.readName("integrator", quality.integrator);
    object.readName("accumulation", quality.accumulation);
    object.read("jitter", quality.jitter);
    object.read("toleranceGreyLevels", quality.toleranceGreyLevels);
    object.readName("toleranceNorm", quality.toleranceNorm);
    object.read("automatic", quality.automatic);
    object.read("dither", quality.dither);
    object.read("skipEmpty", quality.skipEmpty);
    object.read("interpolationGreyLevels", quality.interpolationGreyLevels);
    object.readName("gradients", quality.gradients);
    return quality;
}

Picture readPicture(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"size", "background", "transparent"});
    Picture picture;
    object.read("size", picture.size);
    object.readColor("background", picture.background);
    object.read("transparent", picture.transparent);
    return picture;
}

void readVersion(const JsonObject& object) {
    int version = kSceneVersion;
    object.require("pellucid", "the version of the scene form, 1");
    object.read("pellucid", version);
    if (version != kSceneVersion)
        object.complaints().add(object.pointerTo("pellucid"), fmt::format("version {}", version),
                                fmt::format("{}, the only version this program reads", kSceneVersion));
}

Scene readScene(const json& value, JsonComplaints& complaints) {
    const JsonObject object(value, "", complaints,
                            {"pellucid", "volumes", "lights", "material", "camera", "mode", "hitOpacity",
                             "xray", "space", "unitLengthMm", "densityScale", "quality", "picture"});
    readVersion(object);
    Scene scene;
    object.forEach("volumes", [&](const json& item, const std::string& pointer) {
        scene.volumes.push_back(readItem(item, pointer, complaints));
    });
    if (object.find("lights")) scene.lights.emplace();
    object.forEach("lights", [&](const json& light, const std::string& pointer) {
        scene.lights->push_back(readLight(light, pointer, complaints));
    });
    if (const json* part = object.find("material"))
        scene.material = readMaterial(*part, "/material", complaints);
    if (const json* part = object.find("camera")) scene.camera = readCamera(*part, "/camera", complaints);
    if (const json* part = object.find("quality")) scene.quality = readQuality(*part, "/quality", complaints);
    if (const json* part = object.find("picture")) scene.picture = readPicture(*part, "/picture", complaints);
    object.readName("mode", scene.mode);
    object.read("hitOpacity", scene.hitOpacity);
    object.readName("xray", scene.xray);
    object.readName("space", scene.space);
    object.read("unitLengthMm", scene.unitLengthMm);
    object.read("densityScale", scene.densityScale);
    return scene;
}

}  // namespace

TransferFunction1D readTransferFunction(const json& value, const std::string& pointer,
                                        JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"name", "unit", "points"});
    TransferFunction1D function;
    object.read("name", function.name);
    object.read("unit", function.unit);
    object.require("points", "an array of 1 to 65536 points");
    object.forEach("points", [&](const json& point, const std::string& at) {
        function.points.push_back(readPoint(point, at, complaints));
    });
    return function;
}

Material readMaterial(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints, {"ambient", "diffuse", "specular", "shininess"});
    Material material;
    object.read("ambient", material.ambient);
    object.read("diffuse", material.diffuse);
    object.read("specular", material.specular);
    object.read("shininess", material.shininess);
    return material;
}

Result<Scene> sceneFromJson(const json& value) {
    JsonComplaints complaints;
    Scene scene = readScene(value, complaints);
    if (complaints.any()) return tl::unexpected(*complaints.first());
    if (auto valid = validate(scene); !valid) return tl::unexpected(std::move(valid.error()));
    return scene;
}

Result<Scene> sceneFromText(std::string_view text) {
    const Result<json> value = parseJson(text);
    if (!value) return tl::unexpected(value.error());
    return sceneFromJson(*value);
}

}  // namespace pellucid
