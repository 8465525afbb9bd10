// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include "app/desktop/render_service.h"

namespace pellucid::app {

/// What a picture cost and how wrong it is, in one line for the status bar: "1024 x 768, 812 ms   |   error
/// 0.8 grey levels RMS, 12 at most   |   steps of 0.5 voxels, exponential   |   11.2 MB". `smallestSpacingMm`
/// is the volume's. Precondition: the reply has a frame.
[[nodiscard]] QString costText(const RenderService::Reply& reply, double smallestSpacingMm);

}  // namespace pellucid::app
