// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_geometry.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numeric>

namespace pellucid::io {
namespace {

using testing::HasSubstr;

SlicePlacement sliceAt(int index, glm::dvec3 position) {
    SlicePlacement slice;
    slice.name = fmt::format("s{}", index);
    slice.size = {64, 48};
    slice.spacingMm = {0.5, 0.75};
    slice.positionMm = position;
    slice.rowDirection = {1, 0, 0};
    slice.columnDirection = {0, 1, 0};
    return slice;
}

/// Axial slices at these heights.
std::vector<SlicePlacement> slicesAt(const std::vector<double>& heights) {
    std::vector<SlicePlacement> slices;
    for (const double z : heights) slices.push_back(sliceAt(static_cast<int>(slices.size()), {-10, 20, z}));
    return slices;
}

std::vector<SlicePlacement> evenly(int count, glm::dvec3 step) {
    std::vector<SlicePlacement> slices;
    for (int k = 0; k < count; ++k) slices.push_back(sliceAt(k, static_cast<double>(k) * step));
    return slices;
}

Error errorOf(const std::vector<SlicePlacement>& slices) {
    const auto placed = placeSlices(slices);
    if (placed) return {ErrorCode::InvalidArgument, "it was placed", {}};
    return placed.error();
}

TEST(DicomGeometry, OrdersByPositionAlongTheNormal) {
    const auto placed = placeSlices(slicesAt({7.5, 0.0, 5.0, 2.5}));
    ASSERT_TRUE(placed) << placed.error().text();
    EXPECT_EQ(placed->order, (std::vector<std::size_t>{1, 3, 2, 0}));
    EXPECT_DOUBLE_EQ(placed->stepMm, 2.5);
    EXPECT_EQ(placed->patientFromIndex[0], glm::dvec4(0.5, 0, 0, 0));
    EXPECT_EQ(placed->patientFromIndex[1], glm::dvec4(0, 0.75, 0, 0));
    EXPECT_EQ(placed->patientFromIndex[2], glm::dvec4(0, 0, 2.5, 0));
    EXPECT_EQ(placed->patientFromIndex[3], glm::dvec4(-10, 20, 0, 1));
    EXPECT_TRUE(placed->warnings.empty());
}

TEST(DicomGeometry, FollowsTheNormalNotTheAxes) {
    // Sagittal slices, rows to posterior and columns to inferior: the normal is towards the right.
    auto slices = evenly(3, {1, 0, 0});
    for (auto& slice : slices) {
        slice.rowDirection = {0, 1, 0};
        slice.columnDirection = {0, 0, -1};
    }
    const auto placed = placeSlices(slices);
    ASSERT_TRUE(placed) << placed.error().text();
    EXPECT_EQ(placed->order, (std::vector<std::size_t>{2, 1, 0}));
    EXPECT_EQ(placed->patientFromIndex[2], glm::dvec4(-1, 0, 0, 0));
    EXPECT_EQ(placed->patientFromIndex[3], glm::dvec4(2, 0, 0, 1));
}

TEST(DicomGeometry, KeepsAGantryTiltAsShear) {
    const double angle = glm::radians(14.0);
    auto slices = evenly(4, {0, 0, 5});
    for (auto& slice : slices) slice.columnDirection = {0, std::cos(angle), -std::sin(angle)};
    const auto placed = placeSlices(slices);
    ASSERT_TRUE(placed) << placed.error().text();
    EXPECT_NEAR(placed->tiltDeg, 14.0, 1e-9);
    EXPECT_NEAR(placed->stepMm, 5.0 * std::cos(angle), 1e-12);
    EXPECT_EQ(placed->patientFromIndex[2], glm::dvec4(0, 0, 5, 0));
    ASSERT_EQ(placed->warnings.size(), 1u);
    EXPECT_THAT(placed->warnings[0].message, HasSubstr("14.00 degrees"));
}

TEST(DicomGeometry, NamesBothSidesOfAMissingSlice) {
    const Error error = errorOf(slicesAt({0, 5, 10, 20, 25}));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, HasSubstr("1 slice is missing between s2 and s3"));
    EXPECT_THAT(error.message, HasSubstr("10 mm apart where 5 mm is the step"));
}

TEST(DicomGeometry, CountsMissingSlicesAndGaps) {
    const Error error = errorOf(slicesAt({0, 1, 2, 6, 7, 9, 10}));
    EXPECT_THAT(error.message, HasSubstr("3 slices are missing between s2 and s3"));
    EXPECT_THAT(error.message, HasSubstr("2 such gaps"));
}

TEST(DicomGeometry, SeesAGapAmongThreeSlices) {
    // Either step could be the odd one; the smaller is taken for the step.
    EXPECT_THAT(errorOf(slicesAt({0, 5, 15})).message, HasSubstr("1 slice is missing between s1 and s2"));
    EXPECT_THAT(errorOf(slicesAt({0, 10, 15})).message, HasSubstr("1 slice is missing between s0 and s1"));
}

TEST(DicomGeometry, SeesOneMissingSliceAmongAThousandAtTheEnd) {
    std::vector<double> heights(1000);
    std::iota(heights.begin(), heights.end(), 0.0);
    heights.back() += 1.0;
    EXPECT_THAT(errorOf(slicesAt(heights)).message, HasSubstr("missing between s998 and s999"));
}

TEST(DicomGeometry, NamesTheStepsOfUnevenSlices) {
    const Error error = errorOf(slicesAt({0, 4, 8, 9.1, 16.1, 23.1}));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, HasSubstr("not evenly spaced"));
    EXPECT_THAT(error.message, HasSubstr("1.1 mm (s2 to s3) to 7 mm"));
    EXPECT_THAT(error.message, HasSubstr("2 x 4 mm, 2 x 7 mm, 1 x 1.1 mm"));
}

TEST(DicomGeometry, RefusesTwoSlicesAtOnePosition) {
    const Error error = errorOf(slicesAt({0, 2, 2, 4}));
    EXPECT_EQ(error.code, ErrorCode::Inconsistent);
    EXPECT_THAT(error.message, HasSubstr("4 slices lie at 3 positions"));
    EXPECT_THAT(error.message, HasSubstr("s1 and s2 are both at (-10.000, 20.000, 2.000) mm"));
    EXPECT_THAT(errorOf(slicesAt({1, 1, 1})).message, HasSubstr("3 slices lie at 1 position"));
}

TEST(DicomGeometry, RefusesASliceBesideTheLine) {
    auto slices = evenly(5, {0, 0, 2});
    slices[2].positionMm.x += 3.0;
    EXPECT_THAT(errorOf(slices).message, HasSubstr("s2 lies 3 mm beside the line"));
}

TEST(DicomGeometry, RefusesMixedSizesSpacingsAndOrientations) {
    auto slices = evenly(3, {0, 0, 2});
    slices[1].size.x = 65;
    EXPECT_THAT(errorOf(slices).message, HasSubstr("s0 has 64 x 48 pixels, s1 has 65 x 48"));
    slices = evenly(3, {0, 0, 2});
    slices[2].spacingMm.y = 0.76;
    EXPECT_THAT(errorOf(slices).message, HasSubstr("s2 has 0.5 x 0.76 mm"));
    slices = evenly(3, {0, 0, 2});
    slices[2].rowDirection = {0, 1, 0};
    slices[2].columnDirection = {-1, 0, 0};
    EXPECT_THAT(errorOf(slices).message, HasSubstr("turned by 90 degrees"));
    EXPECT_EQ(errorOf(slices).code, ErrorCode::Inconsistent);
}

TEST(DicomGeometry, ToleratesTheRoundingOfDecimalStrings) {
    // Positions with two decimals of a step of 1/3 mm, directions with six decimals.
    std::vector<SlicePlacement> slices;
    for (int k = 0; k < 200; ++k) {
        slices.push_back(sliceAt(k, {0, 0, std::round(k / 3.0 * 100.0) / 100.0}));
        slices.back().rowDirection.y = k % 2 == 0 ? 1e-6 : -1e-6;
    }
    const auto placed = placeSlices(slices);
    ASSERT_TRUE(placed) << placed.error().text();
    // Both ends are rounded by up to 0.005 mm over 199 steps.
    EXPECT_NEAR(placed->stepMm, 1.0 / 3.0, 0.01 / 199.0);
    EXPECT_TRUE(placed->warnings.empty());
}

TEST(DicomGeometry, WarnsOfStepsThatAreAlmostEven) {
    // A table that rounds to 0.1 mm: steps of 1.2 and 1.3 mm for 1.25 mm.
    const auto placed = placeSlices(slicesAt({0, 1.3, 2.5, 3.8, 5.0}));
    ASSERT_TRUE(placed) << placed.error().text();
    EXPECT_NEAR(placed->stepMm, 1.25, 1e-12);
    EXPECT_NEAR(placed->worstOffGridMm, 0.05, 1e-12);
    ASSERT_EQ(placed->warnings.size(), 1u);
    EXPECT_THAT(placed->warnings[0].message, HasSubstr("0.05 mm off even steps"));
    EXPECT_THAT(errorOf(slicesAt({0, 1.4, 2.5, 3.8, 5.0})).message, HasSubstr("not evenly spaced"));
}

TEST(DicomGeometry, DoesNotTakeRoundingForMicroscopicSteps) {
    // 0.02 mm would be 40 % of this step.
    EXPECT_THAT(errorOf(slicesAt({0, 0.05, 0.115, 0.15})).message, HasSubstr("not evenly spaced"));
    EXPECT_TRUE(placeSlices(slicesAt({0, 0.05, 0.10, 0.15})));
}

TEST(DicomGeometry, WarnsWhenTagsDisagreeWithPositions) {
    auto slices = evenly(3, {0, 0, 4});
    for (auto& slice : slices) {
        slice.statedStepMm = 2.0;
        slice.tiltDeg = 10.0;
        slice.thicknessMm = 7.0;  // Thickness is not spacing.
    }
    const auto placed = placeSlices(slices);
    ASSERT_TRUE(placed);
    EXPECT_DOUBLE_EQ(placed->stepMm, 4.0);
    ASSERT_EQ(placed->warnings.size(), 2u);
    EXPECT_THAT(placed->warnings[0].message,
                HasSubstr("SpacingBetweenSlices says 2 mm, the positions say 4 mm"));
    EXPECT_THAT(placed->warnings[1].message,
                HasSubstr("GantryDetectorTilt says 10 degrees, the positions say 0.00"));
}

TEST(DicomGeometry, GivesASingleSliceAnExtentWithAWarning) {
    auto slices = evenly(1, {0, 0, 0});
    EXPECT_DOUBLE_EQ(placeSlices(slices)->stepMm, 1.0);
    slices[0].thicknessMm = 3.0;
    EXPECT_DOUBLE_EQ(placeSlices(slices)->stepMm, 3.0);
    slices[0].statedStepMm = 2.5;
    const auto placed = placeSlices(slices);
    EXPECT_DOUBLE_EQ(placed->stepMm, 2.5);
    ASSERT_EQ(placed->warnings.size(), 1u);
    EXPECT_THAT(placed->warnings[0].message, HasSubstr("2.5 mm by SpacingBetweenSlices"));
}

TEST(DicomGeometry, RefusesNumbersThatCannotBe) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    auto slices = evenly(2, {0, 0, 1});
    slices[1].positionMm.y = nan;
    EXPECT_EQ(errorOf(slices).code, ErrorCode::Corrupt);
    slices = evenly(2, {0, 0, 1});
    slices[1].spacingMm.x = 0.0;
    EXPECT_EQ(errorOf(slices).code, ErrorCode::Corrupt);
    slices = evenly(2, {0, 0, 1});
    slices[0].rowDirection = {0.5, 0, 0};
    EXPECT_EQ(errorOf(slices).code, ErrorCode::Corrupt);
    slices = evenly(2, {0, 0, 1});
    slices[0].columnDirection = slices[0].rowDirection;
    EXPECT_THAT(errorOf(slices).message, HasSubstr("the cosine 1 between them"));
    EXPECT_EQ(placeSlices({}).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace pellucid::io
