// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// 8- and 16-bit data become 16-bit normalised texels, exactly (8-bit texels would be interpolated in 8 bits
/// by some drivers); everything else becomes 32-bit float, mapped to [0, 1] over its range.
[[nodiscard]] bool isStoredIn16Bits(VoxelType type);
[[nodiscard]] const char* textureFormatName(VoxelType type);
[[nodiscard]] std::uint64_t textureBytes(const VolumeFacts& facts);

/// stored = u * scale + offset, u the texel's value in [0, 1].
struct StoredFromTexel {
    double scale = 1.0;
    double offset = 0.0;
};
[[nodiscard]] StoredFromTexel storedFromTexel(VoxelType type, ValueRange storedRange);

}  // namespace pellucid::renderer
