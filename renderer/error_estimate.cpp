// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/features.h"
#include "scene/check.h"

namespace pellucid::renderer {

namespace {

// Pictures this small are probed whole.
constexpr int kSmallestProbe = 64;

/// The scene with fewer pixels over the same view.
Scene reduced(const Scene& scene, int reduction) {
    Scene probe = scene;
    for (int axis = 0; axis < 2; ++axis)
        probe.picture.size[axis] = std::max(scene.picture.size[axis] / reduction,
                                            std::min(scene.picture.size[axis], kSmallestProbe));
    return probe;
}

/// Rules of order 4, which running integrals with a quarter of the step would be worse than.
bool isOfFourthOrder(Integrator integrator) {
    return integrator == Integrator::Simpson || integrator == Integrator::GaussLegendre;
}

/// True where running integrals are the limit of the scene's rule and better than the rule itself: a peak of
/// the function that falls between two samples is in the integral between them.
bool seesWholeFunction(const Scene& scene, const Plan& plan) {
    const Features& features = plan.features;
    if (!usesIntegrator(features.mode) || features.classification != Classification::Post ||
        fieldOf(features.filter) == Filter::Nearest || features.integrator == Integrator::Adaptive)
        return false;
    if (!isOfFourthOrder(features.integrator)) return true;
    if (scene.volumes.empty() || !scene.volumes.front().transferFunction) return true;
    const auto& points = scene.volumes.front().transferFunction->points;
    return std::any_of(points.begin(), points.end(), [&](const TransferPoint& point) {
        return point.value > plan.table.lo && point.value < plan.table.hi;
    });
}

}  // namespace

Integrator withoutTable(Integrator integrator) {
    return usesPreintegration(integrator) ? Integrator::IntegralFunctions : integrator;
}

Scene comparisonWithItself(const Scene& scene, const Plan& plan) {
    Scene better = scene;
    better.quality.stepMm = kComparisonStep * plan.stepMm;
    better.quality.earlyTermination = 0.0;
    better.quality.accumulation = Accumulation::Float32;
    better.quality.jitter = false;
    better.quality.interpolationGreyLevels.reset();
    better.quality.toleranceGreyLevels = 0.125 * toleranceGreyLevels(scene.quality);
    better.quality.integrator = withoutTable(scene.quality.integrator);
    return better;
}

Scene comparison(const Scene& scene, const Plan& plan) {
    Scene better = comparisonWithItself(scene, plan);
    if (seesWholeFunction(scene, plan)) better.quality.integrator = Integrator::IntegralFunctions;
    return better;
}

PictureError pictureError(const ImageF& a, const ImageF& b) {
    PELLUCID_CHECK(a.size == b.size);
    PictureError error;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double apart = std::abs(static_cast<double>(a.pixels[i][channel]) -
                                          static_cast<double>(b.pixels[i][channel]));
            error.max = std::max(error.max, apart);
            sum += apart * apart;
        }
    }
    error.rmse = std::sqrt(sum / (3.0 * static_cast<double>(std::max<std::size_t>(a.pixels.size(), 1))));
    return error;
}

ErrorEstimate errorOf(PictureError difference, const ImageF& picture, const Plan& plan, std::string method) {
    ErrorEstimate estimate;
    estimate.maxError = difference.max;
    estimate.rmse = difference.rmse;
    estimate.terminationBound = plan.earlyTerminationBound;
    estimate.tableBound = plan.table.worstError;
    estimate.probedPixels = static_cast<int>(picture.pixels.size());
    estimate.method = std::move(method);
    return estimate;
}

ErrorEstimate errorBeside(const ImageF& better, const ImageF& picture, const Plan& plan) {
    // What is left of the error at a quarter of the step. Extrema lie on kinks, where the error is of order
    // 1, and what is found is never beyond them, so that it does not cancel: 1 / (1 - 1/4).
    const bool extremum = plan.features.mode == Mode::Mip || plan.features.mode == Mode::MinIp;
    const double errorPerDifference = extremum ? 4.0 / 3.0 : 1.15;
    const PictureError apart = pictureError(picture, better);
    const bool isBlind = plan.features.mode == Mode::Emission || plan.features.mode == Mode::FirstHit;
    return errorOf(
        {errorPerDifference * apart.max, errorPerDifference * apart.rmse}, picture, plan,
        fmt::format("compared with a quarter of the step on {} x {} pixels{}", better.size.x, better.size.y,
                    isBlind ? "; what the function does between samples is in neither" : ""));
}

Result<ErrorEstimate> estimateError(const Scene& scene, const Plan& plan, const ImageF* picture,
                                    int reduction, const DrawScene& draw) {
    if (scene.mode == Mode::Slice) {
        ErrorEstimate estimate;
        estimate.terminationBound = plan.earlyTerminationBound;
        estimate.method = "a slice takes one sample a pixel and has no step";
        return estimate;
    }
    Scene probe = picture != nullptr ? scene : reduced(scene, reduction);
    probe.quality.stepMm = plan.stepMm;
    ImageF drawn;
    if (picture == nullptr) {
        auto coarse = draw(probe);
        if (!coarse) return tl::unexpected(coarse.error());
        drawn = std::move(*coarse);
        picture = &drawn;
    }
    auto better = draw(comparison(probe, plan));
    if (!better && better.error().code == ErrorCode::InvalidArgument)
        better = draw(comparisonWithItself(probe, plan));
    if (!better) return tl::unexpected(better.error());
    return errorBeside(*better, *picture, plan);
}

}  // namespace pellucid::renderer
