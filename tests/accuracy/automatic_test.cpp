// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes that state an error: it is met, and by the cheaper of the settings that meet it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "io/load.h"
#include "renderer/automatic_quality.h"
#include "scene/names.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

using renderer::TimedImage;

struct Asked {
    ErrorNorm norm;
    double greyLevels;
};

class Automatic : public GpuTest {
protected:
    static void expectMet(Scene scene, const VolumePtr& volume, const std::string& name,
                          const std::vector<Asked>& asked) {
        scene = completed(scene, {volume});
        scene.picture.size = {32, 32};
        scene.quality.automatic = true;
        const auto reference = accuracy::referencePicture(scene, {volume}, {1e-4, 5, {}});
        ASSERT_TRUE(reference) << reference.error().text();
        for (const Asked& tolerance : asked) {
            scene.quality.toleranceNorm = tolerance.norm;
            scene.quality.toleranceGreyLevels = tolerance.greyLevels;
            const renderer::Frame frame = frameOf(scene, volume);
            ASSERT_TRUE(frame.chosen && frame.error);
            const std::string what =
                fmt::format("{} {} {} {}: {} steps of {:.3g}", name, pellucid::name(scene.mode),
                            pellucid::name(tolerance.norm), tolerance.greyLevels,
                            pellucid::name(frame.chosen->integrator), frame.chosen->stepVoxels);
            EXPECT_TRUE(renderer::meetsTolerance(scene.quality, *frame.error)) << what;
            const auto truth = accuracy::difference(frame.image, reference->image).value();
            // The reference's own bound is 0.03 grey levels.
            EXPECT_LE(255.0 * (tolerance.norm == ErrorNorm::Max ? truth.maxError : truth.rmse),
                      tolerance.greyLevels + 0.03)
                << what;
        }
    }
};

TEST_F(Automatic, MeetsTheToleranceOnScansAndSyntheticFields) {
    const auto torso = io::loadVolume({PELLUCID_SOURCE_DIR "/resources/sample/ct-torso.nii.gz"});
    ASSERT_TRUE(torso) << torso.error().text();
    const auto head = io::loadVolume({PELLUCID_TEST_DATA "/ct-head-64"});
    ASSERT_TRUE(head) << head.error().text();
    const std::pair<const char*, VolumePtr> sources[] = {
        {"Marschner-Lobb", accuracy::marschnerLobb(32)}, {"torso", *torso}, {"head", *head}};
    for (const auto& [name, volume] : sources) {
        const std::vector<Asked> asked{{ErrorNorm::Rmse, 0.5}, {ErrorNorm::Rmse, 4.0}, {ErrorNorm::Max, 4.0}};
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip})
            expectMet(sceneIn(mode, false), volume, name, asked);
        // A silhouette is there or not, so the largest error of a surface is that of all or nothing.
        expectMet(sceneIn(Mode::Isosurface, false), volume, name, {{ErrorNorm::Rmse, 4.0}});
        // The largest error of a lit ray falls slowly, where gradients turn within a voxel: software OpenGL
        // draws such rays in several slabs.
        expectMet(sceneIn(Mode::Composite, true), volume, std::string(name) + " lit",
                  {{ErrorNorm::Rmse, 0.5}, {ErrorNorm::Rmse, 4.0}, {ErrorNorm::Max, 1.0}});
    }
}

/// A peak of the function a twentieth of a voxel wide is stepped over by long steps, all of which agree with
/// each other that there is nothing.
TEST_F(Automatic, IsNotFooledByWhatLongStepsDoNotSee) {
    const auto volume = accuracy::marschnerLobb(32);
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = TransferFunction1D{
        "peak", "", {{0.499, {1, 0.8, 0.6}, 0.0}, {0.5, {1, 0.8, 0.6}, 40.0}, {0.501, {1, 0.8, 0.6}, 0.0}}};
    scene.lights.emplace();
    expectMet(scene, volume, "thin peak", {{ErrorNorm::Rmse, 1.0}, {ErrorNorm::Rmse, 4.0}});
}

TEST_F(Automatic, ChoosesOnceForAllViews) {
    const auto volume = accuracy::marschnerLobb(32);
    Scene scene = completed(sceneIn(Mode::Composite, false), {volume});
    scene.picture.size = {64, 64};
    scene.quality.automatic = true;
    scene.quality.toleranceGreyLevels = 1.0;
    (void)frameOf(scene, volume);
    scene.camera.view = AnatomicalView::Superior;
    const int before = gpu().workCounts().frames;
    (void)frameOf(scene, volume);
    // The frame, the two of its estimate, and at most one refinement of the same three.
    EXPECT_LE(gpu().workCounts().frames - before, 6);
}

/// Pictures of one pixel whose error and time are known functions of the settings.
class ModelRenderer {
public:
    double exponentialError = 0.04;  ///< At a step of one voxel; order 2.
    double integralError = 0.04;     ///< As well.
    double integralCost = 3.0;       ///< Of a sample, in samples of the exponential rule.

    Result<TimedImage> operator()(const Scene& scene) const {
        const bool integral = scene.quality.integrator == Integrator::IntegralFunctions;
        const double step = scene.quality.stepVoxels;
        const double error = (integral ? integralError : exponentialError) * step * step;
        TimedImage drawn;
        drawn.image.size = {1, 1};
        drawn.image.pixels = {glm::vec4(static_cast<float>(0.5 + error))};
        drawn.ms = 1.0 + (integral ? integralCost : 1.0) * 100.0 / step;
        return drawn;
    }
};

Scene modelScene(double tolerance) {
    Scene scene;
    scene.quality.automatic = true;
    scene.quality.toleranceGreyLevels = 255.0 * tolerance;
    scene.picture.size = {1, 1};
    return scene;
}

/// The step that just meets the aim, 0.9 x 0.75 of the tolerance, follows from order and error: sqrt(0.675
/// tolerance / error). The truth compared with is itself off by up to a quarter of the tolerance (here less:
/// 1/16 of its change).
TEST(AutomaticChoice, TakesTheLongestStepThatMeetsTheAim) {
    const ModelRenderer model;
    for (const double tolerance : {0.1, 0.01, 0.001}) {
        const auto quality = renderer::chooseQuality(modelScene(tolerance), model);
        ASSERT_TRUE(quality);
        EXPECT_EQ(quality->integrator, Integrator::Exponential);
        const double expected = std::sqrt(0.675 * tolerance / model.exponentialError);
        EXPECT_NEAR(quality->stepVoxels / expected, 1.0, 0.15) << tolerance;
        EXPECT_FALSE(quality->automatic);
    }
}

TEST(AutomaticChoice, TakesTheCheaperIntegrator) {
    ModelRenderer model;
    // At equal error its steps are twice as long, and each costs three times as much, or one and a half.
    model.integralError = 0.01;
    EXPECT_EQ(renderer::chooseQuality(modelScene(0.005), model)->integrator, Integrator::Exponential);
    model.integralCost = 1.5;
    EXPECT_EQ(renderer::chooseQuality(modelScene(0.005), model)->integrator, Integrator::IntegralFunctions);
}

renderer::Attempt attempt(double stepVoxels, double greyLevels) {
    Quality tried;
    tried.toleranceGreyLevels = 1.0;
    tried.stepVoxels = stepVoxels;
    return {tried, greyLevels / 255.0};
}

TEST(AutomaticChoice, RefinementFollowsTheOrderSeenWithinBounds) {
    EXPECT_EQ(renderer::refined({attempt(1.0, 0.76)}).stepVoxels, 0.8);
    EXPECT_EQ(renderer::refined({attempt(1.0, 1000.0)}).stepVoxels, 1.0 / 16.0);
    EXPECT_NEAR(renderer::refined({attempt(1.0, 4.0)}).stepVoxels, 0.675 / 4.0, 1e-12);
    // Order 2: half the step, a quarter of the error.
    EXPECT_NEAR(renderer::refined({attempt(2.0, 16.0), attempt(1.0, 4.0)}).stepVoxels, std::sqrt(0.675 / 4.0),
                1e-12);
}

/// Rays are the first thing to add where the largest error counts: which pixels without one are how wrong is
/// not known, and no step makes them better. Two pictures of one step show no order.
TEST(AutomaticChoice, ALargestErrorIsFirstMetByARayAPixel) {
    renderer::Attempt sparse = attempt(1.0, 4.0);
    sparse.quality.interpolationGreyLevels = 0.2;
    EXPECT_LT(renderer::refined({sparse}).stepVoxels, 1.0);
    EXPECT_TRUE(renderer::refined({sparse}).interpolationGreyLevels);
    sparse.quality.toleranceNorm = ErrorNorm::Max;
    const Quality next = renderer::refined({sparse});
    EXPECT_EQ(next.stepVoxels, 1.0);
    EXPECT_FALSE(next.interpolationGreyLevels);
    // 0.9 x 0.5 of the tolerance are aimed at, first order.
    EXPECT_NEAR(renderer::refined({sparse, {next, 3.0 / 255.0}}).stepVoxels, 0.45 / 3.0, 1e-12);
}

}  // namespace
}  // namespace pellucid::test
