// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/interaction.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/check.h"

namespace pellucid::renderer {

namespace {

// Until a time has been measured: a sixteenth of the rays and half the samples on each.
constexpr Passing kFirst{4.0, 2.0};
constexpr double kMissedBy = 1.1;      // Of the target, before a choice that suited is given up.
constexpr double kWorthAChange = 0.8;  // Of the error.
constexpr double kIdle = 0.5;          // Of the time: too much to be left unused for steadiness.
// Transport and tables may take longer than the target; drawing still gets this share of it.
constexpr double kLeastShare = 0.25;
constexpr std::size_t kKeptOthers = 3;

template <std::size_t N>
std::size_t indexIn(const std::array<double, N>& levels, double level) {
    const auto found = std::find(levels.begin(), levels.end(), level);
    PELLUCID_CHECK(found != levels.end());
    return static_cast<std::size_t>(found - levels.begin());
}

}  // namespace

void InteractionControl::took(const Passing& passing, double pixels, double drawMs, double otherMs) {
    m_otherMs.push_back(otherMs);
    if (m_otherMs.size() > kKeptOthers) m_otherMs.pop_front();

    const std::size_t step = indexIn(kStepTimes, passing.stepTimes);
    const std::optional<double> before = m_msPerPixel[step];
    double now = drawMs / std::max(pixels, 1.0);
    // Slower counts at once, since the hand feels it; faster may be luck.
    if (before && now < *before) now = 0.5 * (now + *before);
    // A nearer view or a fuller function makes all steps slower alike.
    if (before && *before > 0.0)
        for (auto& other : m_msPerPixel)
            if (other) *other *= now / *before;
    m_msPerPixel[step] = now;
}

void InteractionControl::learned(const PassingErrors& errors) {
    const auto stepsBefore = m_errors ? m_errors->byStep : std::nullopt;
    m_errors = errors;
    if (!m_errors->byStep) m_errors->byStep = stepsBefore;
}

std::optional<double> InteractionControl::msPerPixel(std::size_t step) const {
    // In proportion to the samples, from the nearest steps that were drawn. Towards shorter steps that is too
    // much rather than too little, since a ray has costs of its own.
    std::optional<double> found;
    std::size_t distance = kStepTimes.size();
    for (std::size_t i = 0; i < kStepTimes.size(); ++i) {
        const std::size_t apart = i > step ? i - step : step - i;
        if (!m_msPerPixel[i] || apart >= distance) continue;
        distance = apart;
        found = *m_msPerPixel[i] * kStepTimes[i] / kStepTimes[step];
    }
    return found;
}

double InteractionControl::otherMs() const {
    if (m_otherMs.empty()) return 0.0;
    // The median: a compilation or an upload happens once and says nothing about the next picture.
    std::vector<double> sorted(m_otherMs.begin(), m_otherMs.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted[(sorted.size() - 1) / 2];
}

std::optional<double> InteractionControl::expectedMs(const Passing& passing, double pixels) const {
    const auto cost = msPerPixel(indexIn(kStepTimes, passing.stepTimes));
    if (!cost) return std::nullopt;
    return *cost * pixels / (passing.reduction * passing.reduction) + otherMs();
}

std::optional<double> InteractionControl::error(const Passing& passing) const {
    if (!m_errors || !m_errors->byStep) return std::nullopt;
    // Independent, as one shifts edges and the other the values within.
    return std::hypot(m_errors->byReduction[indexIn(kReductions, passing.reduction)],
                      (*m_errors->byStep)[indexIn(kStepTimes, passing.stepTimes)]);
}

double InteractionControl::rank(const Passing& passing) const {
    if (const auto known = error(passing)) return *known;
    return std::hypot(passing.reduction - 1.0, 0.5 * (passing.stepTimes - 1.0));
}

Passing InteractionControl::next(double pixels) {
    if (!expectedMs(kFirst, pixels)) return kFirst;
    const double time = std::max(m_targetMs, otherMs() + kLeastShare * m_targetMs);
    Passing best{kReductions.back(), kStepTimes.back()};
    bool found = false;
    for (const double reduction : kReductions) {
        for (const double stepTimes : kStepTimes) {
            const Passing passing{reduction, stepTimes};
            if (*expectedMs(passing, pixels) > time || (found && rank(passing) >= rank(best))) continue;
            best = passing;
            found = true;
        }
    }
    const double lastMs = m_last ? *expectedMs(*m_last, pixels) : 0.0;
    const bool isLastGood =
        m_last && lastMs <= kMissedBy * time && (lastMs >= kIdle * time || rank(*m_last) <= rank(best));
    if (!isLastGood || rank(best) < kWorthAChange * rank(*m_last)) m_last = best;
    return *m_last;
}

double InteractionControl::refinesFrom(const Passing& shown) const {
    // What steps cost in error is learned from pictures with the longer ones.
    if (!m_errors || !m_errors->byStep) return kStepTimes.back();
    for (std::size_t step = kStepTimes.size() - 1; step > 0; --step) {
        const Passing full{1.0, kStepTimes[step]};
        if (rank(full) < rank(shown)) return kStepTimes[step];
    }
    return kStepTimes.front();
}

}  // namespace pellucid::renderer
