// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pellucid::renderer {

/// Turns after which the current context's driver ends a loop, counted by running one of a million turns:
/// that number when it does not. Mesa's llvmpipe gives up after 65535 turns of all loops of a pixel together,
/// silently.
[[nodiscard]] double measuredLoopLimit();

}  // namespace pellucid::renderer
