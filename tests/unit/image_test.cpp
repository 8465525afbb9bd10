// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace pellucid {
namespace {

ImageF filled(glm::ivec2 size, glm::vec4 pixel) {
    return {size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x * size.y), pixel)};
}

TEST(Quantise, RoundsClampsAndMakesNanBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const struct {
        const char* name;
        float value;
        int expected;
    } cases[] = {{"zero", 0.0f, 0},
                 {"one", 1.0f, 255},
                 {"half", 0.5f, 128},  // 127.5 rounds up.
                 {"just below a half step", 0.49f / 255.0f, 0},
                 {"just above a half step", 0.51f / 255.0f, 1},
                 {"below 0", -3.0f, 0},
                 {"above 1", 7.0f, 255},
                 {"NaN", nan, 0},
                 {"infinity", inf, 255},
                 {"minus infinity", -inf, 0}};
    for (const auto& test : cases) {
        const Image8 image = quantise(filled({1, 1}, {test.value, 0, 0, 1}), false, false);
        ASSERT_EQ(image.bytes.size(), 3u);
        EXPECT_EQ(image.bytes[0], test.expected) << test.name;
    }
    for (int byte = 0; byte < 256; ++byte)
        for (const bool dither : {false, true}) {
            // Whole bytes survive both ways of rounding.
            const Image8 image =
                quantise(filled({8, 8}, glm::vec4(static_cast<float>(byte) / 255.0f)), false, false);
            EXPECT_EQ(image.bytes[0], byte) << dither;
        }
}

TEST(Quantise, DitherKeepsTheMeanAndRepeats) {
    for (const double grey : {0.001, 0.3, 0.5, 0.7071, 0.999}) {
        const ImageF image = filled({64, 64}, glm::vec4(static_cast<float>(grey)));
        const Image8 bytes = quantise(image, false, true);
        const double mean = std::accumulate(bytes.bytes.begin(), bytes.bytes.end(), 0.0) /
                            static_cast<double>(bytes.bytes.size());
        // 64 evenly spaced thresholds: the mean is off by at most half of 1/64 of a grey level, and float
        // rounding.
        EXPECT_NEAR(mean, static_cast<double>(static_cast<float>(grey)) * 255.0, 0.5 / 64.0 + 1e-9) << grey;
        EXPECT_EQ(bytes, quantise(image, false, true));
    }
}

TEST(Quantise, TheDitherPatternIsBayersAndUsesEveryThresholdOnce) {
    // Grey level t + 0.5 + (k + 0.5) / 64 rounds up on exactly k + 1 pixels of each 8x8 block when thresholds
    // differ.
    for (int k = 0; k < 64; ++k) {
        const Image8 bytes =
            quantise(filled({8, 8}, glm::vec4(static_cast<float>((10.0 + k / 64.0) / 255.0))), false, true);
        int up = 0;
        for (std::size_t i = 0; i < bytes.bytes.size(); i += 3) up += bytes.bytes[i] - 10;
        EXPECT_EQ(up, k);
    }
    // Bayer's 2x2 order: rising grey lights (1, 1) ... the first two of a block lie on one diagonal.
    const Image8 half = quantise(filled({2, 2}, glm::vec4(static_cast<float>(10.5 / 255.0))), false, true);
    EXPECT_EQ(half.bytes[0], half.bytes[9]);
    EXPECT_EQ(half.bytes[3], half.bytes[6]);
    EXPECT_NE(half.bytes[0], half.bytes[3]);
}

TEST(Quantise, TransparentPicturesLoseTheirAssociation) {
    const Image8 image = quantise(filled({1, 1}, {0.2f, 0.4f, 0.0f, 0.5f}), true, false);
    EXPECT_EQ(image.channels, 4);
    EXPECT_EQ(image.bytes, (std::vector<std::uint8_t>{102, 204, 0, 128}));
    const Image8 nothing = quantise(filled({1, 1}, {0, 0, 0, 0}), true, true);
    EXPECT_EQ(nothing.bytes, (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

TEST(Srgb, AgreesWithTheStandard) {
    EXPECT_EQ(std::lround(displayFromLinear(0.5) * 255.0), 188);
    EXPECT_EQ(std::lround(displayFromLinear(0.2) * 255.0), 124);
    EXPECT_NEAR(linearFromDisplay(0.5), 0.21404114, 1e-8);
    EXPECT_NEAR(displayFromLinear(0.001), 0.01292, 1e-15);
    EXPECT_EQ(linearFromDisplay(0.0), 0.0);
    EXPECT_DOUBLE_EQ(linearFromDisplay(1.0), 1.0);
    EXPECT_DOUBLE_EQ(displayFromLinear(1.0), 1.0);
    EXPECT_TRUE(std::isnan(displayFromLinear(std::nan(""))));
}

TEST(Srgb, ThereAndBackIsTheIdentityBeyondTheUnitRangeToo) {
    // At the joint of line and power the standard's rounded constants leave a jump of about 3e-8.
    for (double x = -4.0; x <= 4.0; x += 0.0078125) {
        EXPECT_NEAR(linearFromDisplay(displayFromLinear(x)), x, 1e-7) << x;
        EXPECT_NEAR(displayFromLinear(linearFromDisplay(x)), x, 1e-6) << x;
        EXPECT_EQ(linearFromDisplay(-x), -linearFromDisplay(x)) << x;
    }
}

}  // namespace
}  // namespace pellucid
