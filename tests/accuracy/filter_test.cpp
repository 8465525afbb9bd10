// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Reconstruction filters: drawn slices against the field in double, ways of drawing one field against each
// other.
#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <set>

#include "accuracy/field.h"
#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class FilterVariants : public GpuTest {};

/// A slice through the volume's centre shown through a window of values 0 to 1, so that a pixel is the value.
Scene sliceScene(const Grid& grid, glm::dvec3 forward, double heightMm, Filter filter, glm::ivec2 size) {
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, forward, heightMm), size);
    scene.mode = Mode::Slice;
    scene.volumes.front().filter = filter;
    return scene;
}

/// Largest difference of a drawn slice and the field in double at the same points.
double sliceError(const Scene& scene, const VolumePtr& volume, const ImageF& image) {
    const accuracy::Field field(*volume, 0, scene.volumes.front().filter);
    const RayFrame frame = rayFrame(scene.camera, volume->grid(), scene.picture.size);
    double worst = 0.0;
    for (int y = 0; y < scene.picture.size.y; ++y)
        for (int x = 0; x < scene.picture.size.x; ++x) {
            const PixelRay ray = pixelRay(scene, volume->grid(), x, y);
            const glm::dvec3 p = transformPoint(indexFromPatient(volume->grid()),
                                                ray.originMm + frame.targetDistanceMm * ray.direction);
            const double shown = std::clamp(field.value(field.cellOf(p), p), 0.0, 1.0);
            worst = std::max(worst, std::abs(static_cast<double>(image.at(x, y).r) - shown));
        }
    return worst;
}

/// The convolution sum on random voxels in [0, 1]: positions are good to some 1e-6 of a voxel at slopes of a
/// few a voxel, and weights are float. With weights from the table each axis adds up to 1.6e-5.
TEST_F(FilterVariants, SlicesAreTheConvolutionSum) {
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({12, 12, 12}), 5);
    for (const auto& filter : enumNames<Filter>()) {
        if (filter.value == Filter::Nearest) continue;  // Projection.SlicesShowStoredValuesBitForBit
        const Scene scene = sliceScene(volume->grid(), kOblique, 8.0, filter.value, {64, 64});
        const bool table = filter.value == Filter::TricubicBSplineLut;
        EXPECT_LE(sliceError(scene, volume, draw(scene, volume)), (table ? 6e-5 : 1e-5) + filterError())
            << filter.name;
    }
}

/// Recursion and table draw the field of the direct evaluation.
TEST_F(FilterVariants, DrawTheSameFieldAnotherWay) {
    struct Pair {
        Filter direct, other;
        double bound;
    };
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({12, 12, 12}), 6);
    for (const Pair& pair : {Pair{Filter::TricubicBSpline, Filter::TricubicBSplineDeBoor, 2e-6},
                             Pair{Filter::TricubicBSpline, Filter::TricubicBSplineLut, 3.0 * 1.6e-5 + 2e-6},
                             Pair{Filter::Trilinear, Filter::TrilinearExact, 2e-6}}) {
        Scene scene = sliceScene(volume->grid(), kOblique, 8.0, pair.direct, {64, 64});
        const ImageF direct = draw(scene, volume);
        scene.volumes.front().filter = pair.other;
        EXPECT_LE(largestDifference(direct, draw(scene, volume)), pair.bound + filterError())
            << name(pair.other);
    }
}

/// Along one axis alone, over alternating voxels: the bound of linear interpolation is reached in the entries
/// next to a voxel.
TEST_F(FilterVariants, TheWeightTableIsWithinItsBound) {
    const VolumePtr volume = accuracy::sampledVolume(axisAlignedGrid({24, 1, 1}), VoxelType::Float32,
                                                     [](glm::ivec3 i) { return i.x % 2; });
    Scene scene = sliceScene(volume->grid(), {0.0, 1.0, 0.0}, 0.1, Filter::TricubicBSpline, {4096, 80});
    const ImageF direct = draw(scene, volume);
    scene.volumes.front().filter = Filter::TricubicBSplineLut;
    const double found = largestDifference(direct, draw(scene, volume));
    EXPECT_LE(found, 1.6e-5 + 1e-6 + filterError());
    EXPECT_GT(found, 1.2e-5);
}

/// A ramp between two voxels magnified 2000 times: a texture unit's 8-bit weights show at most 256 values
/// there, float interpolation one a pixel.
TEST_F(FilterVariants, ExactTrilinearHasNoStepsWhenMagnified) {
    const Grid grid = axisAlignedGrid({2, 1, 1});
    const VolumePtr volume = accuracy::sampledVolume(
        grid, VoxelType::UInt8, [](glm::ivec3 i) { return 255.0 * i.x; }, {1.0 / 255.0, 0.0, ""});
    const Scene scene = sliceScene(grid, {0.0, 1.0, 0.0}, 1.0 / 1000.0, Filter::TrilinearExact, {1000, 1});
    const ImageF image = draw(scene, volume);
    EXPECT_LE(sliceError(scene, volume, image), 1e-6);
    std::set<float> values;
    for (const glm::vec4& pixel : image.pixels) values.insert(pixel.r);
    EXPECT_GE(values.size(), 990u);
    RecordProperty("values", static_cast<int>(values.size()));
}

/// Errors on the signal of Marschner and Lobb rank nearest > linear > cubic > windowed sinc.
TEST(FilterRanking, SharperKernelsReconstructBetter) {
    const int n = 40;
    const VolumePtr volume = accuracy::marschnerLobb(n);
    const auto signal = [](glm::dvec3 p) {
        const double ring =
            std::cos(2.0 * std::numbers::pi * 6.0 * std::cos(std::numbers::pi / 2.0 * std::hypot(p.x, p.y)));
        return (1.0 - std::sin(std::numbers::pi * p.z / 2.0) + 0.25 * (1.0 + ring)) / (2.0 * 1.25);
    };
    double before = 1.0;
    for (const Filter filter : {Filter::Nearest, Filter::Trilinear, Filter::CatmullRom, Filter::Lanczos3}) {
        const accuracy::Field field(*volume, 0, filter);
        double sum = 0.0;
        int count = 0;
        for (double z = 8.1; z < n - 9; z += 2.37)
            for (double y = 8.2; y < n - 9; y += 1.31)
                for (double x = 8.3; x < n - 9; x += 0.73, ++count) {
                    const glm::dvec3 index(x, y, z);
                    const double error =
                        field.value(field.cellOf(index), index) - signal(2.0 * index / (n - 1.0) - 1.0);
                    sum += error * error;
                }
        const double rmse = std::sqrt(sum / count);
        EXPECT_LT(rmse, 0.9 * before) << name(filter) << ' ' << rmse << " after " << before;
        before = rmse;
    }
}

}  // namespace
}  // namespace pellucid::test
