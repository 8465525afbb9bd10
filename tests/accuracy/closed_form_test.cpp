// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The renderer against formulas. Tolerances: n samples added in float lose at most n half-ulps of their sum;
// what the midpoint rule adds is derived at each test.
#include <gtest/gtest.h>

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);
constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class ClosedForm : public GpuTest {};

/// n additions, the look-up (two products, one sum, a quotient) and the final blend.
double accumulated(double samples) {
    return (samples + 8.0) * kFloatUlp;
}

/// I = c (1 - T) + background T, whatever the medium, the step, the filter and the projection (Max 1995).
TEST_F(ClosedForm, ConstantColourInAnyMedium) {
    const Grid grid = axisAlignedGrid({7, 6, 5}, {1.0, 0.8, 1.7});
    const VolumePtr volume = accuracy::randomVolume(grid, 7);
    const glm::dvec3 background(0.1, 0.9, 0.3);
    for (const Filter filter : allFilters()) {
        for (const bool perspective : {false, true}) {
            for (const double extinction : {1e-6, 0.3, 20.0, 1e5}) {
                for (const double step : {0.05, 0.5, 4.0}) {
                    Scene scene = sceneOf(linearExtinction(kOrange, extinction),
                                          perspective ? perspectiveAlong(grid, kOblique, 3.5)
                                                      : orthographicAlong(grid, kOblique, 12.0),
                                          {12, 10});
                    scene.volumes.front().filter = filter;
                    scene.picture.background = background;
                    scene.quality.stepVoxels = step;
                    const renderer::Frame frame = frameOf(scene, volume);
                    double worst = 0.0;
                    for (const glm::vec4& p : frame.image.pixels)
                        for (int channel = 0; channel < 3; ++channel) {
                            const auto alpha = static_cast<double>(p.a);
                            const double expected =
                                kOrange[channel] * alpha + (1.0 - alpha) * background[channel];
                            worst = std::max(worst, std::abs(static_cast<double>(p[channel]) - expected));
                        }
                    EXPECT_LE(worst, accumulated(frame.plan.samplesPerRay))
                        << name(filter) << " extinction " << extinction << " step " << step;
                }
            }
        }
    }
}

/// alpha = 1 - exp(-k d) over the exact chord of every ray, seen obliquely, in both projections: entry, exit,
/// the shortened last segment and the step in mm are right, or this fails. tau carries n half-ulps relative,
/// and tau exp(-tau) <= 0.37; the chord's ends are good to 4 ulps of coordinates up to the box's size.
TEST_F(ClosedForm, HomogeneousBoxHasBeersOpacity) {
    const Grid grid = axisAlignedGrid({9, 7, 5}, {0.7, 1.0, 1.9}, {120.0, -300.0, 50.0});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double extinction : {1e-4, 0.05, 0.4, 8.0}) {
        for (const double step : {0.01, 0.33, 1.0, 50.0}) {
            for (const bool perspective : {false, true}) {
                Scene scene = sceneOf(constantFunction(kOrange, extinction),
                                      perspective ? perspectiveAlong(grid, kOblique, 3.5)
                                                  : orthographicAlong(grid, kOblique, 14.0),
                                      {14, 11});
                scene.quality.stepVoxels = step;
                const renderer::Frame frame = frameOf(scene, volume);
                const double box = 2.0 * radiusMm(grid);
                const double tolerance = 0.37 * accumulated(frame.plan.samplesPerRay) +
                                         extinction * box * 16.0 * kFloatUlp + 8.0 * kFloatUlp;
                double worst = 0.0;
                for (int y = 0; y < 11; ++y)
                    for (int x = 0; x < 14; ++x) {
                        const PixelRay ray = pixelRay(scene, grid, x, y);
                        const double chord = chordMm(grid, ray.originMm, ray.direction, ray.startMm);
                        worst = std::max(worst, std::abs(static_cast<double>(frame.image.at(x, y).a) +
                                                         std::expm1(-extinction * chord)));
                    }
                EXPECT_LE(worst, tolerance)
                    << extinction << " step " << step << " perspective " << perspective;
                EXPECT_LE(worst, 1e-5);
            }
        }
    }
}

/// tau = a L + b L^2 / 2. The midpoint rule is exact where the extinction is linear; at the two bends (the
/// outer voxel centres) it errs by at most b h^2 / 8 each.
TEST_F(ClosedForm, LinearExtinctionGivesTheQuadraticDepth) {
    const int n = 12;
    const Grid grid = axisAlignedGrid({3, n, 3});
    const VolumePtr volume = rampVolume(grid, 0.125, 0.0625);
    const double length = n - 1;
    const double last = 0.125 + 0.0625 * length;
    const double slope = 0.2 * 0.0625;
    const double depth = 0.2 * (0.125 * length + 0.0625 * length * length / 2.0 + 0.5 * 0.125 + 0.5 * last);
    for (const double step : {0.05, 0.21, 0.5}) {
        Scene scene = rayScene(linearExtinction(kOrange, 0.2), grid, kAlongY);
        scene.quality.stepMm = step;
        EXPECT_NEAR(drawRay(scene, volume).a, -std::expm1(-depth),
                    std::exp(-depth) * (2.0 * slope * step * step / 8.0) + accumulated(n / step) +
                        0.2 * n * filterError());
    }
}

/// With the border of the slabs on a border of segments the picture is exact; elsewhere one segment straddles
/// it and takes up to half a step of the wrong slab.
TEST_F(ClosedForm, TwoSlabsKeepTheirOrder) {
    const Grid grid = axisAlignedGrid({1, 2, 1}, {1, 3, 1});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0);
    const TransferFunction1D function{"", "", {{0.0, {1, 0, 0}, 0.2}, {1.0, {0, 0, 1}, 0.5}}};
    const double t1 = std::exp(-0.6);
    const double t2 = std::exp(-1.5);
    for (const double step : {0.25, 0.37}) {
        Scene scene = rayScene(function, grid, kAlongY);
        scene.volumes.front().filter = Filter::Nearest;
        scene.quality.stepMm = step;
        const double tolerance = step == 0.25 ? accumulated(24) : 0.5 * step * 0.5;
        const glm::dvec4 front = drawRay(scene, volume);
        EXPECT_NEAR(front.r, 1 - t1, tolerance);
        EXPECT_NEAR(front.b, t1 * (1 - t2), tolerance);
        EXPECT_NEAR(front.a, 1 - t1 * t2, tolerance);
        scene.camera = orthographicAlong(grid, -kAlongY, 1.0);
        const glm::dvec4 back = drawRay(scene, volume);
        EXPECT_NEAR(back.r, t2 * (1 - t1), tolerance);
        EXPECT_NEAR(back.b, 1 - t2, tolerance);
    }
}

/// alpha(b) = 1 - exp(-2 k sqrt(R^2 - b^2)). Catmull-Rom reproduces r^2 exactly, and a step of the transfer
/// function cuts the ball out. The table smears the step over one entry, so R^2 is known to +- one entry;
/// each end of the chord falls within half a step.
TEST_F(ClosedForm, BallOfConstantExtinction) {
    const double radius = 12.0;
    const int n = 33;
    const Grid grid = axisAlignedGrid({n, n, n});
    const VolumePtr volume = accuracy::sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) {
        const glm::dvec3 d = glm::dvec3(i) - 16.0;
        return glm::dot(d, d);
    });
    const double extinction = 2.0 / radius;
    const TransferFunction1D function{"",
                                      "",
                                      {{0.0, kOrange, extinction},
                                       {radius * radius, kOrange, extinction},
                                       {radius * radius, kOrange, 0.0},
                                       {300.0, kOrange, 0.0}}};
    for (const double part : {50.0, 500.0}) {
        Scene scene = sceneOf(function, orthographicAlong(grid, kOblique, 2.2 * radius), {31, 31});
        scene.volumes.front().filter = Filter::CatmullRom;
        scene.quality.stepMm = radius / part;
        const renderer::Frame frame = frameOf(scene, volume);
        const double entry = 300.0 / (frame.plan.table.size - 1) + filterError() * 768.0;
        for (int y = 0; y < 31; ++y)
            for (int x = 0; x < 31; ++x) {
                const double b2 =
                    1.21 * radius * radius * (std::pow(pictureU(x, 31), 2) + std::pow(pictureV(y, 31), 2));
                const auto alpha = [&](double r2, double more) {
                    const double half = std::sqrt(std::max(0.0, r2 - b2));
                    return -std::expm1(-extinction * std::max(0.0, 2.0 * half + more));
                };
                const double r2 = radius * radius;
                const double step = *scene.quality.stepMm;
                EXPECT_GE(static_cast<double>(frame.image.at(x, y).a), alpha(r2 - entry, -step) - 1e-5);
                EXPECT_LE(static_cast<double>(frame.image.at(x, y).a),
                          alpha(r2 + entry, b2 < r2 + entry ? step : 0.0) + 1e-5);
            }
    }
}

/// B1.4g: 10000 samples of opacity 0.001 reach 1 - 0.999^10000; eight bits would stop at 0.5. Nothing may add
/// up: see accumulated(), with tau exp(-tau) at tau = 10.
TEST_F(ClosedForm, TenThousandFaintSamplesAddUp) {
    const Grid grid = axisAlignedGrid({2, 10, 2});
    Scene scene = rayScene(constantFunction(kOrange, -std::log(0.999) * 1000.0), grid, kAlongY);
    scene.quality.stepMm = 0.001;
    const glm::dvec4 pixel = drawRay(scene, constantVolume(grid, 0.5));
    EXPECT_NEAR(pixel.a, 1.0 - std::pow(0.999, 10000.0), 1e-5);
    EXPECT_NEAR(pixel.g, 0.5 * pixel.a, 1e-5);
}

/// From nearly nothing to far beyond what float can tell from opaque, per step; unlit, lit, in both spaces.
TEST_F(ClosedForm, OpticalDepthPerStepFromTinyToHugeStaysFinite) {
    const Grid grid = axisAlignedGrid({4, 8, 4});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double depthPerStep : {0.0, 1e-30, 1e-8, 1e-4, 1.0, 1e2, 1e4, 1e8}) {
        for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear}) {
            Scene scene = sceneOf(constantFunction({1, 1, 1}, depthPerStep),
                                  orthographicAlong(grid, kAlongY, 4.0), {4, 4});
            scene.quality.stepMm = 1.0;
            scene.space = space;
            scene.lights = std::vector<Light>{Light{}};
            const ImageF image = draw(scene, volume);
            const double expected = -std::expm1(-8.0 * depthPerStep);
            // 1 - T in float: absolute, so faint media keep 6e-8 and no more.
            EXPECT_NEAR(static_cast<double>(image.at(1, 1).a), expected, 3e-7) << depthPerStep;
            if (depthPerStep >= 1e2) {
                EXPECT_NEAR(static_cast<double>(image.at(1, 1).r), 1.0, 1e-6);
            }
        }
    }
}

TEST_F(ClosedForm, OneVoxelVolumeIsABox) {
    const Grid grid = axisAlignedGrid({1, 1, 1}, {2.0, 3.0, 5.0});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const Filter filter : allFilters()) {
        Scene scene = rayScene(constantFunction(kOrange, 0.3), grid, kAlongY);
        scene.volumes.front().filter = filter;
        EXPECT_NEAR(drawRay(scene, volume).a, -std::expm1(-0.9), 1e-6) << name(filter);
        scene.lights = std::vector<Light>{Light{}};  // No gradient anywhere: the unlit colour.
        EXPECT_NEAR(drawRay(scene, volume).g, 0.5 * -std::expm1(-0.9), 1e-6) << name(filter);
    }
}

TEST_F(ClosedForm, EmissionAddsItsPathToTheBackground) {
    const Grid grid = axisAlignedGrid({2, 5, 2});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double step : {0.1, 0.37, 9.0}) {
        for (const double q : {1e-4, 0.3, 400.0}) {
            Scene scene = rayScene(constantFunction({1.0, 0.5, 0.25}, q), grid, kAlongY);
            scene.picture.background = {0.2, 0.2, 0.2};
            scene.mode = Mode::Emission;
            scene.quality.stepMm = step;
            const glm::dvec4 pixel = drawRay(scene, volume);
            // Float targets: 400 * 5 = 2000 comes out as it is, not clamped.
            const double tolerance = (0.2 + 5.0 * q) * accumulated(5.0 / step);
            EXPECT_NEAR(pixel.r, 0.2 + 5.0 * q, tolerance);
            EXPECT_NEAR(pixel.g, 0.2 + 2.5 * q, tolerance);
            EXPECT_NEAR(pixel.b, 0.2 + 1.25 * q, tolerance);
            EXPECT_EQ(pixel.a, 0.0);
        }
    }
}

/// B1.2e: emission-absorption tends to I0 + q L as the medium thins and to the source colour as it thickens.
TEST_F(ClosedForm, EmissionAbsorptionReachesItsLimits) {
    const Grid grid = axisAlignedGrid({2, 5, 2});
    const VolumePtr volume = constantVolume(grid, 0.5);
    Scene scene = rayScene(constantFunction(kOrange, 1e-4), grid, kAlongY);
    scene.picture.background = {0.25, 0.25, 0.25};
    const glm::dvec4 thin = drawRay(scene, volume);
    for (int channel = 0; channel < 3; ++channel)  // x - x^2/2 ... on both terms.
        EXPECT_NEAR(thin[channel], 0.25 + 5e-4 * (kOrange[channel] - 0.25),
                    5e-4 * 5e-4 / 2.0 + accumulated(20));
    scene.volumes.front().transferFunction = constantFunction(kOrange, 1e6);
    const glm::dvec4 dense = drawRay(scene, volume);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(dense[channel], kOrange[channel], accumulated(20));
    EXPECT_EQ(dense.a, 1.0);
}

/// Density k times, geometry 1/k: the same optical depths; the source colour does not depend on the density.
TEST_F(ClosedForm, DensityScalesLikeLength) {
    const Grid grid = axisAlignedGrid({16, 16, 16});
    const Grid small = axisAlignedGrid({16, 16, 16}, {0.25, 0.25, 0.25});
    Scene scene = sceneOf(colourfulFunction(), orthographicAlong(grid, kOblique, 20.0), {16, 16});
    Scene dense = sceneOf(colourfulFunction(), orthographicAlong(small, kOblique, 5.0), {16, 16});
    dense.densityScale = 4.0;
    // Powers of two: the same sample positions in the texture, up to the rounding of the ray.
    EXPECT_LE(largestDifference(draw(scene, accuracy::randomVolume(grid, 5)),
                                draw(dense, accuracy::randomVolume(small, 5))),
              1e-4);
    const VolumePtr constant = constantVolume(grid, 0.5);
    Scene even = rayScene(constantFunction(kOrange, 0.02), grid, kAlongY);
    for (const double density : {0.1, 1.0, 30.0}) {
        even.densityScale = density;
        const glm::dvec4 pixel = drawRay(even, constant);
        EXPECT_NEAR(pixel.a, -std::expm1(-0.32 * density), 1e-6);
        EXPECT_NEAR(pixel.g / pixel.a, 0.5, 1e-4);
    }
}

/// B1.4n: 50 % black over white is half the light, shown as sRGB 188; blended as shown it is 128 (127.5).
TEST_F(ClosedForm, HalfBlackOverWhiteIs188InLinearSpace) {
    const Grid grid = axisAlignedGrid({2, 4, 2});
    const VolumePtr volume = constantVolume(grid, 0.5);
    Scene scene = rayScene(constantFunction({0, 0, 0}, std::log(2.0) / 4.0), grid, kAlongY);
    scene.picture.background = {1, 1, 1};
    scene.space = CompositingSpace::Linear;
    ImageF image = draw(scene, volume);
    EXPECT_NEAR(static_cast<double>(image.at(0, 0).r), 1.055 * std::pow(0.5, 1.0 / 2.4) - 0.055, 1e-6);
    EXPECT_EQ(static_cast<int>(quantise(image, false, false).bytes.front()), 188);
    scene.space = CompositingSpace::Display;
    EXPECT_NEAR(drawRay(scene, volume).r, 0.5, 1e-6);
}

/// Voxel colours of a slice of one voxel depth (nearest filter): classified values, as a pre-classified
/// volume would have.
TEST_F(ClosedForm, ClassificationAtVoxelCentresIsTheFunctionItself) {
    const Grid grid = axisAlignedGrid({8, 1, 8});
    const VolumePtr volume =
        accuracy::sampledVolume(grid, VoxelType::UInt8, [](glm::ivec3 i) { return i.x + 8 * i.z; });
    TransferFunction1D function{
        "", "", {{3.0, {0.1, 0.2, 0.9}, 0.1}, {20.0, {0.2, 0.9, 0.3}, 2.0}, {41.0, {1.0, 0.5, 0.0}, 0.4}}};
    Scene scene = sceneOf(function, orthographicAlong(grid, kAlongY, 8.0), {8, 8});
    scene.volumes.front().filter = Filter::Nearest;
    const ImageF image = draw(scene, volume);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const OpticalSample expected = evaluate(function, x + 8 * (7 - y));
            const double alpha = -std::expm1(-expected.extinction);
            EXPECT_NEAR(static_cast<double>(image.at(x, y).a), alpha, 1e-6);
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(static_cast<double>(image.at(x, y)[channel]), alpha * expected.color[channel],
                            1e-6);
        }
}

/// V1 (c): opacity 0.5 per unit over 2 units is 0.75; 0.95 over half a unit is 0.776393.
TEST_F(ClosedForm, OpacityPerUnitLengthFollowsThePath) {
    const VolumePtr thick = constantVolume(axisAlignedGrid({1, 2, 1}), 0.5);
    Scene scene = rayScene(constantFunction(kOrange, extinctionFromOpacity(0.5)), thick->grid(), kAlongY);
    for (const int slabs : {1, 2, 4, 16, 256, 1024}) {
        scene.quality.stepMm = 2.0 / slabs;
        EXPECT_NEAR(drawRay(scene, thick).a, 0.75, 1e-5);
    }
    const VolumePtr thin = constantVolume(axisAlignedGrid({1, 1, 1}, {1, 0.5, 1}), 0.5);
    scene = rayScene(constantFunction(kOrange, extinctionFromOpacity(0.95)), thin->grid(), kAlongY);
    EXPECT_NEAR(drawRay(scene, thin).a, 0.776393, 1e-5);
}

}  // namespace
}  // namespace pellucid::test
