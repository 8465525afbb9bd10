// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/interaction.h"
#include "scene/image.h"

namespace pellucid::renderer {

/// The picture at another size: Catmull-Rom splines through its pixels, first along columns and then along
/// rows, each value kept between its two nearest ones, so that edges stay as sharp as splines make them and
/// get no halo. A constant stays the same bits, and so does a picture of that size. Making it smaller takes
/// values at the new pixels' centres without a low-pass, as fewer rays would. Several threads.
/// Precondition: neither size is empty.
[[nodiscard]] ImageF resized(const ImageF& image, glm::ivec2 size);

/// Size of the picture with rays reduced, at least one pixel.
[[nodiscard]] glm::ivec2 reducedSize(glm::ivec2 size, double reduction);

/// What drawing this picture with fewer rays and enlarging it would do to it, by kReductions, RMSE over every
/// eighth row. Within about a third: the rays are interpolated from the picture.
[[nodiscard]] std::array<double, kReductions.size()> reductionErrors(const ImageF& still);

}  // namespace pellucid::renderer
