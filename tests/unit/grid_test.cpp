// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/grid.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

namespace pellucid {
namespace {

using testing::HasSubstr;

struct GridCase {
    const char* name;
    Grid grid;
};

Grid withLinear(glm::ivec3 size, glm::dmat3 linear, glm::dvec3 origin) {
    Grid grid;
    grid.size = size;
    grid.patientFromIndex = glm::dmat4(linear);
    grid.patientFromIndex[3] = glm::dvec4(origin, 1.0);
    return grid;
}

std::vector<GridCase> grids() {
    const glm::dmat3 oblique(glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3))));
    const glm::dmat3 scale(0.5, 0, 0, 0, 0.7, 0, 0, 0, 3.0);
    glm::dmat3 tilted = scale;
    tilted[2] = {0.0, 0.9, 3.0};  // Gantry tilt: slices are pushed along y.
    glm::dmat3 extreme = oblique;
    extreme[0] *= 1e-3;
    extreme[1] *= 1.0;
    extreme[2] *= 1e3;
    return {{"unit", axisAlignedGrid({4, 5, 6})},
            {"one voxel", axisAlignedGrid({1, 1, 1}, {2, 2, 2})},
            {"anisotropic", axisAlignedGrid({512, 512, 20}, {0.4, 0.4, 5.0}, {-100, -120, 30})},
            {"oblique", withLinear({64, 32, 16}, oblique * scale, {10, -20, 30})},
            {"mirrored", withLinear({64, 32, 16}, glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1), {63, 0, 0})},
            {"sheared", withLinear({64, 32, 16}, tilted, {0, 0, 0})},
            {"sheared oblique mirrored", withLinear({64, 32, 16}, oblique * tilted * -1.0, {5, 6, 7})},
            {"spacing 1:1e6", withLinear({9, 9, 9}, extreme, {0, 0, 0})},
            {"10 m off", withLinear({64, 64, 64}, oblique, {1e4, -1e4, 1e4})},
            {"spacing 1e-200", axisAlignedGrid({3, 3, 3}, {1e-200, 2e-200, 1e-200})}};
}

TEST(Grid, IndexToPatientAndBackReturnsTheIndex) {
    std::mt19937 random(1);
    for (const auto& [name, grid] : grids()) {
        SCOPED_TRACE(name);
        ASSERT_TRUE(validate(grid));
        const glm::dmat4 back = indexFromPatient(grid);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 fraction(std::uniform_real_distribution<>(0, 1)(random),
                                      std::uniform_real_distribution<>(0, 1)(random),
                                      std::uniform_real_distribution<>(0, 1)(random));
            const glm::dvec3 index = fraction * glm::dvec3(grid.size) - 0.5;
            const glm::dvec3 patient = transformPoint(grid.patientFromIndex, index);
            const glm::dvec3 again = transformPoint(back, patient);
            // 1e-12 relative to the largest number that took part: in index units the size and the offset /
            // spacing.
            const double scale =
                std::max({glm::length(glm::dvec3(grid.size)),
                          glm::length(glm::dvec3(grid.patientFromIndex[3])) / smallestSpacingMm(grid),
                          glm::length(patient) / smallestSpacingMm(grid)});
            for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(again[axis], index[axis], 1e-12 * scale);
        }
    }
}

TEST(Grid, TextureCoordinatesSpanTheWholeVolume) {
    for (const auto& [name, grid] : grids()) {
        SCOPED_TRACE(name);
        const auto corners = cornersMm(grid);
        // Rounding of a patient coordinate, seen in the finest voxels.
        const double scale =
            (radiusMm(grid) + glm::length(glm::dvec3(grid.patientFromIndex[3]))) / smallestSpacingMm(grid);
        for (unsigned i = 0; i < 8; ++i) {
            const glm::dvec3 texture = transformPoint(textureFromPatient(grid), corners[i]);
            for (int axis = 0; axis < 3; ++axis) {
                const double expected = (i >> axis) & 1u ? 1.0 : 0.0;
                EXPECT_NEAR(texture[axis], expected, 1e-12 * scale);
                const glm::dvec3 patient = transformPoint(
                    patientFromTexture(grid), glm::dvec3(i & 1u ? 1 : 0, i & 2u ? 1 : 0, i & 4u ? 1 : 0));
                EXPECT_NEAR(patient[axis], corners[i][axis],
                            1e-11 * (radiusMm(grid) + glm::length(corners[i])));
            }
        }
    }
}

TEST(Grid, VoxelCentresAreIntegerIndices) {
    const Grid grid = axisAlignedGrid({4, 2, 1}, {0.5, 2, 3}, {10, 20, 30});
    EXPECT_EQ(transformPoint(grid.patientFromIndex, {0, 0, 0}), glm::dvec3(10, 20, 30));
    EXPECT_EQ(transformPoint(grid.patientFromIndex, {3, 1, 0}), glm::dvec3(11.5, 22, 30));
    EXPECT_EQ(transformPoint(textureFromIndex(grid), {0, 0, 0}), glm::dvec3(0.125, 0.25, 0.5));
    EXPECT_EQ(centreMm(grid), glm::dvec3(10.75, 21, 30));
    EXPECT_EQ(cornersMm(grid)[0], glm::dvec3(9.75, 19, 28.5));
    EXPECT_EQ(cornersMm(grid)[1], glm::dvec3(11.75, 19, 28.5));
    EXPECT_EQ(cornersMm(grid)[7], glm::dvec3(11.75, 23, 31.5));
    EXPECT_DOUBLE_EQ(radiusMm(grid), std::sqrt(1.0 + 4.0 + 2.25));
    EXPECT_EQ(spacingMm(grid), glm::dvec3(0.5, 2, 3));
    EXPECT_DOUBLE_EQ(meanSpacingMm(grid), 5.5 / 3);
    EXPECT_EQ(smallestSpacingMm(grid), 0.5);
    EXPECT_EQ(transformVector(grid.patientFromIndex, {1, 1, 1}), glm::dvec3(0.5, 2, 3));
}

TEST(Grid, TheSphereHoldsEveryCorner) {
    for (const auto& [name, grid] : grids()) {
        SCOPED_TRACE(name);
        double farthest = 0.0;
        for (const glm::dvec3& corner : cornersMm(grid))
            farthest = std::max(farthest, glm::length((corner - centreMm(grid)) / radiusMm(grid)));
        EXPECT_NEAR(farthest, 1.0, 1e-9);
    }
}

TEST(Grid, ShearIsSeen) {
    for (const auto& [name, grid] : grids()) {
        SCOPED_TRACE(name);
        EXPECT_EQ(isSheared(grid), std::string(name).starts_with("sheared"));
    }
}

TEST(Grid, InvalidGridsAreRefusedWithAReason) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Grid lastRow = axisAlignedGrid({2, 2, 2});
    lastRow.patientFromIndex[1][3] = 0.5;
    Grid notFinite = axisAlignedGrid({2, 2, 2});
    notFinite.patientFromIndex[3][1] = nan;
    const struct {
        const char* name;
        Grid grid;
        const char* message;
    } cases[] = {{"no voxels along j", axisAlignedGrid({2, 0, 2}), "size along j is 0"},
                 {"negative size", axisAlignedGrid({-1, 1, 2}), "size along i is -1"},
                 {"last row", lastRow, "last row"},
                 {"NaN", notFinite, "row 1 column 3 is nan"},
                 {"infinite spacing",
                  axisAlignedGrid({2, 2, 2}, {1, std::numeric_limits<double>::infinity(), 1}), "inf"},
                 {"zero spacing", axisAlignedGrid({2, 2, 2}, {1, 1, 0}), "spacing along k is 0"},
                 {"denormal spacing", axisAlignedGrid({2, 2, 2}, {5e-324, 1, 1}), "spacing along i"},
                 {"parallel axes", withLinear({2, 2, 2}, glm::dmat3(1, 0, 0, 2, 0, 0, 0, 0, 1), {0, 0, 0}),
                  "no inverse"},
                 {"axes in one plane",
                  withLinear({2, 2, 2}, glm::dmat3(1, 0, 0, 0, 1, 0, 1, 1, 0), {0, 0, 0}), "no inverse"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        const auto result = validate(test.grid);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(result.error().message, HasSubstr(test.message));
    }
}

TEST(Grid, VoxelCountsDoNotOverflow) {
    const int most = std::numeric_limits<int>::max();
    EXPECT_EQ(*checkedVoxelCount({1, 1, 1}), 1u);
    EXPECT_EQ(*checkedVoxelCount({2048, 2048, 2048}), 8589934592u);
    EXPECT_EQ(*checkedVoxelCount({most, most, 4}), 4ull * most * most);
    EXPECT_EQ(checkedVoxelCount({most, most, 5}).error().code, ErrorCode::TooLarge);
    EXPECT_EQ(checkedVoxelCount({most, most, most}).error().code, ErrorCode::TooLarge);
    EXPECT_EQ(checkedVoxelCount({1, 1, 0}).error().code, ErrorCode::InvalidArgument);
}

TEST(Grid, LettersNameTheDominantAxesFirst) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const struct {
        const char* name;
        glm::dvec3 direction;
        const char* letters;
    } cases[] = {{"left", {1, 0, 0}, "L"},
                 {"right", {-2, 0, 0}, "R"},
                 {"posterior", {0, 1e-30, 0}, "P"},
                 {"anterior", {0, -1e300, 0}, "A"},
                 {"superior", {0, 0, 1}, "S"},
                 {"inferior", {0, 0, -1}, "I"},
                 {"anterior, some left", {0.5, -0.8, 0}, "AL"},
                 {"left, anterior, superior", {0.7, -0.5, 0.4}, "LAS"},
                 {"below the threshold", {0.199, 0.98, 0.0}, "P"},
                 {"above the threshold", {0.21, 0.97, 0.0}, "PL"},
                 {"a tie goes by x, y, z", {1, 1, 1}, "LPS"},
                 {"zero", {0, 0, 0}, ""},
                 {"NaN", {nan, 0, 1}, ""}};
    for (const auto& test : cases) EXPECT_EQ(orientationLetters(test.direction), test.letters) << test.name;
}

}  // namespace
}  // namespace pellucid
