// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Step, early termination, lights, and what a frame says of its own error.
#include <gtest/gtest.h>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "accuracy/synthetic.h"
#include "scene/image.h"
#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class Sampling : public GpuTest {};

VolumePtr smoothVolume() {
    return accuracy::sampledVolume(axisAlignedGrid({32, 32, 32}), VoxelType::Float32, [](glm::ivec3 i) {
        const glm::dvec3 d = glm::dvec3(i) - 15.5;
        return std::exp(-glm::dot(d, d) / 72.0);
    });
}

/// Opacity correction: a smooth field sampled from 0.25 to 2 voxels a step keeps its opacity within a grey
/// level.
TEST_F(Sampling, OpacityIsUnchangedWhenTheStepGrowsEightfold) {
    const VolumePtr volume = smoothVolume();
    Scene scene =
        sceneOf(linearExtinction(kOrange, 0.3), perspectiveAlong(volume->grid(), kOblique, 3.5), {32, 32});
    scene.quality.stepVoxels = 0.25;
    const ImageF fine = draw(scene, volume);
    scene.quality.stepVoxels = 2.0;
    const ImageF coarse = draw(scene, volume);
    EXPECT_LT(largestDifference(fine, coarse), 1.0 / 255.0);
}

/// B1.4k, B1.4l: in a homogeneous object 0.25 to 4 times the step change neither opacity nor colour.
TEST_F(Sampling, HomogeneousObjectsDoNotDependOnTheStep) {
    const Grid grid = axisAlignedGrid({9, 7, 5}, {0.7, 1.0, 1.9});
    const VolumePtr volume = constantVolume(grid, 0.5);
    for (const double extinction : {0.05, 2.3}) {
        Scene scene =
            sceneOf(constantFunction(kOrange, extinction), orthographicAlong(grid, kOblique, 14.0), {16, 16});
        scene.quality.stepVoxels = 1.0;
        const ImageF expected = draw(scene, volume);
        for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
            scene.quality.stepVoxels = factor;
            EXPECT_LE(largestDifference(draw(scene, volume), expected), 1e-5) << factor;
        }
    }
}

/// A step 100 times smaller is 100 times as many samples, all of them taken: the far end still counts.
TEST_F(Sampling, FineStepsAreNeverCutShort) {
    const Grid grid = axisAlignedGrid({40, 40, 40});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0);
    // Only the last two voxels are filled.
    const TransferFunction1D function{"", "", {{37.4, kOrange, 0.0}, {37.5, kOrange, 0.4}}};
    Scene scene = sceneOf(function, perspectiveAlong(grid, kOblique, 3.0), {12, 12});
    scene.quality.stepVoxels = 0.1;
    const ImageF coarse = draw(scene, volume);
    scene.quality.stepVoxels = 0.001;
    const renderer::Frame fine = frameOf(scene, volume);
    EXPECT_GT(fine.plan.samplesPerRay, 60000.0);
    // The ramp's front is smeared over up to a coarse step of extinction 0.4; float sums of 7e4 samples add
    // 2e-3.
    EXPECT_LE(largestDifference(coarse, fine.image), 0.4 * 0.1 + 2e-3);
    EXPECT_GT(static_cast<double>(fine.image.at(6, 6).a), 0.4);
}

/// The finest step in mm that the plan allows on this device, or where it allows more that of 65535 samples,
/// lit ones of which there are several turns 16383.
double finestStepMm(const Scene& scene, const Volume& volume, const renderer::DeviceLimits& limits) {
    const bool lit = scene.lights && !scene.lights->empty();
    double refused = 2.0 * radiusMm(volume.grid()) / (lit ? 16384.0 : 65536.0);
    double accepted = 1.0;
    while (accepted > 1.002 * refused) {
        Scene tried = scene;
        tried.quality.stepMm = std::sqrt(refused * accepted);
        (renderer::makePlan(tried, {renderer::factsOf(volume, 0)}, limits) ? accepted : refused) =
            *tried.quality.stepMm;
    }
    return accepted;
}

/// A driver may end all loops of a pixel after some ten thousand turns (DeviceLimits::maxLoopTurns). Whatever
/// the plan allows must be drawn to its end, so it must count the loops inside filters and over lights.
TEST_F(Sampling, TheFinestStepAllowedIsDrawnToItsEnd) {
    const VolumePtr volume = constantVolume(axisAlignedGrid({1, 8, 1}), 0.5);
    const auto check = [&](Scene scene, const std::string& what) {
        scene.camera.pose->heightMm = 0.5;
        scene.quality.stepMm = finestStepMm(scene, *volume, gpu().limits());
        const renderer::Frame frame = frameOf(scene, volume);
        RecordProperty(what, static_cast<int>(frame.plan.samplesPerRay));
        // 65535 sums of a depth up to 0.8: half an ulp of it each, at worst.
        EXPECT_NEAR(static_cast<double>(frame.image.at(0, 0).a), -std::expm1(-0.8), 65535 * kFloatUlp / 2.0)
            << what << ", samples " << frame.plan.samplesPerRay;
    };
    const Scene plain = rayScene(constantFunction({1.0, 0.5, 0.25}, 0.1), volume->grid(), {0.0, 1.0, 0.0});
    for (const auto& filter : enumNames<Filter>()) {
        Scene scene = plain;
        scene.volumes.front().filter = filter.value;
        check(scene, filter.name);
        scene.lights = std::vector<Light>{Light{}};
        check(scene, filter.name + std::string(" lit"));
    }
    for (const auto& integrator : enumNames<Integrator>()) {
        if (integrator.value == Integrator::Adaptive) continue;
        Scene scene = plain;
        scene.quality.integrator = integrator.value;
        check(scene, integrator.name);
    }
    for (const std::size_t count : {2u, 8u, 9u, 31u, 64u, 256u}) {
        Scene scene = plain;
        scene.lights = std::vector<Light>(count, Light{});
        check(scene, std::to_string(count) + " lights");
        scene.quality.integrator = Integrator::Trapezoid;
        check(scene, std::to_string(count) + " lights, trapezoid");
    }
    // A surface in the last part of the ray.
    const VolumePtr ramp = rampVolume(volume->grid(), 0.0, 1.0 / 7.0);
    for (const Mode mode : {Mode::Isosurface, Mode::FirstHit}) {
        Scene scene = plain;
        scene.mode = mode;
        scene.volumes.front().transferFunction =
            TransferFunction1D{"", "", {{0.99, kOrange, 0.0}, {0.99, kOrange, 1.0}}};
        scene.volumes.front().isovalue = 0.99;
        scene.lights = std::vector<Light>(64, Light{});
        scene.camera.pose->heightMm = 0.5;
        scene.quality.stepMm = finestStepMm(scene, *ramp, gpu().limits());
        EXPECT_EQ(drawRay(scene, ramp).a, 1.0) << name(mode);
    }
}

/// Where some rays find lit samples at once and others look for them, a driver that draws them together
/// counts the turns of them all. Steps so short draw rays in slabs on such a driver; cut short, twelve pixels
/// of this picture are 1 to 5 grey levels wrong. Left over are the step's errors, 0.07 grey levels, and the
/// reference's bound of 0.03.
TEST_F(Sampling, LitRaysThatWaitForEachOtherAreDrawnToTheirEnd) {
    const VolumePtr volume = accuracy::marschnerLobb(64);
    Scene scene;
    scene.lights = std::vector<Light>{Light{}};
    scene = completed(scene, {volume});
    scene.camera.view = AnatomicalView::Anterior;
    scene.picture.size = {40, 40};
    scene.quality.earlyTermination = 0.0;
    scene.quality.gradients = Gradients::OnTheFly;
    const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 5, {}});
    ASSERT_TRUE(reference) << reference.error().text();
    scene.quality.stepVoxels = 1.0 / 160.0;
    const renderer::Frame frame = frameOf(scene, volume);
    EXPECT_EQ(frame.plan.slabs > 1, gpu().limits().maxLoopTurns < 1e8);
    EXPECT_LE(255.0 * accuracy::difference(frame.image, reference->image).value().maxError, 0.25);
}

TEST_F(Sampling, EarlyTerminationStaysWithinItsBound) {
    const Grid grid = axisAlignedGrid({24, 24, 24});
    const VolumePtr volume = accuracy::randomVolume(grid, 8);
    for (const double bound : {1.0 / 1024.0, 1.0 / 255.0, 0.1, 0.5}) {
        Scene scene = sceneOf(colourfulFunction(8.0), perspectiveAlong(grid, kOblique, 3.5), {32, 32});
        scene.picture.background = {1.0, 1.0, 1.0};
        const ImageF whole = draw(scene, volume);
        scene.quality.earlyTermination = bound;
        const renderer::Frame stopped = frameOf(scene, volume);
        EXPECT_LE(stopped.plan.earlyTerminationBound, bound);
        const double error = largestDifference(stopped.image, whole);
        EXPECT_LE(error, bound + 1e-6);
        EXPECT_LE(error, stopped.plan.earlyTerminationBound + 1e-6);
        if (bound >= 0.1) {
            EXPECT_GT(error, 0.0);
        }  // It does stop.
    }
}

/// B1.2a: light adds up. With ambient light counted once: I(A+B) - I(A) - I(B) + I(none) = 0, in radiance.
/// I(none) is the picture under a light of intensity 0.
TEST_F(Sampling, LightsAddUp) {
    const Grid grid = axisAlignedGrid({16, 16, 16});
    const VolumePtr volume = accuracy::randomVolume(grid, 12);
    Light a;
    a.color = {1.0, 0.6, 0.3};
    Light b;
    b.kind = LightKind::Directional;
    b.directionMm = {1.0, 0.3, -0.4};
    b.intensity = 0.7;
    Light c;
    c.kind = LightKind::Point;
    c.positionMm = {30.0, -20.0, 40.0};
    Light off = a;
    off.intensity = 0.0;
    for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear}) {
        Scene scene = sceneOf(colourfulFunction(4.0), perspectiveAlong(grid, kOblique, 3.5), {24, 24});
        scene.space = space;
        const auto radiance = [&](const std::vector<Light>& lights) {
            scene.lights = lights;
            ImageF image = draw(scene, volume);
            if (space == CompositingSpace::Linear)
                for (glm::vec4& p : image.pixels)
                    for (int channel = 0; channel < 3; ++channel)
                        p[channel] = static_cast<float>(linearFromDisplay(static_cast<double>(p[channel])));
            return image;
        };
        const ImageF none = radiance({off});
        const ImageF all = radiance({a, b, c});
        const ImageF onlyA = radiance({a});
        const ImageF onlyB = radiance({b});
        const ImageF onlyC = radiance({c});
        double worst = 0.0;
        for (std::size_t i = 0; i < all.pixels.size(); ++i)
            for (int channel = 0; channel < 3; ++channel) {
                const auto at = [&](const ImageF& image) {
                    return static_cast<double>(image.pixels[i][channel]);
                };
                const double missing = at(all) - at(onlyA) - at(onlyB) - at(onlyC) + 2.0 * at(none);
                worst = std::max(worst, std::abs(missing) / std::max(at(all), 0.1));
            }
        EXPECT_LE(worst, 1e-5);
    }
}

/// A frame's own estimate against the truth: at least half the largest error, over steps from fine to much
/// too coarse.
TEST_F(Sampling, ErrorEstimatesAreHonest) {
    const VolumePtr smooth = smoothVolume();
    const VolumePtr random = accuracy::randomVolume(axisAlignedGrid({16, 16, 16}), 8);
    const VolumePtr signal = accuracy::marschnerLobb(40);
    renderer::RenderOptions options;
    options.estimateError = true;
    for (const VolumePtr& volume : {smooth, random, signal}) {
        for (const Mode mode : {Mode::Composite, Mode::Average, Mode::XRay, Mode::Emission}) {
            for (const bool lit : {false, true}) {
                if (lit && mode != Mode::Composite) continue;
                for (const double step : {0.25, 1.0, 4.0}) {
                    Scene scene = sceneOf(colourfulFunction(2.0 / smallestSpacingMm(volume->grid())),
                                          perspectiveAlong(volume->grid(), kOblique, 3.5), {32, 32});
                    scene.mode = mode;
                    if (lit) scene.lights = std::vector<Light>{Light{}};
                    scene.quality.stepVoxels = step;
                    const renderer::Frame frame = frameOf(scene, volume, options);
                    ASSERT_TRUE(frame.error.has_value());
                    const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 4, {}});
                    ASSERT_TRUE(reference) << reference.error().text();
                    const auto truth = accuracy::difference(frame.image, reference->image);
                    ASSERT_TRUE(truth);
                    const double estimate =
                        frame.error->maxError + frame.error->terminationBound + frame.error->tableBound;
                    EXPECT_GE(estimate, 0.5 * truth->maxError - 1e-5)
                        << name(mode) << " lit " << lit << " step " << step << " rmse " << truth->rmse
                        << " estimated " << frame.error->rmse;
                    EXPECT_GT(frame.error->probedPixels, 0);
                    EXPECT_FALSE(frame.error->method.empty());
                }
            }
        }
    }
}

}  // namespace
}  // namespace pellucid::test
