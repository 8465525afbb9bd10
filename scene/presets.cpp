// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/presets.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "embedded/presetFiles.h"
#include "scene/check.h"
#include "scene/json_parse.h"
#include "scene/json_reader.h"
#include "scene/scene_json_parts.h"

namespace pellucid {

namespace {

using nlohmann::json;

VolumePreset readPreset(const json& value, const std::string& pointer, JsonComplaints& complaints) {
    const JsonObject object(value, pointer, complaints,
                            {"name", "modality", "source", "material", "transferFunction"});
    VolumePreset preset;
    object.read("name", preset.name);
    object.read("modality", preset.modality);
    if (const json* material = object.find("material"))
        preset.material = readMaterial(*material, object.pointerTo("material"), complaints);
    if (const json* function = object.find("transferFunction"))
        preset.function = readTransferFunction(*function, object.pointerTo("transferFunction"), complaints);
    preset.function.name = preset.name;
    if (auto valid = validate(preset.function); !valid)
        complaints.add(object.pointerTo("transferFunction"), valid.error().message, "a valid function");
    else
        preset.function = followingOpacity(preset.function);
    return preset;
}

std::vector<VolumePreset> readPresets() {
    const Result<json> value = parseJson(embedded::presetFiles().at("volume_presets.json"));
    // The file is compiled in, so that a fault in it is a programmer's mistake.
    if (!value) contractBroken("volume_presets.json", 1, value.error().text());
    JsonComplaints complaints;
    std::vector<VolumePreset> presets;
    const JsonObject object(*value, "", complaints, {"about", "presets"});
    object.forEach("presets", [&](const json& preset, const std::string& pointer) {
        presets.push_back(readPreset(preset, pointer, complaints));
    });
    if (complaints.any()) contractBroken("volume_presets.json", 1, complaints.first()->text());
    return presets;
}

}  // namespace

const std::vector<VolumePreset>& volumePresets() {
    static const std::vector<VolumePreset> kPresets = readPresets();
    return kPresets;
}

const VolumePreset* findVolumePreset(std::string_view name) {
    const auto& presets = volumePresets();
    const auto found =
        std::find_if(presets.begin(), presets.end(), [&](const auto& preset) { return preset.name == name; });
    return found == presets.end() ? nullptr : &*found;
}

const std::vector<WindowPreset>& ctWindowPresets() {
    // Width and level where viewers and reading rooms agree best; keys in the order of use.
    static const std::vector<WindowPreset> kPresets{
        {"Soft tissue", {40, 400}, 1}, {"Lung", {-600, 1500}, 2},
        {"Liver", {90, 150}, 3},       {"Bone", {350, 2000}, 4},
        {"Brain", {40, 80}, 5},        {"Mediastinum", {40, 400}, 6},
        {"Vessels", {160, 650}, 7},    {"Posterior fossa", {40, 120}, 8},
        {"Stroke", {40, 40}, 9},       {"Sinus", {400, 4000}, 0},
        {"Emphysema", {-850, 500}, 0}, {"Endoscopy", {-300, 700}, 0}};
    return kPresets;
}

}  // namespace pellucid
