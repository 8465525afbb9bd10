// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/preintegration.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pellucid::renderer {
namespace {

glm::dvec4 entry(const std::vector<glm::vec4>& table, const PreintegrationLayout& layout, int front, int back,
                 int layer = 0) {
    return glm::dvec4(table[static_cast<std::size_t>((layer * layout.size + back) * layout.size + front)]);
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
    const PreintegrationLayout layout{0.0, 1.0, 64, 1, 1.0};
    const auto table = preintegrate(function, layout, TableQuality::Exact);
    const auto forward = entry(table, layout, 0, 63);
    const double alpha = opacity(forward.a, 1.0);
    EXPECT_NEAR(alpha, -std::expm1(-2.0), 1e-6);
    // 64 sub-segments of depth at most 4/64 neglect (depth / 64)^2 = 1e-3 of self-attenuation each, half of
    // it seen.
    EXPECT_NEAR(forward.r * alpha,
                -std::exp(-2.0) + std::sqrt(std::acos(-1.0) / 8.0) * std::erf(std::sqrt(2.0)), 2e-4);
    const auto backward = entry(table, layout, 63, 0);
    EXPECT_NEAR(backward.a, forward.a, 1e-6);
    EXPECT_GT(backward.r, forward.r + 0.1);
    // The preview neglects self-attenuation within the segment: colour is integral tau c / integral tau = 2/3
    // both ways.
    const auto preview = preintegrate(function, layout, TableQuality::Preview);
    EXPECT_NEAR(entry(preview, layout, 0, 63).r, 2.0 / 3.0, 1e-6);
    EXPECT_NEAR(entry(preview, layout, 0, 63).a, forward.a, 1e-6);
}

/// B4.5a: a step at 0.37 leaves 0.63 of the extinction for a segment over everything, and a constant colour
/// stays itself.
TEST(Preintegration, AStepIsIntegratedExactlyAndColourStays) {
    const PreintegrationLayout layout{0.0, 1.0, 65, 1, 3.0};
    const auto table = preintegrate(kThin, layout, TableQuality::Exact);
    EXPECT_NEAR(entry(table, layout, 0, 64).a, 0.63 * 2.0, 1e-6);
    for (int front = 0; front < 65; ++front)
        for (int back = 0; back < 65; ++back) {
            const auto e = entry(table, layout, front, back);
            if (e.a <= 0.0) continue;
            EXPECT_NEAR(e.r, 1.0, 1e-6);
            EXPECT_NEAR(e.g, 0.5, 1e-6);
            EXPECT_NEAR(e.b, 0.2, 1e-6);
        }
}

TEST(Preintegration, TheDiagonalIsTheFunctionItself) {
    const PreintegrationLayout layout{0.0, 1.0, 65, 1, 1.0};
    const auto table = preintegrate(kThin, layout, TableQuality::Exact);
    for (int i = 0; i < 65; ++i)
        EXPECT_NEAR(entry(table, layout, i, i).a, evaluate(kThin, i / 64.0).extinction, 1e-6);
}

/// Two halves seen one behind the other are the whole (B4.5a), also through layers of lengths.
TEST(Preintegration, HalvesComposeToTheWhole) {
    const TransferFunction1D function{
        "", "", {{0.0, {0.1, 0.9, 0.3}, 0.2}, {0.4, {1, 0.2, 0.6}, 3.0}, {1.0, {0.2, 0.3, 1.0}, 0.5}}};
    const PreintegrationLayout layout{0.0, 1.0, 65, 3, 2.0};  // layers: length 0, 1/2, 1
    const auto table = preintegrate(function, layout, TableQuality::Exact);
    for (const auto& [front, middle, back] :
         {std::array{0, 32, 64}, std::array{64, 32, 0}, std::array{10, 25, 40}}) {
        const auto a = entry(table, layout, front, middle, 1), b = entry(table, layout, middle, back, 1);
        const auto whole = entry(table, layout, front, back, 2);
        const double alphaA = opacity(a.a, 1.0), alphaB = opacity(b.a, 1.0), alpha = opacity(whole.a, 2.0);
        EXPECT_NEAR(1.0 - (1.0 - alphaA) * (1.0 - alphaB), alpha, 1e-5);
        // Sub-segments of depth up to 3 * 2 / 64 = 0.09 neglect at most 0.09^2 / 12 of a colour difference
        // below 1.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(alphaA * a[c] + (1.0 - alphaA) * alphaB * b[c], alpha * whole[c], 7e-4);
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
