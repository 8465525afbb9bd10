// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// How a volume's values and central differences stand in one texture, a voxel larger on every side. 16-bit
/// texels hold the differences of 8- and 16-bit data exactly unless the data span more than 32767 stored
/// values; what is stored as 32-bit float has them in 32-bit float.
struct FieldLayout {
    glm::ivec3 size{0};  ///< Texels.
    bool in16Bits = true;
    double storedFromTexel = 0.0;  ///< Of the volume's texture; 0 for float.
    double texelsPerStored = 1.0;  ///< 65535ths for a difference of one stored value.
    bool operator==(const FieldLayout&) const = default;

    /// u a voxel = (texel - y) * x.
    [[nodiscard]] glm::dvec2 differenceFromTexel() const;
    /// Largest error of a difference's component, as part of the data's range a voxel; float rounding aside.
    [[nodiscard]] double worstError() const;
    [[nodiscard]] std::uint64_t bytes() const;
};
[[nodiscard]] FieldLayout layoutField(const VolumeFacts& facts);

/// Where a scene's gradients come from, as far as it can be told without voxels; listed in the plan with what
/// it takes, or why it is left out. Precondition: the rest of the plan is complete and fit for gradients on
/// the fly. Errors: Unsupported and TooLarge, where a texture is asked for and cannot be.
[[nodiscard]] Result<void> planGradients(Plan& plan, const Scene& scene, const VolumeFacts& facts,
                                         const DeviceLimits& limits);

/// The plan with gradients on the fly, for want of the texture it had. Errors: those of fitLoops.
[[nodiscard]] Result<void> dropGradientTexture(Plan& plan, const DeviceLimits& limits,
                                               const std::string& reason);

}  // namespace pellucid::renderer
