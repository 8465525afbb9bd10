// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/transfer_function.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace pellucid {
namespace {

using testing::HasSubstr;

const double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Opacity, ExtinctionAndBackReturnsTheOpacity) {
    // Below the cap the only errors are the roundings of log1p and expm1.
    for (const double alpha : {0.0, 1e-300, 1e-17, 1e-8, 0.004, 0.5, 0.75, 0.95, 0.999, 1.0 - 1e-7}) {
        EXPECT_NEAR(opacityFromExtinction(extinctionFromOpacity(alpha)), alpha,
                    4e-16 * std::max(alpha, 1e-300))
            << alpha;
    }
    EXPECT_EQ(opacityFromExtinction(extinctionFromOpacity(1.0)), 1.0);
    EXPECT_DOUBLE_EQ(kOpaqueExtinction, 24.0 * std::log(2.0));
    EXPECT_EQ(extinctionFromOpacity(1.0), kOpaqueExtinction);
    EXPECT_EQ(opacityFromExtinction(kOpaqueExtinction), 1.0);
    EXPECT_LT(opacityFromExtinction(std::nextafter(kOpaqueExtinction, 0.0)), 1.0);
    EXPECT_EQ(opacityFromExtinction(1e300), 1.0);
    // What the cap still lets through is one unit in the last place of a float below 1.
    EXPECT_NEAR(std::exp(-kOpaqueExtinction), std::ldexp(1.0, -24), 1e-22);
}

TEST(Opacity, ChangesWithTheLengthAsOpacityCorrectionSays) {
    // Engel et al. 2006, eq. 1.17: A = 1 - (1 - A1)^Delta. Two samples of 0.5 make 0.75; half a sample of
    // 0.95 makes 0.776393.
    EXPECT_NEAR(opacityFromExtinction(2.0 * extinctionFromOpacity(0.5)), 0.75, 1e-15);
    EXPECT_NEAR(opacityFromExtinction(0.5 * extinctionFromOpacity(0.95)), 1.0 - std::sqrt(0.05), 1e-15);
    EXPECT_NEAR(opacityFromExtinction(0.5 * extinctionFromOpacity(0.95)), 0.776393, 5e-7);
}

TransferFunction1D steps() {
    TransferFunction1D function;
    function.points = {{0, {0, 0, 0}, 0},  {10, {1, 0.5, 0}, 2}, {10, {0, 0, 1}, 5},
                       {20, {0, 1, 1}, 1}, {20, {1, 1, 1}, 9},   {20, {0.5, 0.5, 0.5}, 4}};
    return function;
}

TEST(TransferFunction, EvaluatesToHandValues) {
    const struct {
        const char* name;
        double value;
        glm::dvec3 color;
        double extinction;
    } cases[] = {{"far below", -1e300, {0, 0, 0}, 0},
                 {"minus infinity", -kInf, {0, 0, 0}, 0},
                 {"first point", 0, {0, 0, 0}, 0},
                 {"a quarter", 2.5, {0.25, 0.125, 0}, 0.5},
                 {"just below the step", 10 - 1e-12, {1, 0.5, 0}, 2},
                 {"on the step the later point holds", 10, {0, 0, 1}, 5},
                 {"middle of the second part", 15, {0, 0.5, 1}, 3},
                 {"three at one value: the last holds", 20, {0.5, 0.5, 0.5}, 4},
                 {"far above", 1e300, {0.5, 0.5, 0.5}, 4},
                 {"infinity", kInf, {0.5, 0.5, 0.5}, 4},
                 {"NaN is the first point", kNan, {0, 0, 0}, 0}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        const OpticalSample sample = evaluate(steps(), test.value);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.color[c], test.color[c], 1e-12);
        EXPECT_NEAR(sample.extinction, test.extinction, 1e-12);
    }
}

TEST(TransferFunction, ASteppedFirstPointIsTheEarlierOneBelow) {
    TransferFunction1D function;
    function.points = {{5, {1, 1, 1}, 1}, {5, {1, 1, 1}, 7}};
    EXPECT_EQ(evaluate(function, 4.999).extinction, 1.0);
    EXPECT_EQ(evaluate(function, 5.0).extinction, 7.0);
}

TEST(TransferFunction, SurvivesTheWholeRangeOfDoubles) {
    const double most = std::numeric_limits<double>::max();
    TransferFunction1D function;
    function.points = {{-most, {0, 0, 0}, 0}, {most, {1, 1, 1}, 8}};
    ASSERT_TRUE(validate(function));
    EXPECT_EQ(evaluate(function, 0.0).extinction, 4.0);
    EXPECT_EQ(evaluate(function, most).extinction, 8.0);
}

TEST(TransferFunction, TheTableHoldsBothEndsAndExactValuesBetween) {
    const auto table = bakeTable(steps(), -5.0, 25.0, 61);  // Half a unit apart.
    ASSERT_EQ(table.size(), 61u);
    for (int i = 0; i < 61; ++i) {
        const OpticalSample sample = evaluate(steps(), -5.0 + 0.5 * i);
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(table[static_cast<std::size_t>(i)][c], static_cast<float>(sample.color[c])) << i;
        EXPECT_EQ(table[static_cast<std::size_t>(i)].a, static_cast<float>(sample.extinction)) << i;
    }
    const auto ends = bakeTable(steps(), 0.1, 19.9, 2);
    EXPECT_EQ(ends[0].a, static_cast<float>(evaluate(steps(), 0.1).extinction));
    EXPECT_EQ(ends[1].a, static_cast<float>(evaluate(steps(), 19.9).extinction));
}

TEST(TransferFunction, InvalidFunctionsAreRefusedWithThePoint) {
    const auto with = [](TransferPoint point) {
        TransferFunction1D function = steps();
        function.points[1] = point;
        return function;
    };
    TransferFunction1D many;
    many.points.resize(65537);
    TransferFunction1D most = many;
    most.points.resize(65536);
    EXPECT_TRUE(validate(most));
    EXPECT_TRUE(validate(steps()));
    const struct {
        const char* name;
        TransferFunction1D function;
        const char* message;
    } cases[] = {{"no points", {}, "/points: found 0 points, allowed are 1 to 65536"},
                 {"too many", many, "/points: found 65537 points"},
                 {"descending", with({-1, {0, 0, 0}, 0}), "/points/1/value: found -1 after 0"},
                 {"NaN value", with({kNan, {0, 0, 0}, 0}), "/points/1/value: found nan"},
                 {"infinite value", with({kInf, {0, 0, 0}, 0}), "/points/1/value: found inf"},
                 {"colour above 1", with({5, {0, 1.5, 0}, 0}), "/points/1/color/1: found 1.5"},
                 {"colour below 0", with({5, {0, 0, -0.1}, 0}), "/points/1/color/2: found -0.1"},
                 {"colour NaN", with({5, {kNan, 0, 0}, 0}), "/points/1/color/0: found nan"},
                 {"negative extinction", with({5, {0, 0, 0}, -1}), "/points/1/extinction: found -1"},
                 {"infinite extinction", with({5, {0, 0, 0}, kInf}), "/points/1/extinction: found inf"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        const auto result = validate(test.function);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(result.error().message, HasSubstr(test.message));
    }
}

TEST(TransferFunction, TheRampRisesFromTransparentBlackToWhite) {
    const TransferFunction1D ramp = rampFunction(100, 300, 0.5);
    ASSERT_TRUE(validate(ramp));
    EXPECT_EQ(evaluate(ramp, 100).extinction, 0.0);
    EXPECT_EQ(evaluate(ramp, 200).color, glm::dvec3(0.5));
    EXPECT_NEAR(opacityFromExtinction(evaluate(ramp, 300).extinction), 0.5, 1e-15);
    EXPECT_EQ(evaluate(rampFunction(7, 7, 1.0), 7).color, glm::dvec3(1.0));
}

TEST(TransferFunction, FollowingOpacityStaysWithinTheBound) {
    TransferFunction1D nodes;
    nodes.points = {{-100, {0, 0, 0}, 0},
                    {0, {1, 0, 0}, extinctionFromOpacity(0.7)},
                    {0, {1, 1, 0}, extinctionFromOpacity(0.1)},
                    {50, {1, 1, 1}, extinctionFromOpacity(1.0)},
                    {60, {1, 1, 1}, extinctionFromOpacity(1.0)},
                    {400, {0, 1, 1}, extinctionFromOpacity(0.05)}};
    const double bound = 0.5 / 255.0;
    const TransferFunction1D fine = followingOpacity(nodes, bound);
    ASSERT_TRUE(validate(fine));
    EXPECT_LT(fine.points.size(), 120u);
    double worst = 0.0, worstOfNodes = 0.0;
    for (std::size_t i = 1; i < nodes.points.size(); ++i) {
        const TransferPoint &a = nodes.points[i - 1], &b = nodes.points[i];
        for (int s = 0; a.value < b.value && s < 1000; ++s) {
            const double value = std::lerp(a.value, b.value, s / 1000.0);
            const double wanted = std::lerp(opacityFromExtinction(a.extinction),
                                            opacityFromExtinction(b.extinction), s / 1000.0);
            const OpticalSample sample = evaluate(fine, value);
            worst = std::max(worst, std::abs(opacityFromExtinction(sample.extinction) - wanted));
            worstOfNodes = std::max(
                worstOfNodes, std::abs(opacityFromExtinction(evaluate(nodes, value).extinction) - wanted));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(sample.color[c], std::lerp(a.color[c], b.color[c], s / 1000.0), 1e-12);
        }
    }
    EXPECT_LE(worst, bound);
    EXPECT_GT(worstOfNodes, 10 * bound);  // Else this test would prove nothing.
}

}  // namespace
}  // namespace pellucid
