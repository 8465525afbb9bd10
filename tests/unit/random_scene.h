// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "scene/scene.h"

namespace pellucid::test {

/// A valid scene with 0 to 3 volumes in which every member may be anything that is allowed: denormals, -0.0,
/// the largest doubles, numbers of 17 digits, every enumerator, text of any script.
Scene randomScene(std::mt19937_64& random);

}  // namespace pellucid::test
