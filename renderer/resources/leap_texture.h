// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"
#include "renderer/resources/occupancy.h"

namespace pellucid::renderer {

/// Distances of an Occupancy on the GPU, for shaders/leap/cubes.glsl.
[[nodiscard]] GlTexture uploadLeapField(const Occupancy& occupancy);

}  // namespace pellucid::renderer
