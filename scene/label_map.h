// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scene/volume.h"

namespace pellucid {

/// One segment of a label map.
struct Label {
    std::string name;
    glm::dvec3 color{1.0, 1.0, 1.0};  ///< Display-encoded RGB in [0, 1].
    bool visible = true;
    bool operator==(const Label&) const = default;
};

/// One integer id per voxel of a grid; 0 is background. Ids beyond 65535 and negative ids are refused.
struct LabelMap {
    Grid grid;
    std::vector<std::uint16_t> ids;         ///< i fastest, size = voxels of the grid.
    std::map<std::uint16_t, Label> labels;  ///< Every id that occurs, and perhaps more.
};

/// Reads a volume's first component as ids; labels get generated names ("label 7") and distinct colours.
/// Errors: InvalidArgument when a physical value is not an integer in 0..65535 (says the voxel and the
/// value).
[[nodiscard]] Result<std::shared_ptr<const LabelMap>> labelMapFromVolume(const Volume& volume);

}  // namespace pellucid
