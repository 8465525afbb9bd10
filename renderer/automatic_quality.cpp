// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/automatic_quality.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pellucid::renderer {

namespace {

// Pictures tried have about this many pixels: enough for a root mean square within a few percent, and a
// fiftieth of a screen.
constexpr double kTriedPixels = 16384.0;
constexpr double kLongestStep = 32.0;          // voxels
constexpr double kShortestStep = 1.0 / 128.0;  // voxels
/// The largest estimate, in tolerances, that is taken to meet it. Estimates are within a factor of 2 of the
/// error, those of a root mean square within 1.3 (docs/verification.md); what is tried is smaller than the
/// picture and sees other pixels.
double margin(ErrorNorm norm) {
    return norm == ErrorNorm::Max ? 0.5 : 0.75;
}

/// What is aimed at when settings are chosen, so that their estimates stay below the margin.
double aim(const Quality& quality) {
    return 0.9 * margin(quality.toleranceNorm) * toleranceOf(quality);
}

/// Parts of the aim that steps along the rays and interpolation between rays may use. Both errors together
/// are about the root of their squares' sum; the largest ones may meet in one pixel.
double stepShare(ErrorNorm norm) {
    return norm == ErrorNorm::Max ? 0.6 : 0.8;
}
double interpolationShare(ErrorNorm norm) {
    return norm == ErrorNorm::Max ? 0.4 : 0.6;
}

double stepAim(const Quality& quality) {
    return stepShare(quality.toleranceNorm) * aim(quality);
}

struct Tried {
    double stepVoxels = 0.0;
    double ms = 0.0;
    double error = 0.0;
};

struct Candidate {
    Quality quality;
    double ms = 0.0;     ///< Of a picture of the size tried.
    double error = 0.0;  ///< Expected; above the tolerance when no step meets it.
};

Scene smaller(const Scene& scene) {
    Scene probe = scene;
    const glm::dvec2 size(scene.picture.size);
    const double scale = std::min(1.0, std::sqrt(kTriedPixels / (size.x * size.y)));
    for (int axis = 0; axis < 2; ++axis)
        probe.picture.size[axis] = std::max(1, static_cast<int>(std::lround(size[axis] * scale)));
    return probe;
}

class Search {
public:
    Search(const Scene& scene, const DrawTimed& draw)
        : m_scene(smaller(scene)), m_draw(draw), m_tolerance(toleranceOf(scene.quality)) {
        Quality& quality = m_scene.quality;
        quality.automatic = false;
        quality.stepMm.reset();
        quality.interpolationGreyLevels.reset();
        quality.earlyTermination = std::min(0.1 * m_tolerance, 1.0 / 64.0);
    }

    Result<void> findTruth();
    /// Nothing when not even its longest step can be drawn.
    Result<std::optional<Candidate>> tryIntegrator(Integrator integrator);

private:
    /// Nothing where the plan refuses so short a step.
    Result<std::optional<TimedImage>> drawWith(const Quality& quality, double stepVoxels);
    double errorOf(const ImageF& image) const {
        return errorIn(m_scene.quality.toleranceNorm, pictureError(image, m_truth));
    }
    Candidate between(const Quality& quality, const std::vector<Tried>& tries) const;

    Scene m_scene;
    const DrawTimed& m_draw;
    double m_tolerance;
    ImageF m_truth;
};

Result<std::optional<TimedImage>> Search::drawWith(const Quality& quality, double stepVoxels) {
    Scene scene = m_scene;
    scene.quality = quality;
    scene.quality.stepVoxels = stepVoxels;
    auto drawn = m_draw(scene);
    if (drawn) return std::optional(std::move(*drawn));
    if (drawn.error().code == ErrorCode::InvalidArgument) return std::optional<TimedImage>();
    return tl::unexpected(drawn.error());
}

/// Halves the step until the picture changes by less than a quarter of the tolerance.
Result<void> Search::findTruth() {
    Quality quality = m_scene.quality;
    quality.earlyTermination = 0.0;
    quality.accumulation = Accumulation::Float32;
    quality.jitter = false;
    if (usesIntegrator(m_scene.mode)) quality.integrator = Integrator::IntegralFunctions;
    for (double step = 0.25; step >= kShortestStep; step /= 2.0) {
        auto drawn = drawWith(quality, step);
        if (!drawn) return tl::unexpected(drawn.error());
        if (!*drawn) return {};
        const bool isFirst = m_truth.pixels.empty();
        const double change = isFirst ? 0.0 : errorOf((*drawn)->image);
        m_truth = std::move((*drawn)->image);
        if (!isFirst && change <= 0.25 * m_tolerance) return {};
    }
    return {};
}

Result<std::optional<Candidate>> Search::tryIntegrator(Integrator integrator) {
    Quality quality = m_scene.quality;
    quality.integrator = integrator;
    std::vector<Tried> tries;
    for (double step = kLongestStep; step >= kShortestStep; step /= 2.0) {
        auto drawn = drawWith(quality, step);
        // Drivers finish compiling when a program first draws; that time is not the step's.
        if (drawn && *drawn && tries.empty()) drawn = drawWith(quality, step);
        if (!drawn) return tl::unexpected(drawn.error());
        if (!*drawn) break;
        tries.push_back({step, (*drawn)->ms, m_truth.pixels.empty() ? 0.0 : errorOf((*drawn)->image)});
        if (tries.back().error <= stepAim(quality)) break;
    }
    if (tries.empty()) return std::optional<Candidate>();
    return std::optional(between(quality, tries));
}

/// The step between the last two that should just meet the aim: errors follow a power of the step there,
/// times are a constant and a part in proportion to the samples.
Candidate Search::between(const Quality& quality, const std::vector<Tried>& tries) const {
    const Tried& fine = tries.back();
    Candidate candidate{quality, fine.ms, fine.error};
    candidate.quality.stepVoxels = fine.stepVoxels;
    const double wantedError = stepAim(quality);
    if (tries.size() < 2 || fine.error > wantedError) return candidate;
    const Tried& coarse = tries[tries.size() - 2];
    const double least = 1e-9;
    const double order =
        std::log(coarse.error / std::max(fine.error, least)) / std::log(coarse.stepVoxels / fine.stepVoxels);
    const double wanted = fine.stepVoxels * std::pow(wantedError / std::max(fine.error, least), 1.0 / order);
    const double step = std::clamp(wanted, fine.stepVoxels, coarse.stepVoxels);
    const double perSample =
        std::max(0.0, fine.ms - coarse.ms) / (1.0 / fine.stepVoxels - 1.0 / coarse.stepVoxels);
    candidate.quality.stepVoxels = step;
    candidate.ms = fine.ms - perSample * (1.0 / fine.stepVoxels - 1.0 / step);
    candidate.error = wantedError;
    return candidate;
}

}  // namespace

double toleranceOf(const Quality& quality) {
    return toleranceGreyLevels(quality) / 255.0;
}

bool meetsTolerance(const Quality& quality, const ErrorEstimate& estimate) {
    return errorIn(quality.toleranceNorm, estimate) <= margin(quality.toleranceNorm) * toleranceOf(quality);
}

double errorIn(ErrorNorm norm, const PictureError& error) {
    return norm == ErrorNorm::Max ? error.max : error.rmse;
}

double errorIn(ErrorNorm norm, const ErrorEstimate& estimate) {
    return errorIn(norm, PictureError{estimate.maxError, estimate.rmse});
}

std::string whyUnmet(const Quality& quality, const ErrorEstimate& estimate, const std::string& whyNoFiner) {
    if (meetsTolerance(quality, estimate)) return {};
    const double error = errorIn(quality.toleranceNorm, estimate);
    const std::string within =
        error <= toleranceOf(quality)
            ? fmt::format(", within it but for what an estimate may miss ({:g} grey levels are allowed)",
                          255.0 * margin(quality.toleranceNorm) * toleranceOf(quality))
            : "";
    return fmt::format("the estimate is {:.3g} grey levels{}; {}", 255.0 * error, within, whyNoFiner);
}

Result<Quality> chooseQuality(const Scene& scene, const DrawTimed& draw) {
    Search search(scene, draw);
    if (auto found = search.findTruth(); !found) return tl::unexpected(found.error());
    std::vector<Integrator> integrators{Integrator::Exponential};
    // Those of higher order are cheaper where the field is smooth only, and there the running integrals are
    // too; but they need fewer samples, which a device may limit.
    if (usesIntegrator(scene.mode))
        integrators.insert(integrators.end(),
                           {Integrator::IntegralFunctions, Integrator::Simpson, Integrator::GaussLegendre});
    constexpr std::size_t kUsual = 2;
    std::optional<Candidate> best;
    const double tolerance = toleranceOf(scene.quality);
    for (std::size_t i = 0; i < integrators.size(); ++i) {
        if (i >= kUsual && best && best->error <= tolerance) break;
        auto candidate = search.tryIntegrator(integrators[i]);
        if (!candidate) return tl::unexpected(candidate.error());
        if (!*candidate) continue;
        // What meets the tolerance goes before what does not, then time counts, or error where neither does.
        const auto rank = [&](const Candidate& c) {
            return c.error <= tolerance ? std::pair(0, c.ms) : std::pair(1, c.error);
        };
        if (!best || rank(**candidate) < rank(*best)) best = **candidate;
    }
    Quality stated = scene.quality;
    stated.automatic = false;
    // Without a step that can be drawn at all, drawing what is stated says why.
    if (!best) return stated;
    const ErrorNorm norm = scene.quality.toleranceNorm;
    best->quality.interpolationGreyLevels = 255.0 * interpolationShare(norm) * aim(scene.quality);
    return best->quality;
}

std::optional<Quality> coarser(const Attempt& attempt) {
    // Less is not worth another picture.
    constexpr double kWorthwhile = 1.25;
    const Quality& known = attempt.quality;
    const double room = aim(known) / std::max(attempt.error, 1e-9);
    if (room < kWorthwhile) return std::nullopt;
    Quality longer = known;
    // As for order 2; two pictures do not show more.
    longer.stepVoxels *= std::min(std::sqrt(room), 2.0);
    if (longer.interpolationGreyLevels)
        *longer.interpolationGreyLevels =
            std::min(*longer.interpolationGreyLevels * std::min(room, 2.0), 255.0 * aim(known));
    return longer;
}

Quality refined(const std::vector<Attempt>& attempts) {
    // At jumps it may be a half.
    constexpr double kLeastOrder = 0.5;
    const Attempt& last = attempts.back();
    const Attempt* before = attempts.size() > 1 ? &attempts[attempts.size() - 2] : nullptr;
    if (before != nullptr && before->quality.stepVoxels == last.quality.stepVoxels) before = nullptr;
    double order = 1.0;
    if (before != nullptr)
        order = std::log(before->error / last.error) /
                std::log(before->quality.stepVoxels / last.quality.stepVoxels);
    // What pixels without a ray miss no shorter step lowers. Of the largest error it is no more than guessed
    // where rays are chosen; of others it shows by an error that stays.
    if (last.quality.interpolationGreyLevels &&
        (last.quality.toleranceNorm == ErrorNorm::Max || order < kLeastOrder)) {
        Quality everyPixel = before != nullptr ? before->quality : last.quality;
        everyPixel.interpolationGreyLevels.reset();
        return everyPixel;
    }
    // An order that two pictures do not show is not trusted.
    order = std::clamp(order, kLeastOrder, 2.0);
    Quality finer = last.quality;
    finer.stepVoxels *= std::clamp(std::pow(aim(finer) / last.error, 1.0 / order), 1.0 / 16.0, 0.8);
    // Which of the two it was is not known.
    if (finer.interpolationGreyLevels)
        *finer.interpolationGreyLevels *= std::clamp(aim(finer) / last.error, 0.25, 0.8);
    return finer;
}

}  // namespace pellucid::renderer
