// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace pellucid::renderer {

namespace {

constexpr int kReduction = 4;
// Pictures this small are probed whole.
constexpr int kSmallestProbe = 64;

/// The scene with fewer pixels over the same view.
Scene reduced(const Scene& scene) {
    Scene probe = scene;
    for (int axis = 0; axis < 2; ++axis)
        probe.picture.size[axis] = std::max(scene.picture.size[axis] / kReduction,
                                            std::min(scene.picture.size[axis], kSmallestProbe));
    return probe;
}

}  // namespace

Result<ErrorEstimate> estimateError(const Scene& scene, const Plan& plan, const DrawScene& draw) {
    ErrorEstimate estimate;
    estimate.terminationBound = plan.earlyTerminationBound;
    estimate.tableBound = plan.tableWorstError;
    if (scene.mode == Mode::Slice) {
        estimate.method = "a slice takes one sample a pixel and has no step";
        return estimate;
    }
    Scene coarse = reduced(scene);
    coarse.quality.stepMm = plan.stepMm;
    Scene fine = coarse;
    fine.quality.stepMm = 0.5 * plan.stepMm;
    const auto a = draw(coarse);
    if (!a) return tl::unexpected(a.error());
    const auto b = draw(fine);
    if (!b) return tl::unexpected(b.error());
    constexpr double kFirstOrder = 2.0;  // 2^1 / (2^1 - 1)
    double sum = 0.0;
    for (std::size_t i = 0; i < a->pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double error = kFirstOrder * std::abs(static_cast<double>(a->pixels[i][channel]) -
                                                        static_cast<double>(b->pixels[i][channel]));
            estimate.maxError = std::max(estimate.maxError, error);
            sum += error * error;
        }
    }
    estimate.rmse = std::sqrt(sum / (3.0 * static_cast<double>(a->pixels.size())));
    estimate.probedPixels = static_cast<int>(a->pixels.size());
    estimate.method = fmt::format("step halved on {} x {} pixels, first order assumed", coarse.picture.size.x,
                                  coarse.picture.size.y);
    return estimate;
}

}  // namespace pellucid::renderer
