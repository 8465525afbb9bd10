// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/number_limits.h"

#include <algorithm>

#include "renderer/plan/features.h"

namespace pellucid::renderer {

namespace {

// The largest float is 3.4e38; sums of 2^24 samples, of 4096 entries or of three channels stay below it.
constexpr double kLargest = 1e30;
constexpr double kLargestHalf = 65504.0;
// Integrals over the value are made in double, whose largest is 1.8e308.
constexpr double kLargestIntegral = 1e300;

/// Squares of lengths, and their inverses, are computed too.
Result<void> checkLengths(const Plan& plan, const Grid& grid) {
    constexpr double kLongestMm = 1e15, kShortestMm = 1e-15;
    const double diagonal = 2.0 * radiusMm(grid);
    if (!(diagonal >= kShortestMm && diagonal <= kLongestMm))
        return fail(ErrorCode::Unsupported,
                    fmt::format("the volume is {:g} mm from corner to corner; {:g} to {:g} mm can be drawn",
                                diagonal, kShortestMm, kLongestMm));
    if (plan.longestStepMm <= kLargest) return {};
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/quality/stepVoxels: the step is {:g} mm; at most {:g} mm can be computed",
                            plan.longestStepMm, kLargest));
}

double densestExtinction(const TransferFunction1D& function) {
    double densest = 0.0;
    for (const auto& point : function.points) densest = std::max(densest, point.extinction);
    return densest;
}

Result<void> checkDepth(const Scene& scene, double extinction, double lengthMm) {
    // Extinction per mm is computed with too, so not over less than 1 mm.
    const double wayMm = std::max(lengthMm, 1.0);
    const double depth = extinction * scene.densityScale / *scene.unitLengthMm * wayMm;
    if (depth <= kLargest) return {};
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/densityScale: an extinction of {:g}, times densityScale {:g}, for each {:g} mm "
                            "(unitLengthMm) make an optical depth of {:.3g} in {:g} mm; at most {:g} can be "
                            "computed, and 17 is already opaque",
                            extinction, scene.densityScale, *scene.unitLengthMm, depth, wayMm, kLargest));
}

/// Extinction summed over the values between the function's points.
Result<void> checkIntegral(const TransferFunction1D& function, double extinction) {
    const double lo = function.points.front().value, hi = function.points.back().value;
    // Halved, so that the difference does not overflow.
    if ((hi / 2 - lo / 2) * std::max(extinction, 1.0) <= kLargestIntegral / 2) return {};
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/volumes/0/transferFunction/points: an extinction of {:g} over values from {:g} "
                            "to {:g} is too much to be integrated; take the integrator exponential, or "
                            "values closer together",
                            extinction, lo, hi));
}

Result<void> checkBrightness(const Scene& scene, const Plan& plan, double extinction) {
    double brightest = plan.features.lit ? brightestReflection(scene) : 1.0;
    // The historical sum is too bright by the depth of a step.
    if (scene.mode == Mode::Composite && plan.features.integrator == Integrator::Riemann)
        brightest *=
            std::max(1.0, extinction * scene.densityScale / *scene.unitLengthMm * plan.longestStepMm);
    const bool half = plan.features.accumulation == Accumulation::Half;
    const double largest = half ? kLargestHalf : kLargest;
    if (brightest <= largest) return {};
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/lights: lights and material make a point {:.3g} times as bright as its colour; "
                            "at most {:g} can be computed{}, take less intensity, ambient, diffuse or "
                            "specular",
                            brightest, largest, half ? " in the accumulation half" : ""));
}

}  // namespace

double brightestReflection(const Scene& scene) {
    if (!scene.lights || scene.lights->empty()) return 1.0;
    double sum = scene.material.ambient;
    for (const auto& light : *scene.lights)
        sum += light.intensity * std::max({light.color.x, light.color.y, light.color.z}) *
               (scene.material.diffuse + scene.material.specular);
    return std::max(sum, 1.0);
}

Result<void> checkNumbers(const Scene& scene, const Plan& plan, const Grid& grid) {
    if (auto fine = checkLengths(plan, grid); !fine) return fine;
    double extinction = 0.0;
    if (usesTransferFunction(scene.mode)) {
        const TransferFunction1D& function = *scene.volumes.front().transferFunction;
        extinction = densestExtinction(function);
        // A ray is no longer than the diagonal, and a step may be longer than that.
        const double lengthMm = std::max(2.0 * radiusMm(grid), plan.longestStepMm);
        if (auto fine = checkDepth(scene, extinction, lengthMm); !fine) return fine;
        if (usesPreintegration(plan.features.integrator) || usesRunningIntegrals(plan.features.integrator))
            if (auto fine = checkIntegral(function, extinction); !fine) return fine;
    }
    return checkBrightness(scene, plan, extinction);
}

}  // namespace pellucid::renderer
