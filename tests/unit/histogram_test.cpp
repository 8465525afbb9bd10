// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/histogram.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/test_volumes.h"

namespace pellucid {
namespace {

using test::makeVolume;

template <class T>
std::vector<T> randomValues(std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<> normal(20.0, 30.0);
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(static_cast<T>(std::clamp(
            normal(random), std::max(-120.0, static_cast<double>(std::numeric_limits<T>::lowest())), 120.0)));
    return values;
}

/// Written from the definition: equal bins over [lo, hi], the last one includes hi.
std::vector<std::uint64_t> bruteForce(const Volume& volume, int component, int bins) {
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(bins));
    const ValueRange range = volume.physicalRange(component);
    for (int k = 0; k < volume.grid().size.z; ++k)
        for (int j = 0; j < volume.grid().size.y; ++j)
            for (int i = 0; i < volume.grid().size.x; ++i) {
                const double value = volume.physical({i, j, k}, component);
                if (!std::isfinite(value)) continue;
                int bin = static_cast<int>(std::floor((value - range.lo) / (range.hi - range.lo) * bins));
                if (bin == bins) bin = bins - 1;
                ++counts[static_cast<std::size_t>(bin)];
            }
    return counts;
}

template <class T>
class HistogramOfType : public testing::Test {};
using AllTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                                std::uint32_t, float, double>;
TYPED_TEST_SUITE(HistogramOfType, AllTypes);

TYPED_TEST(HistogramOfType, EqualsCountingByHand) {
    for (const double slope : {1.0, -2.5}) {
        for (const int bins : {1, 7, 256, 1000}) {
            const VolumePtr volume = makeVolume<TypeParam>(
                {13, 11, 10}, randomValues<TypeParam>(13 * 11 * 10 * 2), {slope, 3.0, ""}, 2);
            for (int component = 0; component < 2; ++component) {
                const auto histogram = computeHistogram(*volume, component, bins);
                ASSERT_TRUE(histogram);
                EXPECT_EQ(histogram->counts, bruteForce(*volume, component, bins)) << bins << " " << slope;
                EXPECT_EQ(histogram->total(), volume->voxelCount());
                EXPECT_EQ(histogram->range, volume->physicalRange(component));
            }
        }
    }
}

TEST(Histogram, LargeVolumesAreCountedOnceWhateverTheThreads) {
    const glm::ivec3 size{160, 160, 100};  // More than two chunks of 2^20 voxels.
    const VolumePtr volume = makeVolume<float>(size, randomValues<float>(160 * 160 * 100));
    const auto histogram = computeHistogram(*volume, 0, 100);
    ASSERT_TRUE(histogram);
    EXPECT_EQ(histogram->counts, bruteForce(*volume, 0, 100));
}

TEST(Histogram, ValuesThatAreNotFiniteAreCountedApart) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const auto histogram =
        computeHistogram(*makeVolume<float>({6, 1, 1}, {nan, 0.0f, 1.0f, inf, -inf, 0.25f}), 0, 4);
    ASSERT_TRUE(histogram);
    EXPECT_EQ(histogram->counts, (std::vector<std::uint64_t>{1, 1, 0, 1}));
    EXPECT_EQ(histogram->nonFinite, 3u);
}

TEST(Histogram, AConstantVolumeLiesInTheFirstBin) {
    const auto histogram = computeHistogram(*makeVolume<float>({3, 1, 1}, {5.0f, 5.0f, 5.0f}), 0, 4);
    ASSERT_TRUE(histogram);
    EXPECT_EQ(histogram->counts, (std::vector<std::uint64_t>{3, 0, 0, 0}));
    EXPECT_EQ(histogram->quantile(0.5), 5.0);
}

TEST(Histogram, TheWholeRangeOfDoublesHasBins) {
    const double most = std::numeric_limits<double>::max();
    const auto histogram = computeHistogram(*makeVolume<double>({4, 1, 1}, {-most, most, 0.0, -1.0}), 0, 4);
    ASSERT_TRUE(histogram);
    EXPECT_EQ(histogram->counts, (std::vector<std::uint64_t>{1, 0, 2, 1}));
}

TEST(Histogram, QuantilesAreLinearWithinABin) {
    Histogram histogram{{0.0, 4.0}, {2, 0, 1, 1}, 0};
    const struct {
        double fraction, value;
    } cases[] = {{0.0, 0.0},   {0.25, 0.5}, {0.5, 1.0},  {0.75, 3.0},
                 {0.875, 3.5}, {1.0, 4.0},  {-1.0, 0.0}, {2.0, 4.0}};
    for (const auto& test : cases)
        EXPECT_DOUBLE_EQ(histogram.quantile(test.fraction), test.value) << test.fraction;
    EXPECT_EQ((Histogram{{3.0, 4.0}, {0, 0}, 5}).quantile(0.5), 3.0);
}

TEST(Histogram, WrongArgumentsAreRefused) {
    const VolumePtr volume = makeVolume<std::uint8_t>({2, 1, 1}, {1, 2});
    for (const auto& result : {computeHistogram(*volume, 0, 0), computeHistogram(*volume, 0, 65537),
                               computeHistogram(*volume, 1), computeHistogram(*volume, -1)}) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
    }
    EXPECT_TRUE(computeHistogram(*volume, 0, 65536));
}

TEST(Histogram, CanBeCancelledAndReportsProgress) {
    const glm::ivec3 size{160, 160, 100};
    const VolumePtr volume = makeVolume<std::uint8_t>(size, std::vector<std::uint8_t>(160 * 160 * 100));
    const auto cancelled = computeHistogram(*volume, 0, 16, [](double, std::string_view) { return false; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
    double last = 0.0;
    const auto watched = computeHistogram(*volume, 0, 16, [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        return true;
    });
    ASSERT_TRUE(watched);
    EXPECT_GT(last, 0.0);
}

}  // namespace
}  // namespace pellucid
