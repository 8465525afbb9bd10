// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/transfer_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pellucid::renderer {
namespace {

OpticalSample lookUp(const std::vector<glm::vec4>& table, const TableLayout& layout, double value) {
    const double x = std::clamp((value - layout.lo) / (layout.hi - layout.lo), 0.0, 1.0) * (layout.size - 1);
    const auto i = static_cast<std::size_t>(std::min(std::floor(x), layout.size - 2.0));
    const double f = x - static_cast<double>(i);
    const glm::dvec4 entry = (1.0 - f) * glm::dvec4(table[i]) + f * glm::dvec4(table[i + 1]);
    return {glm::dvec3(entry), entry.a};
}

TEST(TransferTable, WorstErrorIsTheLargestFoundByBruteForce) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 20; ++round) {
        TransferFunction1D function;
        double value = -100.0;
        for (int i = 0; i < 12; ++i) {
            value += unit(random) * (round % 2 == 0 ? 60.0 : 4.0);
            function.points.push_back(
                {value, {unit(random), unit(random), unit(random)}, unit(random) * 3.0});
        }
        const auto layout = layoutTable(function, {-90.0, 300.0}, 0.5);
        const auto table = bakeTable(function, layout.lo, layout.hi, layout.size);
        double worst = 0.0;
        for (int i = 0; i <= 40000; ++i) {
            const double v = layout.lo + (layout.hi - layout.lo) * i / 40000.0;
            const auto a = lookUp(table, layout, v);
            const auto b = evaluate(function, v);
            const double alphaA = 1.0 - std::exp(-0.5 * a.extinction),
                         alphaB = 1.0 - std::exp(-0.5 * b.extinction);
            worst = std::max(worst, std::abs(alphaA - alphaB));
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(alphaA * a.color[c] - alphaB * b.color[c]));
        }
        // Brute force misses the control point by at most a sample; float entries add 2^-24 relative.
        EXPECT_LE(worst, layout.worstError * 1.05 + 1e-6) << round;
    }
}

TEST(TransferTable, IntegerControlPointsInIntegerRangeAreExact) {
    const TransferFunction1D function{
        "",
        "HU",
        {{-1000, {0, 0, 0}, 0}, {-599, {1, 0, 0}, 0.3}, {123, {0, 1, 0}, 2.0}, {3000, {1, 1, 1}, 1.0}}};
    const auto layout = layoutTable(function, {-1024, 3071}, 1.0);
    EXPECT_LE(layout.worstError, 1.0 / 16384.0);
    EXPECT_LE(layout.size, 4096);
}

TEST(TransferTable, AStepIsReportedNotHidden) {
    const TransferFunction1D function{
        "", "", {{0, {1, 1, 1}, 0}, {0.37, {1, 1, 1}, 0}, {0.37, {1, 1, 1}, 5.0}, {1, {1, 1, 1}, 5.0}}};
    const auto layout = layoutTable(function, {0, 1}, 1.0);
    EXPECT_GT(layout.worstError, 0.1);
}

/// What is transparent to both sides costs no entries; a jump keeps an entry below and above.
TEST(TransferTable, TheVisiblePartEndsWhereTheFunctionDoes) {
    const auto shown = [](std::vector<TransferPoint> points) {
        return visiblePart({"", "", std::move(points)}).points;
    };
    const glm::dvec3 grey(0.5);
    const auto peak =
        shown({{-1000, grey, 0}, {195, grey, 0}, {200, grey, 2}, {205, grey, 0}, {3000, grey, 0}});
    EXPECT_EQ(peak.size(), 3u);
    EXPECT_EQ(peak.front().value, 195.0);
    EXPECT_EQ(peak.back().value, 205.0);
    const auto box =
        shown({{0, grey, 0}, {100, grey, 0}, {100, grey, 2}, {164, grey, 2}, {164, grey, 0}, {300, grey, 0}});
    EXPECT_EQ(box.front().value, 99.0);
    EXPECT_EQ(box.front().extinction, 0.0);
    EXPECT_EQ(box.back().value, 165.0);
    const auto narrow = shown({{0.25, grey, 0}, {0.25, grey, 2}, {0.75, grey, 0}});
    EXPECT_EQ(narrow.front().value, 0.25 - 0.5 / 64.0);
    EXPECT_EQ(narrow.back().value, 0.75);
    const auto open = shown({{0, grey, 1}, {1, grey, 2}});
    EXPECT_EQ(open.size(), 2u);
    const auto nothing = shown({{0, grey, 0}, {1, grey, 0}});
    EXPECT_EQ(nothing.size(), 2u);
}

TEST(TransferTable, NothingVariesOutsideTheReachableValues) {
    const TransferFunction1D function{"", "", {{100, {0, 0, 0}, 0}, {200, {1, 1, 1}, 1.0}}};
    const auto below = layoutTable(function, {0, 50}, 1.0);
    EXPECT_EQ(below.lo, below.hi);
    EXPECT_EQ(evaluate(function, below.lo).extinction, 0.0);
    const auto above = layoutTable(function, {300, 300}, 1.0);
    EXPECT_EQ(evaluate(function, above.lo).extinction, 1.0);
}

TEST(TransferTable, SharpFiltersReachBeyondTheVoxels) {
    // A checkerboard of 0 and 1 along one axis: the spline between two equal neighbours overshoots by 1/8 of
    // the step; in three axes the bound is (5/4)^3 of the absolute weights, of which half of the excess lies
    // on each side.
    const auto reach = reachableValues({0, 1}, Filter::CatmullRom);
    EXPECT_LE(reach.lo, -0.125);
    EXPECT_GE(reach.hi, 1.125);
    // Half-way between voxels the weights of Lanczos 3 are as 18, -100, 450, 450, -100, 18 with the sum 736:
    // 71/46 in absolute value.
    const double beyond = (std::pow(71.0 / 46.0, 3) - 1.0) / 2.0;
    EXPECT_DOUBLE_EQ(reachableValues({0, 1}, Filter::Lanczos3).lo, -beyond);
    EXPECT_DOUBLE_EQ(reachableValues({0, 1}, Filter::Lanczos3).hi, 1.0 + beyond);
    EXPECT_EQ(reachableValues({0, 1}, Filter::TricubicBSpline), (ValueRange{0, 1}));
}

}  // namespace
}  // namespace pellucid::renderer
