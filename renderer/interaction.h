// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace pellucid::renderer {

/// What a picture in passing (while the hand moves something) leaves out of the still one.
struct Passing {
    double reduction = 1.0;  ///< Of width and height: one of kReductions.
    double stepTimes = 1.0;  ///< How many times longer the steps are: one of kStepTimes.
    bool operator==(const Passing&) const = default;
};

/// Each costs at most two thirds of the one before, so that a neighbour fits where one is just too slow.
inline constexpr std::array kReductions{1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0};
inline constexpr std::array kStepTimes{1.0, 2.0, 4.0};

/// Differences from the still picture, RMSE in display units.
struct PassingErrors {
    /// By kReductions.
    std::array<double, kReductions.size()> byReduction{};
    /// By kStepTimes; unknown until pictures with these steps have been seen.
    std::optional<std::array<double, kStepTimes.size()>> byStep;
};

/// Time and error that the first pictures are drawn for, before a user or a measurement says otherwise: on a
/// GPU a picture every other refresh of a screen, on a CPU one that still feels attached to the hand.
[[nodiscard]] constexpr double defaultFrameTargetMs(bool isSoftwareDevice) {
    return isSoftwareDevice ? 100.0 : 30.0;
}

/// Holds a frame time while something moves: of all reductions and steps those that fit into it by what
/// pictures before took, and of these the one that is least wrong by what still pictures have told.
class InteractionControl {
public:
    /// `targetMs` > 0: from the start of a picture until it can be shown.
    explicit InteractionControl(double targetMs) : m_targetMs(targetMs) {}

    [[nodiscard]] double targetMs() const { return m_targetMs; }
    void setTargetMs(double targetMs) { m_targetMs = targetMs; }

    /// A picture so drawn took `drawMs` for its `pixels` rays and `otherMs` for all else (tables, transport,
    /// enlarging).
    void took(const Passing& passing, double pixels, double drawMs, double otherMs);
    /// What a still picture told. Errors hardly change with the view, so they are good for the next ones.
    void learned(const PassingErrors& errors);

    /// How to draw the next picture of `pixels` pixels. Stays with the last answer unless that misses the
    /// time by a tenth, leaves half of it unused or is a quarter more wrong than another, so that sharpness
    /// does not flicker.
    [[nodiscard]] Passing next(double pixels);

    /// RMSE against the still picture, display units; nothing before a still picture has told.
    [[nodiscard]] std::optional<double> error(const Passing& passing) const;
    /// Time that a picture of `pixels` pixels is expected to take so; nothing before the first measurement.
    [[nodiscard]] std::optional<double> expectedMs(const Passing& passing, double pixels) const;
    /// The longest steps (one of kStepTimes) with which a picture of full size is better than one in passing;
    /// the longest of all until their errors are known.
    [[nodiscard]] double refinesFrom(const Passing& shown) const;

private:
    [[nodiscard]] std::optional<double> msPerPixel(std::size_t step) const;
    [[nodiscard]] double otherMs() const;
    /// For comparing choices: error(), or a rule of thumb before it is known.
    [[nodiscard]] double rank(const Passing& passing) const;

    double m_targetMs;
    /// By kStepTimes, as measured; those not drawn lately follow the ones that were.
    std::array<std::optional<double>, kStepTimes.size()> m_msPerPixel;
    std::deque<double> m_otherMs;  ///< Of the last three pictures.
    std::optional<PassingErrors> m_errors;
    std::optional<Passing> m_last;
};

}  // namespace pellucid::renderer
