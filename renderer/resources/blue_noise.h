// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gpu/gl_handle.h"

namespace pellucid::renderer {

/// Ranks 0 ... size^2 - 1 of a square, periodic blue-noise pattern by void and cluster (Ulichney 1993), the
/// same in every run: any threshold leaves an even set of pixels. Rows of `size`, a power of two.
[[nodiscard]] std::vector<std::uint16_t> blueNoiseRanks(int size);

/// 64 x 64 offsets (rank + 1/2) / 4096 in (0, 1), R32F: each once, so their mean is 1/2.
[[nodiscard]] GlTexture createBlueNoise();

}  // namespace pellucid::renderer
