// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/presets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pellucid {

const std::vector<VolumePreset>& volumePresets() {
    const auto tau = extinctionFromOpacity;
    static const std::vector<VolumePreset> kPresets{
        {"CT bone",
         "CT",
         {"CT bone",
          "HU",
          {{-16.4458, {0.729412, 0.254902, 0.301961}, 0.0},
           {641.385, {0.905882, 0.815686, 0.552941}, tau(0.715686)},
           {3071.0, {1, 1, 1}, tau(0.705882)}}},
         {0.1, 0.9, 0.2, 10.0}}};
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
