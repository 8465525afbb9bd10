// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/volume.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/unit/test_volumes.h"

namespace pellucid {
namespace {

using test::makeVolume;
using test::tryVolume;
using testing::HasSubstr;

template <class T>
class VolumeOfType : public testing::Test {};
using AllTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                                std::uint32_t, float, double>;
TYPED_TEST_SUITE(VolumeOfType, AllTypes);

TYPED_TEST(VolumeOfType, KeepsValuesAndFindsTheRange) {
    using T = TypeParam;
    const T lo = std::numeric_limits<T>::lowest(), hi = std::numeric_limits<T>::max();
    const VolumePtr volume = makeVolume<T>({2, 2, 2}, {1, 2, 3, 4, hi, 6, lo, 8});
    EXPECT_EQ(volume->voxelCount(), 8u);
    EXPECT_EQ(volume->stored({0, 0, 0}), 1.0);
    EXPECT_EQ(volume->stored({1, 0, 0}), 2.0);
    EXPECT_EQ(volume->stored({0, 1, 0}), 3.0);
    EXPECT_EQ(volume->stored({0, 0, 1}), static_cast<double>(hi));
    EXPECT_EQ(volume->stored({1, 1, 1}), 8.0);
    EXPECT_EQ(volume->storedRange(), (ValueRange{static_cast<double>(lo), static_cast<double>(hi)}));
    EXPECT_EQ(volume->nonFiniteCount(), 0u);
}

TYPED_TEST(VolumeOfType, ItsNameLeadsBackToIt) {
    const VoxelType type = test::voxelTypeOf<TypeParam>();
    EXPECT_EQ(bytesPerComponent(type), sizeof(TypeParam));
    EXPECT_EQ(voxelTypeFromName(name(type)), type);
}

TEST(Volume, UnknownTypeNamesGiveNothing) {
    EXPECT_EQ(voxelTypeFromName("int64"), std::nullopt);
    EXPECT_EQ(voxelTypeFromName(""), std::nullopt);
}

TEST(Volume, EveryComponentHasItsOwnRange) {
    const VolumePtr volume = makeVolume<std::int16_t>({2, 1, 1}, {1, -5, 7, 3, 9, -2}, {}, 3);
    EXPECT_EQ(volume->storedRange(0), (ValueRange{1, 3}));
    EXPECT_EQ(volume->storedRange(1), (ValueRange{-5, 9}));
    EXPECT_EQ(volume->storedRange(2), (ValueRange{-2, 7}));
    EXPECT_EQ(volume->stored({1, 0, 0}, 1), 9.0);
}

TEST(Volume, ValuesThatAreNotFiniteAreCountedAndLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const VolumePtr volume = makeVolume<float>({5, 1, 1}, {nan, 2.0f, -inf, 1.0f, inf});
    EXPECT_EQ(volume->nonFiniteCount(), 3u);
    EXPECT_EQ(volume->storedRange(), (ValueRange{1, 2}));
    EXPECT_TRUE(std::isnan(volume->stored({0, 0, 0})));
    const VolumePtr none = makeVolume<double>({2, 1, 1}, {std::nan(""), std::nan("")});
    EXPECT_EQ(none->storedRange(), (ValueRange{0, 0}));
    EXPECT_TRUE(volume->hasValues());
    EXPECT_FALSE(none->hasValues());
    EXPECT_EQ(none->nonFiniteCount(), 2u);
}

TEST(Volume, RangesOfLargeVolumesAreFoundInEveryPart) {
    // Larger than one chunk of the parallel search, with the extremes in the first and last voxels.
    const glm::ivec3 size{128, 128, 160};
    std::vector<float> values(static_cast<std::size_t>(size.x * size.y * size.z), 5.0f);
    values.front() = -7.0f;
    values.back() = 11.0f;
    values[values.size() / 2] = std::numeric_limits<float>::quiet_NaN();
    for (int turned = 0; turned < 2; ++turned) {
        const VolumePtr volume = makeVolume<float>(size, values);
        EXPECT_EQ(volume->storedRange(), (ValueRange{-7, 11}));
        EXPECT_EQ(volume->nonFiniteCount(), 1u);
        std::swap(values.front(), values.back());  // No part may be taken for the whole.
    }
}

TEST(Volume, PhysicalValuesFollowTheMapping) {
    const VolumePtr volume = makeVolume<std::int16_t>({2, 1, 1}, {0, 100}, {-2.0, 10.0, "HU"});
    EXPECT_EQ(volume->physical({0, 0, 0}), 10.0);
    EXPECT_EQ(volume->physical({1, 0, 0}), -190.0);
    EXPECT_EQ(volume->physicalRange(), (ValueRange{-190, 10}));
    EXPECT_EQ(volume->mapping().stored(-190.0), 100.0);
}

TEST(Volume, WhatDoesNotFitIsRefusedWithAReason) {
    const std::vector<std::uint8_t> eight(8), seven(7);
    const double inf = std::numeric_limits<double>::infinity();
    const Grid huge = axisAlignedGrid({2147483647, 2147483647, 4});
    const struct {
        const char* name;
        Result<VolumePtr> result;
        ErrorCode code;
        const char* message;
    } cases[] = {
        {"too few bytes", tryVolume<std::uint8_t>({2, 2, 2}, seven), ErrorCode::Corrupt,
         "need 8 bytes, found 7"},
        {"too many bytes", tryVolume<std::uint8_t>({2, 2, 1}, seven), ErrorCode::Corrupt,
         "need 4 bytes, found 7"},
        {"no components", tryVolume({2, 2, 2}, eight, {}, 0), ErrorCode::InvalidArgument, "0 components"},
        {"five components", tryVolume({2, 2, 2}, eight, {}, 5), ErrorCode::InvalidArgument, "5 components"},
        {"slope zero", tryVolume({2, 2, 2}, eight, {0.0, 0.0, ""}), ErrorCode::InvalidArgument, "slope"},
        {"slope infinite", tryVolume({2, 2, 2}, eight, {inf, 0.0, ""}), ErrorCode::InvalidArgument, "slope"},
        {"intercept NaN", tryVolume({2, 2, 2}, eight, {1.0, std::nan(""), ""}), ErrorCode::InvalidArgument,
         "intercept"},
        {"overflowing values", tryVolume<double>({1, 1, 1}, {1e300}, {1e300, 0.0, ""}),
         ErrorCode::InvalidArgument, "beyond the range of numbers"},
        {"no voxels", tryVolume<std::uint8_t>({0, 2, 2}, {}), ErrorCode::InvalidArgument, "size along i"},
        {"overflowing size", Volume::make(huge, VoxelType::Float64, 4, {}), ErrorCode::TooLarge,
         "2^64 bytes"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        ASSERT_FALSE(test.result);
        EXPECT_EQ(test.result.error().code, test.code);
        EXPECT_THAT(test.result.error().message, HasSubstr(test.message));
    }
}

template <class To>
std::vector<To> valuesOf(const NarrowedIntegers& narrowed) {
    std::vector<To> values(narrowed.voxels.size() / sizeof(To));
    std::memcpy(values.data(), narrowed.voxels.data(), narrowed.voxels.size());
    return values;
}

TEST(NarrowIntegers, TakesTheSmallestTypeThatHoldsAll) {
    const std::vector<std::int64_t> small{-2147483648ll, 0, 2147483647};
    auto narrowed = narrowIntegers(small);
    EXPECT_EQ(narrowed.type, VoxelType::Int32);
    EXPECT_EQ(valuesOf<std::int32_t>(narrowed), (std::vector<std::int32_t>{-2147483647 - 1, 0, 2147483647}));
    EXPECT_EQ(narrowed.worstError, 0.0);

    const std::vector<std::int64_t> positive{0, 4294967295ll};
    narrowed = narrowIntegers(positive);
    EXPECT_EQ(narrowed.type, VoxelType::UInt32);
    EXPECT_EQ(valuesOf<std::uint32_t>(narrowed), (std::vector<std::uint32_t>{0u, 4294967295u}));

    const std::vector<std::int64_t> both{-1, 4294967295ll};
    narrowed = narrowIntegers(both);
    EXPECT_EQ(narrowed.type, VoxelType::Float64);
    EXPECT_EQ(valuesOf<double>(narrowed), (std::vector<double>{-1.0, 4294967295.0}));
    EXPECT_EQ(narrowed.worstError, 0.0);

    EXPECT_EQ(narrowIntegers(std::span<const std::int64_t>()).type, VoxelType::Int32);
    const std::vector<std::uint64_t> unsignedSmall{7};
    EXPECT_EQ(narrowIntegers(unsignedSmall).type, VoxelType::Int32);
}

TEST(NarrowIntegers, SaysTheWorstRoundingError) {
    // 2^53 + 1 lies halfway between two doubles; 2^63 - 1 rounds up by 1; 2^64 - 1025 rounds by 1023 or 1025:
    // to even.
    const std::vector<std::int64_t> halfway{9007199254740993ll};
    EXPECT_EQ(narrowIntegers(halfway).worstError, 1.0);
    const std::vector<std::int64_t> most{std::numeric_limits<std::int64_t>::max()};
    EXPECT_EQ(narrowIntegers(most).worstError, 1.0);
    const std::vector<std::int64_t> least{std::numeric_limits<std::int64_t>::min()};
    EXPECT_EQ(narrowIntegers(least).worstError, 0.0);
    EXPECT_EQ(valuesOf<double>(narrowIntegers(least))[0], -9223372036854775808.0);
    const std::vector<std::uint64_t> largest{std::numeric_limits<std::uint64_t>::max(), 1};
    EXPECT_EQ(narrowIntegers(largest).worstError, 1.0);
    // Doubles just below 2^64 lie 2048 apart: 1000 above one of them is the error.
    const std::vector<std::uint64_t> between{18446744073709549568ull - 2048 + 1000};
    EXPECT_EQ(narrowIntegers(between).worstError, 1000.0);
}

}  // namespace
}  // namespace pellucid
