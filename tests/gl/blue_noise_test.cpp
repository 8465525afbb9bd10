// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/blue_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>

namespace pellucid::renderer {
namespace {

constexpr int kSize = 64;

TEST(BlueNoise, EveryRankOccursOnce) {
    auto ranks = blueNoiseRanks(kSize);
    EXPECT_EQ(ranks, blueNoiseRanks(kSize));
    std::sort(ranks.begin(), ranks.end());
    for (std::size_t i = 0; i < ranks.size(); ++i) ASSERT_EQ(ranks[i], i);
}

/// Mean power of the lowest frequencies (up to 4 cycles over the tile) against the mean over all of a
/// shuffled tile.
double lowFrequencyPower(const std::vector<std::uint16_t>& ranks) {
    double power = 0.0;
    int count = 0;
    for (int v = 0; v <= 4; ++v)
        for (int u = 0; u <= 4; ++u) {
            if (u == 0 && v == 0) continue;
            std::complex<double> sum = 0.0;
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x)
                    sum += std::polar(
                        static_cast<double>(ranks[static_cast<std::size_t>(y * kSize + x)]) / 4096.0 - 0.5,
                        -2.0 * std::acos(-1.0) * (u * x + v * y) / kSize);
            power += std::norm(sum);
            ++count;
        }
    return power / count;
}

TEST(BlueNoise, HasNoLowFrequencies) {
    std::vector<std::uint16_t> white(kSize * kSize);
    std::iota(white.begin(), white.end(), std::uint16_t{0});
    std::mt19937 random(3);
    std::shuffle(white.begin(), white.end(), random);
    // White noise has the same power everywhere; blue noise a small part of it below a tenth of the sampling
    // frequency.
    EXPECT_LT(lowFrequencyPower(blueNoiseRanks(kSize)), 0.02 * lowFrequencyPower(white));
}

}  // namespace
}  // namespace pellucid::renderer
