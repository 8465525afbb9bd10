// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "accuracy/report_data.h"
#include "renderer/renderer.h"

namespace pellucid::accuracy {

/// Draws 4000 layers of opacity 0.01, 0.004 and 0.001 in each accumulation format.
[[nodiscard]] Result<std::vector<Stall>> measureStalls(renderer::Renderer& renderer,
                                                       const Progress& progress);

}  // namespace pellucid::accuracy
