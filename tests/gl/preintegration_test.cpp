// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/preintegration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pellucid::renderer {
namespace {

/// Colour and mean extinction; without extinction the colour is 0.
glm::dvec4 entry(const std::vector<glm::vec4>& table, const PreintegrationLayout& layout, int front, int back,
                 int layer) {
    const glm::dvec4 found(
        table[static_cast<std::size_t>((layer * layout.size + back) * layout.size + front)]);
    return {found.a > 0.0 ? glm::dvec3(found) / found.a : glm::dvec3(0.0), found.a};
}

double opacity(double meanExtinction, double depth) {
    return -std::expm1(-meanExtinction * depth);
}

const TransferFunction1D kThin{"",
                               "",
                               {{0.0, {1, 0.5, 0.2}, 0.0},
                                {0.37, {1, 0.5, 0.2}, 0.0},
                                {0.37, {1, 0.5, 0.2}, 2.0},
                                {1.0, {1, 0.5, 0.2}, 2.0}}};

/// B4.5b: kappa = 4 s, colour s, length 1: colour of the segment 0 -> 1 is -exp(-2) + sqrt(pi / 8) erf(sqrt
/// 2).
TEST(Preintegration, NonassociatedColourHasItsClosedForm) {
    const TransferFunction1D function{"", "", {{0.0, {0, 0, 0}, 0.0}, {1.0, {1, 1, 1}, 4.0}}};
    const PreintegrationLayout layout{0.0, 1.0, 64, 2, 1.0};
    const auto table = preintegrate(function, layout, TableQuality::Exact);
    const auto forward = entry(table, layout, 0, 63, 1);
    const double alpha = opacity(forward.a, 1.0);
    EXPECT_NEAR(alpha, -std::expm1(-2.0), 1e-6);
    // 64 sub-segments of depth at most 4/64 neglect (depth / 64)^2 = 1e-3 of self-attenuation each, half of
    // it seen.
    EXPECT_NEAR(forward.r * alpha,
                -std::exp(-2.0) + std::sqrt(std::acos(-1.0) / 8.0) * std::erf(std::sqrt(2.0)), 2e-4);
    const auto backward = entry(table, layout, 63, 0, 1);
    EXPECT_NEAR(backward.a, forward.a, 1e-6);
    EXPECT_GT(backward.r, forward.r + 0.1);
    // Too short to hide anything: 2/3 both ways.
    EXPECT_NEAR(entry(table, layout, 0, 63, 0).r, 2.0 / 3.0, 1e-6);
    EXPECT_NEAR(entry(table, layout, 63, 0, 0).r, 2.0 / 3.0, 1e-6);
    // The preview neglects self-attenuation within the segment: colour is integral tau c / integral tau = 2/3
    // both ways.
    const auto preview = preintegrate(function, layout, TableQuality::Preview);
    EXPECT_NEAR(entry(preview, layout, 0, 63, 1).r, 2.0 / 3.0, 1e-6);
    EXPECT_NEAR(entry(preview, layout, 0, 63, 1).a, forward.a, 1e-6);
}

/// B4.5a: a step at 0.37 leaves 0.63 of the extinction for a segment over everything, and a constant colour
/// stays itself.
TEST(Preintegration, AStepIsIntegratedExactlyAndColourStays) {
    const PreintegrationLayout layout{0.0, 1.0, 65, 2, 3.0};
    const auto table = preintegrate(kThin, layout, TableQuality::Exact);
    EXPECT_NEAR(entry(table, layout, 0, 64, 1).a, 0.63 * 2.0, 1e-6);
    for (int front = 0; front < 65; ++front)
        for (int back = 0; back < 65; ++back) {
            const auto e = entry(table, layout, front, back, 1);
            if (e.a <= 0.0) continue;
            EXPECT_NEAR(e.r, 1.0, 1e-6);
            EXPECT_NEAR(e.g, 0.5, 1e-6);
            EXPECT_NEAR(e.b, 0.2, 1e-6);
        }
}

/// The mean over half an entry to both sides, which is the function itself where it is linear; at the ends
/// the function, since values beyond them see nothing else.
TEST(Preintegration, TheDiagonalIsTheMeanAroundAnEntry) {
    const PreintegrationLayout layout{0.0, 1.0, 65, 2, 1.0};
    const auto table = preintegrate(kThin, layout, TableQuality::Exact);
    for (int i = 0; i < 65; ++i) {
        // The jump at 0.37 * 64 = 23.68 lies 0.18 of an entry before the middle between 23 and 24.
        const double expected = i == 24 ? 2.0 * (24.5 - 23.68) : i < 24 ? 0.0 : 2.0;
        EXPECT_NEAR(entry(table, layout, i, i, 1).a, expected, 1e-6) << i;
    }
}

/// A peak of a thousandth of an entry keeps its integral over the values when the table is interpolated along
/// its diagonal, wherever it lies: what a smooth field sees at short steps.
TEST(Preintegration, APeakNarrowerThanAnEntryKeepsItsIntegral) {
    const PreintegrationLayout layout{0.0, 1.0, 65, 2, 1.0};
    for (const double at : {31.0, 31.2, 31.5, 31.9}) {
        const double half = 0.0005 / 64.0, middle = at / 64.0;
        const TransferFunction1D peak{
            "",
            "",
            {{middle - half, {1, 1, 1}, 0}, {middle, {1, 1, 1}, 1000}, {middle + half, {1, 1, 1}, 0}}};
        const auto table = preintegrate(peak, layout, TableQuality::Exact);
        double sum = 0.0;  // of the bilinear diagonal over each cell, which is a parabola
        for (int i = 0; i < 64; ++i)
            sum += (entry(table, layout, i, i, 1).a + entry(table, layout, i + 1, i + 1, 1).a +
                    0.5 * (entry(table, layout, i, i + 1, 1).a + entry(table, layout, i + 1, i, 1).a)) /
                   3.0;
        // The integral is sampled eight times an entry, so all of the peak is in it.
        EXPECT_NEAR(sum / 64.0, 1000 * half, 1e-6 * 1000 * half) << at;
    }
}

/// Four quarters seen one behind the other are the whole (B4.5a), also through layers of lengths.
TEST(Preintegration, QuartersComposeToTheWhole) {
    const TransferFunction1D function{
        "", "", {{0.0, {0.1, 0.9, 0.3}, 0.2}, {0.4, {1, 0.2, 0.6}, 3.0}, {1.0, {0.2, 0.3, 1.0}, 0.5}}};
    const PreintegrationLayout layout{0.0, 1.0, 65, 3, 2.0};  // layers: length 0, 1/4, 1
    const auto table = preintegrate(function, layout, TableQuality::Exact);
    for (const auto& [front, back] : {std::array{0, 64}, std::array{64, 0}, std::array{10, 42}}) {
        const auto whole = entry(table, layout, front, back, 2);
        double through = 1.0;
        glm::dvec3 seen(0.0);
        for (int k = 0; k < 4; ++k) {
            const int step = (back - front) / 4;
            const auto part = entry(table, layout, front + k * step, front + (k + 1) * step, 1);
            seen += through * opacity(part.a, 0.5) * glm::dvec3(part);
            through *= 1.0 - opacity(part.a, 0.5);
        }
        const double alpha = opacity(whole.a, 2.0);
        EXPECT_NEAR(1.0 - through, alpha, 1e-5);
        // Sub-segments of depth up to 3 * 2 / 64 = 0.09 neglect at most 0.09^2 / 12 of a colour difference
        // below 1.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], alpha * whole[c], 7e-4);
    }
}

TEST(Preintegration, RunningIntegralsAreThoseOfThePolynomials) {
    // tau = 2 v on [0, 1], colour v: integral tau = v^2, integral tau c = 2 v^3 / 3; constant outside.
    const TransferFunction1D function{"", "", {{0.0, {0, 0, 0}, 0.0}, {1.0, {1, 1, 1}, 2.0}}};
    const RunningIntegrals running(function);
    for (const double v : {0.0, 0.3, 0.77, 1.0}) {
        EXPECT_NEAR(running.at(v).extinction, v * v, 1e-15);
        EXPECT_NEAR(running.at(v).emission.x, 2.0 / 3.0 * v * v * v, 1e-15);
    }
    EXPECT_NEAR(running.at(3.0).extinction, 1.0 + 2.0 * 2.0, 1e-15);
    EXPECT_NEAR(running.at(-5.0).extinction, 0.0, 1e-15);
}

}  // namespace
}  // namespace pellucid::renderer
