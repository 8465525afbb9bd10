// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include "app/desktop/render_service.h"

namespace pellucid::app {

/// What a picture cost and how wrong it is, in one line for the status bar: "1024 x 768, 812 ms   |   error
/// 0.8 grey levels RMS, 12 at most   |   steps of 0.5 voxels, exponential   |   11.2 MB". Of a picture in
/// passing: "moving: 1/2 size, 2x step, 84 ms, about 3 grey levels RMS from the still picture   |   ...".
/// `smallestSpacingMm` is the volume's; `passingError` what is known of a picture in passing (RMSE, display
/// units). Precondition: the reply has a frame.
[[nodiscard]] QString costText(const RenderService::Reply& reply, double smallestSpacingMm,
                               std::optional<double> passingError = std::nullopt);

}  // namespace pellucid::app
