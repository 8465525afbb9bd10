// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/resample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

namespace pellucid {
namespace {

using std::numbers::pi;

template <class F>
VolumePtr volumeOf(glm::ivec3 size, F&& value) {
    std::vector<float> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) values.push_back(static_cast<float>(value(i, j, k)));
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return Volume::make(axisAlignedGrid(size, {1.0, 2.0, 3.0}, {5, 6, 7}), VoxelType::Float32, 1,
                        std::move(bytes))
        .value();
}

VolumePtr resampledBy(const Volume& volume, ResampleMethod method, double factor) {
    auto result = resampled(volume, {method, factor, {}});
    EXPECT_TRUE(result) << result.error().text();
    return *result;
}

VolumePtr randomVolume(glm::ivec3 size) {
    std::mt19937 random(7);
    return volumeOf(size, [&](int, int, int) { return static_cast<double>(random()) * 0x1p-32; });
}

constexpr int kLength = 256;

/// A cosine of so many cycles a voxel along x.
VolumePtr cosine(double cycles) {
    return volumeOf({kLength, 1, 1}, [&](int i, int, int) { return std::cos(2.0 * pi * cycles * i + 0.3); });
}

/// Largest value in the middle half, away from the ends.
double amplitude(const Volume& volume) {
    double largest = 0.0;
    const int n = volume.grid().size.x;
    for (int i = n / 4; i < 3 * n / 4; ++i) largest = std::max(largest, std::abs(volume.physical({i, 0, 0})));
    return largest;
}

/// Halving the samples: 0.2 cycles an old voxel are 0.4 a new one and stay; 0.3 are 0.6, which would come
/// back as 0.4.
TEST(Resample, TheLowPassRemovesWhatWouldAlias) {
    EXPECT_GE(amplitude(*resampledBy(*cosine(0.2), ResampleMethod::Sinc, 0.5)), 0.9);
    EXPECT_LE(amplitude(*resampledBy(*cosine(0.3), ResampleMethod::Sinc, 0.5)), 0.05);
    EXPECT_LE(amplitude(*resampledBy(*cosine(0.3), ResampleMethod::Gaussian, 0.5)), 0.05);
    double aliased = 0.0;  // every second sample
    for (int i = kLength / 4; i < 3 * kLength / 4; i += 2)
        aliased = std::max(aliased, std::abs(cosine(0.3)->physical({i, 0, 0})));
    EXPECT_GT(aliased, 0.9);
    EXPECT_GE(amplitude(*resampledBy(*cosine(0.4), ResampleMethod::Sinc, 2.0)), 0.9);
}

/// Half-width 8 against the cosine itself. Its kernel passes 1 - 3.5e-4 at 0.2 cycles, and 3.1e-4, 2.9e-5,
/// ... of the images at 0.8, 1.2, ...: 7e-4 together.
TEST(Resample, TheSincReproducesABandLimitedCosine) {
    const VolumePtr fine = resampledBy(*cosine(0.2), ResampleMethod::Sinc, 3.0);
    for (int m = 3 * 20; m < 3 * (kLength - 20); ++m)
        EXPECT_NEAR(fine->physical({m, 0, 0}), std::cos(2.0 * pi * 0.2 * m / 3.0 + 0.3), 1e-3) << m;
}

TEST(Resample, ConstantsStayAndWholeFactorsKeepTheVoxels) {
    const VolumePtr constant = volumeOf({5, 4, 3}, [](int, int, int) { return 0.75; });
    const VolumePtr random = randomVolume({9, 7, 5});
    for (const auto method : {ResampleMethod::Sinc, ResampleMethod::Gaussian, ResampleMethod::Fourier}) {
        const VolumePtr flat = resampledBy(*constant, method, 2.0);
        EXPECT_EQ(flat->grid().size, glm::ivec3(9, 7, 5));
        EXPECT_NEAR(flat->physicalRange().lo, 0.75, 1e-6);
        EXPECT_NEAR(flat->physicalRange().hi, 0.75, 1e-6);
        if (method == ResampleMethod::Gaussian) continue;
        const VolumePtr fine = resampledBy(*random, method, 2.0);
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 7; ++j)
                for (int i = 0; i < 9; ++i)
                    EXPECT_NEAR(fine->physical({2 * i, 2 * j, 2 * k}), random->physical({i, j, k}), 1e-5);
    }
    const VolumePtr fine = resampledBy(*random, ResampleMethod::Sinc, 2.0);
    const glm::dvec3 before = transformPoint(random->grid().patientFromIndex, {8, 6, 4});
    const glm::dvec3 after = transformPoint(fine->grid().patientFromIndex, {16, 12, 8});
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(before[axis], after[axis], 1e-12);
}

/// Passes along the axes, tap by tap, are the one sum over all voxels: each intermediate is float, 6e-8 of
/// values near 1.
TEST(Resample, PassesAreTheDirectConvolution) {
    const VolumePtr volume = randomVolume({6, 5, 4});
    const double factor = 1.5;
    const VolumePtr made = resampledBy(*volume, ResampleMethod::Gaussian, factor);
    const glm::ivec3 size = made->grid().size;
    EXPECT_EQ(size, glm::ivec3(8, 7, 5));
    const auto weight = [&](int m, int i) { return std::exp(-0.5 * std::pow((m / factor - i) / 0.65, 2.0)); };
    for (int c = 0; c < size.z; ++c)
        for (int b = 0; b < size.y; ++b)
            for (int a = 0; a < size.x; ++a) {
                double sum = 0.0;
                double weights = 0.0;
                for (int k = -6; k < 12; ++k)
                    for (int j = -6; j < 12; ++j)
                        for (int i = -6; i < 12; ++i) {
                            const double w = weight(a, i) * weight(b, j) * weight(c, k);
                            sum += w * volume->physical(
                                           {std::clamp(i, 0, 5), std::clamp(j, 0, 4), std::clamp(k, 0, 3)});
                            weights += w;
                        }
                EXPECT_NEAR(made->physical({a, b, c}), sum / weights, 1e-5);
            }
}

/// A shift by parts of a sample and back; whole shifts rotate.
TEST(Resample, FourierShiftsGoBack) {
    std::vector<double> line;
    for (int m = 0; m < 64; ++m)
        line.push_back(std::cos(2.0 * pi * 5 * m / 64) + 0.5 * std::sin(2.0 * pi * 31 * m / 64) + 0.1);
    const auto there = fourierShifted(line, 0.37);
    EXPECT_NEAR(there[3],
                std::cos(2.0 * pi * 5 * 3.37 / 64) + 0.5 * std::sin(2.0 * pi * 31 * 3.37 / 64) + 0.1, 1e-12);
    const auto back = fourierShifted(there, -0.37);
    const auto rotated = fourierShifted(line, 1.0);
    for (std::size_t m = 0; m < line.size(); ++m) {
        EXPECT_NEAR(back[m], line[m], 1e-12);
        EXPECT_NEAR(rotated[m], line[(m + 1) % line.size()], 1e-12);
    }
}

/// Up to 0.4 cycles a voxel the interpolated cosine is the cosine, away from the mirrored ends, whose kink
/// spreads as 1 / distance.
TEST(Resample, FourierInterpolatesBetweenTheVoxels) {
    const VolumePtr fine = resampledBy(*cosine(0.4), ResampleMethod::Fourier, 2.0);
    for (int m = kLength / 2; m < 3 * kLength / 2; ++m)
        EXPECT_NEAR(fine->physical({m, 0, 0}), std::cos(2.0 * pi * 0.4 * m / 2.0 + 0.3), 2e-2) << m;
}

TEST(Resample, RefusesWhatItCannotDo) {
    const VolumePtr volume = randomVolume({4, 4, 4});
    for (const double factor : {0.0, -1.0, 1e-3, 65.0, std::nan("")})
        EXPECT_EQ(resampled(*volume, {ResampleMethod::Sinc, factor, {}}).error().code,
                  ErrorCode::InvalidArgument);
    EXPECT_EQ(resampled(*volume, {ResampleMethod::Fourier, 2.5, {}}).error().code,
              ErrorCode::InvalidArgument);
    EXPECT_EQ(resampled(*randomVolume({64, 64, 64}), {ResampleMethod::Sinc, 64.0, {}}).error().code,
              ErrorCode::TooLarge);
    const auto stop = [](double, std::string_view) { return false; };
    EXPECT_EQ(resampled(*volume, {ResampleMethod::Sinc, 2.0, stop}).error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace pellucid
