// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Pictures of scenes that state an error: settings are chosen, drawn and made finer until the estimate is
// met.
#include <fmt/format.h>

#include <chrono>

#include "renderer/error_estimate.h"
#include "renderer/renderer_state.h"

namespace pellucid::renderer {

namespace {

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Result<bool> Renderer::State::choose(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                     const RenderOptions& options) {
    Scene look = scene;
    look.camera = Camera{};
    look.picture = Picture{};
    if (choice && !volumes.empty() && choice->volume.lock() == volumes.front() && choice->look == look)
        return false;
    if (auto plan = planFor(scene, volumes); !plan) return tl::unexpected(plan.error());
    const auto draw = [&](const Scene& probe) -> Result<TimedImage> {
        auto plan = planWithEstimate(probe, volumes);
        if (!plan) return tl::unexpected(plan.error());
        FrameCost cost;
        auto image = drawOnce(probe, *plan, volumes.front(), options, cost);
        if (!image) return tl::unexpected(image.error());
        return TimedImage{std::move(*image), cost.gpuMs};
    };
    auto quality = chooseQuality(scene, draw);
    if (!quality) return tl::unexpected(quality.error());
    choice = Choice{look, volumes.front(), *quality};
    return true;
}

Result<void> Renderer::State::relax(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                    const RenderOptions& options, Frame& best) {
    constexpr int kMostTries = 2;
    Scene stated = scene;
    for (int i = 0; i < kMostTries; ++i) {
        const auto longer = coarser({choice->quality, errorIn(scene.quality.toleranceNorm, *best.error)});
        if (!longer) break;
        stated.quality = *longer;
        auto frame = drawStated(stated, volumes, options);
        if (!frame) return tl::unexpected(frame.error());
        if (!meetsTolerance(scene.quality, *frame->error)) break;
        choice->quality = *longer;
        best = std::move(*frame);
    }
    return {};
}

Result<Quality> Renderer::State::finer(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                       const std::vector<Attempt>& attempts) const {
    Scene stated = scene;
    stated.quality = refined(attempts);
    if (planWithEstimate(stated, volumes)) return stated.quality;
    // Devices refuse rays of too many samples; half the step may still be possible.
    stated.quality.stepVoxels = 0.5 * attempts.back().quality.stepVoxels;
    if (auto plan = planWithEstimate(stated, volumes); !plan) return tl::unexpected(plan.error());
    return stated.quality;
}

Result<Frame> Renderer::State::drawAutomatic(const Scene& scene, const std::vector<VolumePtr>& volumes,
                                             const RenderOptions& options) {
    constexpr std::size_t kMostAttempts = 8;
    const auto start = std::chrono::steady_clock::now();
    const auto isNew = choose(scene, volumes, options);
    if (!isNew) return tl::unexpected(isNew.error());
    RenderOptions estimated = options;
    estimated.estimateError = true;
    // The largest error may be at any pixel.
    if (scene.quality.toleranceNorm == ErrorNorm::Max) estimated.estimateReduction = 1;
    Scene stated = scene;
    std::vector<Attempt> attempts;
    while (true) {
        stated.quality = choice->quality;
        double otherMs = msSince(start);
        auto frame = drawStated(stated, volumes, estimated);
        if (!frame) return frame;
        attempts.push_back({choice->quality, errorIn(scene.quality.toleranceNorm, *frame->error)});
        std::string whyNoFiner;
        if (!meetsTolerance(scene.quality, *frame->error)) {
            whyNoFiner =
                fmt::format("{} pictures with ever finer settings do not get below", attempts.size());
            if (attempts.size() < kMostAttempts) {
                if (const auto next = finer(scene, volumes, attempts)) {
                    choice->quality = *next;
                    continue;
                } else {
                    whyNoFiner = "finer settings cannot be drawn (" + next.error().text() + ")";
                }
            }
        }
        frame->unmet = whyUnmet(scene.quality, *frame->error, whyNoFiner);
        if (*isNew && attempts.size() == 1 && meetsTolerance(scene.quality, *frame->error)) {
            const auto drawn = std::chrono::steady_clock::now();
            if (auto relaxed = relax(scene, volumes, estimated, *frame); !relaxed)
                return tl::unexpected(relaxed.error());
            otherMs += msSince(drawn);
        }
        // Where nearly every pixel has a ray, choosing them costs more than it saves.
        const double pixels = static_cast<double>(scene.picture.size.x) * scene.picture.size.y;
        if (static_cast<double>(frame->cost.rays) > 0.8 * pixels)
            choice->quality.interpolationGreyLevels.reset();
        frame->cost.prepareMs += otherMs;
        frame->cost.wallMs += otherMs;
        frame->chosen = choice->quality;
        return frame;
    }
}

}  // namespace pellucid::renderer
