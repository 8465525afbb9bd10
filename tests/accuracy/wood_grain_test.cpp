// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The sampling rule along rays (Engel et al. 2006, section 9.1.1): two samples a voxel, and what fewer show.
#include <gtest/gtest.h>

#include <numbers>

#include "accuracy/field.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

using std::numbers::pi;

class WoodGrain : public GpuTest {};

/// The step of a scene that says nothing is half the smallest voxel spacing.
TEST(SamplingRule, TheDefaultStepIsHalfTheSmallestSpacing) {
    EXPECT_DOUBLE_EQ(stepMm(Quality{}, axisAlignedGrid({8, 8, 8}, {0.7, 0.9, 2.5})), 0.35);
    EXPECT_DOUBLE_EQ(stepMm(Quality{}, axisAlignedGrid({8, 8, 8}, {3.0, 2.0, 0.25})), 0.125);
}

constexpr double kRadius = 14.0;  // of the disc that is looked at, mm
constexpr double kSigma = 0.3;    // of the peak along a ray, voxels
constexpr double kDepth = 0.05;   // of the whole peak
constexpr double kPeakAt = 34.0;  // on the axis, voxels
constexpr double kRise = 24.0;    // of the peak's place from the axis to the disc's edge, voxels
constexpr double kVoxels = 64.0;  // along a ray over the value range

/// A paraboloid: linear along y, the direction of the rays, also between voxels. The peak of a ray lies where
/// its value is kPeakAt / kVoxels, and because area grows with r^2 as the peak's place does, all places
/// in kPeakAt - kRise ... kPeakAt are seen equally often: rings like those of wood.
VolumePtr paraboloid() {
    return accuracy::sampledVolume(axisAlignedGrid({32, 44, 32}), VoxelType::Float32, [](glm::ivec3 i) {
        const double x = i.x - 15.5, z = i.z - 15.5;
        return (i.y + kRise * (x * x + z * z) / (kRadius * kRadius)) / kVoxels;
    });
}

/// A Gaussian over the value, from control points an eighth of its deviation apart.
TransferFunction1D peak() {
    TransferFunction1D function;
    constexpr int kPoints = 40;
    for (int i = -kPoints; i <= kPoints; ++i) {
        const double x = i / 8.0;  // deviations
        const double tau = std::abs(i) == kPoints ? 0.0 : std::exp(-0.5 * x * x);
        function.points.push_back({(kPeakAt + x * kSigma) / kVoxels, glm::dvec3(1.0),
                                   tau * kDepth / (kSigma * std::sqrt(2.0 * pi))});
    }
    return function;
}

/// Spectrum of the extinction along a ray, at a frequency per voxel.
double spectrum(const TransferFunction1D& function, double frequency) {
    double sum = 0.0;
    constexpr double kFine = 1.0 / 4096.0;
    for (double y = -6.0 * kSigma; y < 6.0 * kSigma; y += kFine)
        sum += kFine * evaluate(function, (kPeakAt + y) / kVoxels).extinction *
               std::cos(2.0 * pi * frequency * y);
    return sum;
}

/// Mean square of the error over the disc: white fog on black, so exact is 1 - exp(-depth) everywhere.
double ringEnergy(const ImageF& image, const Scene& scene, const Volume& volume, double exact) {
    const accuracy::Field field(volume, 0, Filter::Trilinear);
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x) {
            const PixelRay ray = pixelRay(scene, volume.grid(), x, y);
            const glm::dvec3 index(ray.originMm.x, 0.0, ray.originMm.z);
            if (field.value(field.cellOf(index), index) * kVoxels > kRise) continue;
            const double error = static_cast<double>(image.at(x, y).r) - exact;
            sum += error * error;
            ++count;
        }
    return sum / count;
}

/// Midpoints a step h apart see a peak with the spectrum P as its integral plus sum_k 2 P(k / h) cos(2 pi k
/// phase) (Poisson's sum); over all phases its mean square is sum_k 2 P(k / h)^2, and the picture dims it by
/// exp(-2 depth). Phases are spread evenly but for the trilinear paraboloid, which lies up to 1/4 kRise /
/// kRadius^2 = 0.03 voxels beside the true one, and for pixels that alias with the outer rings: 15 %. The
/// transfer table adds at most its error over a voxel, about the peak's width, to the amplitude.
TEST_F(WoodGrain, RingsHaveTheirTheoreticalEnergyAndGoAtTwoSamplesAVoxel) {
    const VolumePtr volume = paraboloid();
    const TransferFunction1D function = peak();
    Scene scene = sceneOf(function, orthographicAlong(volume->grid(), {0.0, 1.0, 0.0}, 28.0), {160, 160});
    const double depth = spectrum(function, 0.0);
    double before = 1.0;
    double coarsest = 0.0;
    for (const double step : {2.0, 1.5, 1.0, 0.75, 0.5}) {
        scene.quality.stepVoxels = step;
        const renderer::Frame frame = frameOf(scene, volume);
        const ImageF& image = frame.image;
        double expected = 0.0;
        for (int k = 1; k <= 8; ++k) expected += 2.0 * std::pow(spectrum(function, k / step), 2.0);
        expected *= std::exp(-2.0 * depth);
        const double energy = ringEnergy(image, scene, *volume, -std::expm1(-depth));
        const double table = frame.plan.table.worstError;
        EXPECT_NEAR(energy, expected, 0.15 * expected + 2.0 * std::sqrt(expected) * table + table * table)
            << "step " << step;
        EXPECT_LT(energy, before) << "step " << step;
        before = energy;
        if (coarsest == 0.0) coarsest = energy;
    }
    EXPECT_GT(coarsest, 1e-5);           // rings of a grey level
    EXPECT_LT(10.0 * before, coarsest);  // the rule's promise; for this peak it is 4e5
}

}  // namespace
}  // namespace pellucid::test
