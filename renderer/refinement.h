// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "renderer/error_estimate.h"
#include "renderer/interaction.h"

namespace pellucid::renderer {

/// The settings asked for, with what was chosen for them before (Frame::chosen) in place of automatic ones.
[[nodiscard]] Quality statedQuality(const Quality& asked, const std::optional<Quality>& chosen);
/// The settings for a picture in passing, as while the hand moves something: those asked for; where they are
/// automatic, what was chosen before (or is stated), since choosing takes longer; with steps that many times
/// longer. Opacity follows from a step's length, so the mean brightness stays.
[[nodiscard]] Quality passingQuality(const Quality& asked, const std::optional<Quality>& chosen,
                                     double stepTimes);

/// Pictures of a view that is still, each with half the step of the one before: four times the scene's step,
/// twice, the scene's own; and the one that the error is estimated by (comparison()), not to be shown.
///
/// Until that is there, the difference from the picture before stands for the error. It is no more than a
/// first idea: it is the error of the longer step, for order 2 three times too large, and what both pictures
/// miss (a maximum between samples) it does not hold. Over 240 pictures of scans and synthetic fields its
/// RMSE was off by more than a factor of 2 in 155, that of the comparison in 3.
///
/// A scene whose quality is automatic comes last as it is, with the renderer's own estimate; the pictures
/// before it have four times and twice the step that was chosen for it before.
class Refinement {
public:
    /// `chosen`: Frame::chosen of an earlier picture like this, for a scene whose quality is automatic.
    /// `from`: how many times longer the first steps are, 4, 2 or 1.
    explicit Refinement(Scene scene, const std::optional<Quality>& chosen = std::nullopt, double from = 4.0);

    [[nodiscard]] bool isDone() const { return m_stage == Stage::Done; }
    /// True when only the error is still to be estimated.
    [[nodiscard]] bool isMeasuring() const { return m_stage == Stage::Comparison; }
    /// What to draw next. Precondition: not isDone().
    [[nodiscard]] Scene next() const;
    /// Takes the frame of next(); gives the one to show now, with what is known of its error.
    std::shared_ptr<const Frame> take(Frame frame);
    /// Goes on without the frame of next(), which could not be drawn: a device may refuse so short a step,
    /// and still allow the scene's own rule with it. Precondition: isMeasuring().
    void giveUp();
    /// What the last picture taken tells of pictures in passing; nothing before the first.
    [[nodiscard]] const std::optional<PassingErrors>& passingErrors() const { return m_passingErrors; }

private:
    enum class Stage { FourSteps, TwoSteps, Asked, Comparison, Done };
    void learn(const Frame& frame, Stage taken);

    Scene m_scene;
    Quality m_stated;  ///< The scene's, or what was chosen for it before; never automatic.
    Stage m_stage = Stage::FourSteps;
    bool m_comparesWithItself = false;
    std::shared_ptr<const Frame> m_shown;
    std::optional<PassingErrors> m_passingErrors;
    std::optional<double> m_twoFromFour;  ///< RMSE of the pictures with twice and four times the step.
};

}  // namespace pellucid::renderer
