// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/image.h"
#include "scene/result.h"

namespace pellucid::accuracy {

/// Difference of two pictures in units of what is shown (RGB, 1 = full range). NaN anywhere makes every
/// figure NaN.
struct ImageDifference {
    double maxError = 0.0;
    glm::ivec2 worstPixel{0, 0};
    double meanError = 0.0;  ///< Mean absolute difference over pixels and RGB.
    double rmse = 0.0;
    double psnr = 0.0;  ///< dB against peak 1; infinite for equal pictures.
    double ssim =
        1.0;  ///< Wang et al. 2004 on luma (Rec. 709), 11x11 Gaussian window, sigma 1.5, dynamic range 1.
};

/// Errors: Inconsistent when the sizes differ (both are named).
[[nodiscard]] Result<ImageDifference> difference(const ImageF& a, const ImageF& b);

}  // namespace pellucid::accuracy
