// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/refinement.h"

#include <utility>

#include "renderer/resize.h"
#include "scene/check.h"

namespace pellucid::renderer {

namespace {

Quality withStepTimes(Quality quality, double times) {
    quality.stepVoxels *= times;
    if (quality.stepMm) *quality.stepMm *= times;
    quality.toleranceGreyLevels = times * toleranceGreyLevels(quality);
    if (quality.interpolationGreyLevels) *quality.interpolationGreyLevels *= times;
    quality.integrator = withoutTable(quality.integrator);
    return quality;
}

}  // namespace

Quality statedQuality(const Quality& asked, const std::optional<Quality>& chosen) {
    Quality stated = asked;
    stated.automatic = false;
    if (!asked.automatic || !chosen) return stated;
    stated.integrator = chosen->integrator;
    stated.stepVoxels = chosen->stepVoxels;
    stated.stepMm = chosen->stepMm;
    stated.earlyTermination = chosen->earlyTermination;
    stated.interpolationGreyLevels = chosen->interpolationGreyLevels;
    return stated;
}

Quality passingQuality(const Quality& asked, const std::optional<Quality>& chosen, double stepTimes) {
    const Quality stated = statedQuality(asked, chosen);
    return stepTimes == 1.0 ? stated : withStepTimes(stated, stepTimes);
}

Refinement::Refinement(Scene scene, const std::optional<Quality>& chosen, double from)
    : m_scene(std::move(scene)), m_stated(statedQuality(m_scene.quality, chosen)) {
    if (from < 4.0) m_stage = from < 2.0 ? Stage::Asked : Stage::TwoSteps;
    // A slice takes one sample a pixel: there is nothing to refine.
    if (m_scene.mode == Mode::Slice) m_stage = Stage::Asked;
}

Scene Refinement::next() const {
    PELLUCID_CHECK(!isDone());
    if (m_stage == Stage::Comparison)
        return m_comparesWithItself ? comparisonWithItself(m_scene, m_shown->plan)
                                    : comparison(m_scene, m_shown->plan);
    Scene scene = m_scene;
    if (m_stage == Stage::FourSteps) scene.quality = withStepTimes(m_stated, 4.0);
    if (m_stage == Stage::TwoSteps) scene.quality = withStepTimes(m_stated, 2.0);
    return scene;
}

void Refinement::giveUp() {
    PELLUCID_CHECK(isMeasuring());
    if (!std::exchange(m_comparesWithItself, true) &&
        comparisonWithItself(m_scene, m_shown->plan) != comparison(m_scene, m_shown->plan))
        return;
    m_stage = Stage::Done;
}

std::shared_ptr<const Frame> Refinement::take(Frame frame) {
    PELLUCID_CHECK(!isDone());
    const Stage taken = std::exchange(m_stage, static_cast<Stage>(static_cast<int>(m_stage) + 1));
    if (taken == Stage::Comparison) {
        Frame measured = *m_shown;
        measured.error = errorBeside(frame.image, measured.image, measured.plan);
        m_shown = std::make_shared<const Frame>(std::move(measured));
        return m_shown;
    }
    learn(frame, taken);
    if (m_shown && !frame.error)
        frame.error = errorOf(pictureError(m_shown->image, frame.image), frame.image, frame.plan,
                              "a first idea from a picture with twice the step");
    const bool isKnown = m_scene.quality.automatic || m_scene.mode == Mode::Slice;
    if (taken == Stage::Asked && isKnown) m_stage = Stage::Done;
    m_shown = std::make_shared<const Frame>(std::move(frame));
    return m_shown;
}

void Refinement::learn(const Frame& frame, Stage taken) {
    if (m_scene.mode == Mode::Slice) return;
    if (!m_passingErrors) m_passingErrors.emplace();
    m_passingErrors->byReduction = reductionErrors(frame.image);
    if (!m_shown) return;
    const double apart = pictureError(m_shown->image, frame.image).rmse;
    if (taken == Stage::TwoSteps) m_twoFromFour = apart;
    // The steps were multiples of what was known before; where another quality has been chosen since, they
    // tell nothing of its multiples.
    const bool isOfStated = !frame.chosen || statedQuality(m_scene.quality, frame.chosen) == m_stated;
    if (taken == Stage::Asked && m_twoFromFour && isOfStated)
        m_passingErrors->byStep = {0.0, apart, apart + *m_twoFromFour};
}

}  // namespace pellucid::renderer
