// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/light.h"
#include "scene/transfer_function.h"
#include "scene/volume.h"

namespace pellucid {

/// A named look for a modality: transfer function and material. From resources/presets/volume_presets.json,
/// compiled in.
struct VolumePreset {
    std::string name;      ///< "CT bone".
    std::string modality;  ///< "CT", "MR"; empty: any.
    TransferFunction1D function;
    Material material;
};
[[nodiscard]] const std::vector<VolumePreset>& volumePresets();
[[nodiscard]] const VolumePreset* findVolumePreset(std::string_view name);

/// CT windows as radiologists know them (Brain 80/40, Lung 1500/-600 ...), with the key that selects each (0:
/// none).
struct WindowPreset {
    std::string name;
    Window window;
    int key = 0;
};
[[nodiscard]] const std::vector<WindowPreset>& ctWindowPresets();

/// What a volume is drawn with when the scene says nothing. CT (modality CT, unit HU, or neither said and
/// values that can only be HU): the preset "CT general", the soft tissue window, bone at 300 HU. Everything
/// else follows from an even sample of the values: background is told from tissue by Otsu's threshold (Otsu
/// 1979), colour and opacity rise with the quantiles above it; the window spans the 0.1st to the 99.9th
/// percentile unless the file names one; the isovalue is the threshold. Work for every volume: constant, NaN
/// only, the whole range of doubles. Precondition: the volume has the component.
[[nodiscard]] TransferFunction1D defaultTransferFunction(const Volume& volume, int component);
[[nodiscard]] Window defaultWindow(const Volume& volume, int component);
[[nodiscard]] double defaultIsovalue(const Volume& volume, int component);

}  // namespace pellucid
