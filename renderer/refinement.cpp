// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/refinement.h"

#include <utility>

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

Quality passingQuality(const Quality& asked, const std::optional<Quality>& chosen) {
    return asked.automatic ? withStepTimes(statedQuality(asked, chosen), 2.0) : asked;
}

Refinement::Refinement(Scene scene, const std::optional<Quality>& chosen)
    : m_scene(std::move(scene)), m_stated(statedQuality(m_scene.quality, chosen)) {
    // A slice takes one sample a pixel: there is nothing to refine.
    if (m_scene.mode == Mode::Slice) m_stage = Stage::Asked;
}

Scene Refinement::next() const {
    PELLUCID_CHECK(!isDone());
    if (m_stage == Stage::Comparison) return comparison(m_scene, m_shown->plan);
    Scene scene = m_scene;
    if (m_stage == Stage::FourSteps) scene.quality = withStepTimes(m_stated, 4.0);
    if (m_stage == Stage::TwoSteps) scene.quality = withStepTimes(m_stated, 2.0);
    return scene;
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
    if (m_shown && !frame.error)
        frame.error = errorOf(pictureError(m_shown->image, frame.image), frame.image, frame.plan,
                              "a first idea from a picture with twice the step");
    const bool isKnown = m_scene.quality.automatic || m_scene.mode == Mode::Slice;
    if (taken == Stage::Asked && isKnown) m_stage = Stage::Done;
    m_shown = std::make_shared<const Frame>(std::move(frame));
    return m_shown;
}

}  // namespace pellucid::renderer
