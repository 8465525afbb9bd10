// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid {

enum class ResampleMethod {
    Sinc,      ///< Sinc in a Hann window of half-width 8 (Engel et al. 2006, section 9.2.5): sharp.
    Gaussian,  ///< Deviation 0.65 of the coarser of the two spacings: no overshoot, smooths.
    Fourier    ///< Zero-padded spectrum (section 1.5.3): the ideal sinc; whole factors from 2 to 8.
};

struct ResampleOptions {
    ResampleMethod method = ResampleMethod::Sinc;
    double factor = 2.0;  ///< New samples per old one along each axis, 1/64 to 64.
    Progress progress;
};

/// The volume on a grid finer or coarser by a factor: sample m of an axis stands at old index m / factor, so
/// voxel (0, 0, 0) stays where it is and a whole factor keeps every voxel's place. Below 1 the kernel is as
/// wide as the new spacing needs, a low-pass that removes what the new grid would alias. Physical values,
/// float32. Voxels beyond the grid repeat the outer ones; non-finite ones count as the smallest finite value.
/// Errors: InvalidArgument (factor), TooLarge (result above 16 GiB), Cancelled.
[[nodiscard]] Result<VolumePtr> resampled(const Volume& volume, const ResampleOptions& options);

/// A periodic sequence moved by `shift` samples, result[m] = f(m + shift) of the trigonometric polynomial f
/// through it. The highest frequency keeps its cosine part only. Precondition: the length is a power of two,
/// at least 2.
[[nodiscard]] std::vector<double> fourierShifted(std::span<const double> periodic, double shift);

}  // namespace pellucid
