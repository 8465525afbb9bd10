// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/label_map.h"

#include <fmt/format.h>

#include <cmath>

namespace pellucid {

namespace {

/// Neighbouring ids differ most: hues by the golden ratio; saturation and brightness repeat with periods 3
/// and 4, so that ids whose hues come close again differ in those.
glm::dvec3 labelColor(std::uint16_t id) {
    const double hue = std::fmod(id * 0.6180339887498949, 1.0) * 6.0;
    const double saturation = 0.55 + 0.2 * (id % 3);
    const double brightness = 1.0 - 0.13 * (id % 4);
    glm::dvec3 color{0.0};
    for (int c = 0; c < 3; ++c) {
        // HSV to RGB as one formula per channel (Foley et al. 1990, section 13.3.4).
        const double k = std::fmod(5.0 - 2.0 * c + hue, 6.0);
        color[c] = brightness * (1.0 - saturation * std::max(0.0, std::min({k, 4.0 - k, 1.0})));
    }
    return color;
}

}  // namespace

Result<std::shared_ptr<const LabelMap>> labelMapFromVolume(const Volume& volume) {
    auto map = std::make_shared<LabelMap>();
    map->grid = volume.grid();
    map->ids.reserve(volume.voxelCount());
    std::vector<bool> occurs(65536, false);
    const auto components = static_cast<std::size_t>(volume.components());
    const glm::u64vec3 size(volume.grid().size);
    auto done = visitVoxels(volume, [&](auto voxels) -> Result<void> {
        for (std::size_t i = 0; i < voxels.size(); i += components) {
            const double value = volume.mapping().physical(static_cast<double>(voxels[i]));
            if (!(value >= 0.0 && value <= 65535.0) || value != std::floor(value)) {
                const std::size_t voxel = i / components;
                return fail(
                    ErrorCode::InvalidArgument,
                    fmt::format("voxel ({}, {}, {}) has the value {}, which is no label: allowed are whole "
                                "numbers from 0 to 65535",
                                voxel % size.x, voxel / size.x % size.y, voxel / size.x / size.y, value));
            }
            const auto id = static_cast<std::uint16_t>(value);
            occurs[id] = true;
            map->ids.push_back(id);
        }
        return {};
    });
    if (!done) return tl::unexpected(std::move(done.error()));
    for (unsigned id = 1; id < occurs.size(); ++id)
        if (occurs[id])
            map->labels[static_cast<std::uint16_t>(id)] =
                Label{fmt::format("label {}", id), labelColor(static_cast<std::uint16_t>(id)), true};
    return map;
}

}  // namespace pellucid
