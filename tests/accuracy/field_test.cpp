// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/accuracy/scenes.h"

namespace pellucid::accuracy {
namespace {

double at(const Field& field, glm::dvec3 index) {
    return field.value(field.cellOf(index), index);
}

VolumePtr delta() {
    return sampledVolume(axisAlignedGrid({7, 7, 7}), VoxelType::Float32,
                         [](glm::ivec3 i) { return i == glm::ivec3(3) ? 1.0 : 0.0; });
}

/// The kernels themselves, at the centre and half-way: Keys 1981 (a = -1/2), the uniform cubic B-spline, and
/// sinc(x) sinc(x / 3) at 1/2, 3/2, 5/2: 6, -4/3, 6/25 over pi^2, divided by their sum.
TEST(Field, KernelsHaveTheirKnownValues) {
    struct Case {
        Filter filter;
        double centre, half, oneAndHalf;
    };
    for (const Case& c : {Case{Filter::Nearest, 1.0, 0.0, 0.0}, Case{Filter::Trilinear, 1.0, 0.5, 0.0},
                          Case{Filter::TricubicBSpline, 4.0 / 6.0, 23.0 / 48.0, 1.0 / 48.0},
                          Case{Filter::CatmullRom, 1.0, 9.0 / 16.0, -1.0 / 16.0},
                          Case{Filter::Lanczos3, 1.0, 450.0 / 736.0, -100.0 / 736.0}}) {
        const Field field(*delta(), 0, c.filter);
        EXPECT_NEAR(at(field, {3, 3, 3}), std::pow(c.centre, 3), 1e-15) << name(c.filter);
        EXPECT_NEAR(at(field, {3.5, 3, 3}), c.half * c.centre * c.centre, 1e-15) << name(c.filter);
        EXPECT_NEAR(at(field, {3, 4.5, 3}), c.oneAndHalf * c.centre * c.centre, 1e-15) << name(c.filter);
        EXPECT_NEAR(at(field, {3, 3.5, 1.5}), c.half * c.centre * c.oneAndHalf, 1e-15) << name(c.filter);
    }
}

/// Weights sum to 1, also where voxels beyond the grid repeat the outer ones.
TEST(Field, ConstantStaysConstant) {
    const VolumePtr volume = test::constantVolume(axisAlignedGrid({3, 4, 5}), 0.75);
    for (const Filter filter : test::allFilters()) {
        const Field field(*volume, 0, filter);
        for (double x = -0.5; x <= 2.5; x += 0.37)
            for (double z = -0.5; z <= 4.5; z += 0.53) EXPECT_NEAR(at(field, {x, 1.2, z}), 0.75, 1e-14);
    }
}

TEST(Field, GradientOfALinearFieldIsExact) {
    const VolumePtr volume = sampledVolume(axisAlignedGrid({9, 9, 9}), VoxelType::Float64, [](glm::ivec3 i) {
        return 1.0 + 0.5 * i.x - 2.0 * i.y + 3.0 * i.z;
    });
    for (const Filter filter : test::allFilters()) {
        const Field field(*volume, 0, filter);
        const glm::dvec3 p(3.3, 4.2, 3.9);
        const glm::dvec3 g = field.centralDifference(field.cellOf(p), p);
        EXPECT_NEAR(g.x, 0.5, 1e-12) << name(filter);
        EXPECT_NEAR(g.y, -2.0, 1e-12) << name(filter);
        EXPECT_NEAR(g.z, 3.0, 1e-12) << name(filter);
    }
}

TEST(Field, NonFiniteVoxelsAreTheSmallestFiniteStoredValue) {
    const VolumePtr volume =
        sampledVolume(axisAlignedGrid({3, 1, 1}), VoxelType::Float32,
                      [](glm::ivec3 i) {
                          return i.x == 0 ? std::numeric_limits<double>::quiet_NaN()
                                          : (i.x == 1 ? -2.0 : std::numeric_limits<double>::infinity());
                      },
                      {-1.0, 10.0, ""});
    const Field field(*volume, 0, Filter::Nearest);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(at(field, {i, 0, 0}), 12.0);
}

}  // namespace
}  // namespace pellucid::accuracy
