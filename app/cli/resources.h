// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scene/result.h"

namespace pellucid::app {

/// The bundled sample: `sample/sample.json` of the resources that were installed beside this program
/// (../share/pellucid), else of the source tree it was built from. Errors: NotFound, naming the places.
[[nodiscard]] Result<std::filesystem::path> sampleScene();

}  // namespace pellucid::app
