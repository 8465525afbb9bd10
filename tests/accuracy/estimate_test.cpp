// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The error a frame states of itself, held against the reference on real scans and synthetic fields.
#include "io/load.h"
#include "renderer/plan/features.h"
#include "renderer/refinement.h"
#include "tests/accuracy/estimate_judge.h"

namespace pellucid::test {
namespace {

class Estimate : public GpuTest {
protected:
    static renderer::Frame estimated(const Scene& scene, const VolumePtr& volume) {
        renderer::RenderOptions options;
        options.estimateError = true;
        options.estimateReduction = 1;
        return frameOf(scene, volume, options);
    }
};

/// Estimated maximum and RMSE are within a factor of 2 of the true ones on at least 95 % of frames.
TEST_F(Estimate, LiesWithinAFactorOfTwo) {
    std::vector<std::pair<std::string, VolumePtr>> sources{{"Marschner-Lobb", accuracy::marschnerLobb(40)}};
    for (const char* path :
         {PELLUCID_SOURCE_DIR "/resources/sample/ct-torso.nii.gz", PELLUCID_TEST_DATA "/ct-head-64"}) {
        auto volume = io::loadVolume({path});
        ASSERT_TRUE(volume) << volume.error().text();
        sources.emplace_back(path, *volume);
    }
    EstimateJudge judge;
    for (const auto& [name, volume] : sources) {
        const auto draw = [&](const Scene& scene) { return estimated(scene, volume); };
        const std::vector<AnatomicalView> views{AnatomicalView::Anterior, AnatomicalView::Left};
        for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Mip})
            judge.judgeViews(sceneIn(mode, false), volume, name, views, draw);
        judge.judgeViews(sceneIn(Mode::Composite, true), volume, name + " lit", views, draw);
    }
    judge.max.expectGood("maximum");
    judge.rmse.expectGood("RMSE");
}

/// What a table gets wrong must not be in both pictures.
TEST_F(Estimate, NoPictureComparedWithIsTabulated) {
    for (const auto& integrator : enumNames<Integrator>()) {
        Scene scene = sceneIn(Mode::Composite, false);
        scene.quality.integrator = integrator.value;
        const renderer::Frame frame = frameOf(scene, accuracy::marschnerLobb(8));
        const Integrator better = renderer::comparison(scene, frame.plan).quality.integrator;
        EXPECT_FALSE(renderer::usesPreintegration(better)) << integrator.name;
        EXPECT_TRUE(renderer::usesRunningIntegrals(better)) << integrator.name;
    }
}

/// A peak between the samples, which they all miss at a step and at a quarter of it: voxels rise by 1/32, the
/// peak is 0.3 of a voxel behind one and a five-hundredth of a voxel wide.
TEST_F(Estimate, TellsOfAPeakBetweenTheSamples) {
    const Grid grid = axisAlignedGrid({4, 33, 4});
    const VolumePtr volume =
        accuracy::sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) { return i.y / 32.0; });
    constexpr glm::dvec3 kWhite(1.0);
    constexpr double kAt = 16.3 / 32.0, kHalf = 1.0 / 32.0 / 1000.0;
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = TransferFunction1D{
        "peak",
        "",
        {{kAt - kHalf, kWhite, 0.0}, {kAt, kWhite, 2.0 / (32.0 * kHalf)}, {kAt + kHalf, kWhite, 0.0}}};
    scene.lights.emplace();
    scene.unitLengthMm = 1.0;
    scene.quality.stepVoxels = 1.0;
    scene.camera.projection = Projection::Orthographic;
    scene.camera.pose = CameraPose{centreMm(grid) - glm::dvec3(0, 50, 0), centreMm(grid), {0, 0, 1}, 2.0};
    scene.picture.size = {4, 4};
    const double exact = -std::expm1(-2.0);
    for (const Mode mode : {Mode::Composite, Mode::XRay})
        for (const Integrator integrator :
             {Integrator::Exponential, Integrator::Riemann, Integrator::Trapezoid, Integrator::Simpson,
              Integrator::GaussLegendre}) {
            scene.mode = mode;
            scene.quality.integrator = integrator;
            const renderer::Frame frame = estimated(scene, volume);
            const double error = std::abs(static_cast<double>(frame.image.pixels.front().r) - exact);
            EXPECT_NEAR(error, exact, 1e-3) << "missed: " << name(mode) << ' ' << name(integrator);
            EXPECT_GE(frame.error->maxError, 0.5 * error) << name(mode) << ' ' << name(integrator);
            EXPECT_LE(frame.error->maxError, 2.0 * error) << name(mode) << ' ' << name(integrator);
        }
}

/// Where no control point lies within the values, rules of order 4 are better than running integrals.
TEST_F(Estimate, RulesOfFourthOrderAreComparedWithThemselvesOnAStraightFunction) {
    const VolumePtr volume = accuracy::marschnerLobb(8);
    Scene scene = sceneIn(Mode::Composite, false);
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction =
        TransferFunction1D{"line", "", {{-1.0, glm::dvec3(1.0), 0.0}, {2.0, glm::dvec3(1.0), 0.3}}};
    for (const Integrator integrator : {Integrator::Simpson, Integrator::GaussLegendre}) {
        scene.quality.integrator = integrator;
        const auto comparedWith = [&] {
            const Scene full = completed(scene, {volume});
            return renderer::comparison(full, frameOf(full, volume).plan).quality.integrator;
        };
        EXPECT_EQ(comparedWith(), integrator);
        auto& points = scene.volumes.front().transferFunction->points;
        points.insert(points.begin() + 1, {0.4, glm::dvec3(0.0), 0.2});
        EXPECT_EQ(comparedWith(), Integrator::IntegralFunctions);
        points.erase(points.begin() + 1);
    }
}

/// Where the driver refuses the comparison, the scene's own rule is still tried.
TEST_F(Estimate, ARefinementThatGivesUpComparesWithTheSceneItself) {
    const VolumePtr volume = accuracy::marschnerLobb(8);
    const Scene scene = completed(sceneIn(Mode::Composite, false), {volume});
    renderer::Refinement refinement(scene, std::nullopt, 1.0);
    const auto asked = refinement.take(frameOf(refinement.next(), volume));
    ASSERT_TRUE(refinement.isMeasuring());
    EXPECT_EQ(refinement.next(), renderer::comparison(scene, asked->plan));
    refinement.giveUp();
    ASSERT_TRUE(refinement.isMeasuring());
    EXPECT_EQ(refinement.next(), renderer::comparisonWithItself(scene, asked->plan));
    EXPECT_NE(refinement.next(), renderer::comparison(scene, asked->plan));
    refinement.giveUp();
    EXPECT_TRUE(refinement.isDone());
}

/// With software OpenGL 20000 samples of a quarter turn each are drawn, 80000 of one turn are not, 80000 of a
/// quarter are.
TEST_F(Estimate, ThereIsOneWhereTheDriverRefusesTheComparison) {
    const VolumePtr volume = accuracy::marschnerLobb(8);
    Scene scene = completed(sceneIn(Mode::Composite, false), {volume});
    scene.picture.size = {2, 2};
    scene.quality.stepMm = 2.0 * radiusMm(volume->grid()) / 20000.0;
    const renderer::Frame frame = estimated(scene, volume);
    EXPECT_TRUE(frame.error);
    EXPECT_LT(frame.error->maxError, 1e-3);
}

TEST_F(Estimate, ARefinementHalvesTheStepUntilThePictureIsTheScenes) {
    const VolumePtr volume = accuracy::marschnerLobb(24);
    Scene scene = completed(Scene{}, {volume});
    scene.picture.size = {32, 24};
    scene.quality.integrator = Integrator::Preintegrated2D;
    scene.quality.jitter = true;
    renderer::Refinement refinement(scene);
    std::vector<double> steps;
    std::vector<std::string> methods;
    std::shared_ptr<const renderer::Frame> shown;
    const ImageF asked = draw(scene, volume);
    while (!refinement.isDone()) {
        const Scene next = refinement.next();
        steps.push_back(stepMm(next.quality, volume->grid()) / stepMm(scene.quality, volume->grid()));
        EXPECT_EQ(next == scene, steps.back() == 1.0) << "only the picture with this step is the scene's";
        shown = refinement.take(frameOf(next, volume));
        methods.push_back(shown->error ? shown->error->method : "");
        EXPECT_EQ(shown->image == asked, steps.back() <= 1.0);
    }
    EXPECT_EQ(steps, (std::vector{4.0, 2.0, 1.0, 0.25}));
    EXPECT_EQ(methods, (std::vector<std::string>{"", "a first idea from a picture with twice the step",
                                                 "a first idea from a picture with twice the step",
                                                 "compared with a quarter of the step on 32 x 24 pixels"}));
    renderer::RenderOptions options;
    options.estimateError = true;
    options.estimateReduction = 1;
    const renderer::Frame estimated = frameOf(scene, volume, options);
    EXPECT_EQ(shown->error->rmse, estimated.error->rmse) << "one rule, whoever draws";
    EXPECT_EQ(shown->error->maxError, estimated.error->maxError);
}

TEST_F(Estimate, ARefinementOfAutomaticQualityEndsWithItsOwnEstimate) {
    const VolumePtr volume = accuracy::marschnerLobb(24);
    Scene scene = completed(Scene{}, {volume});
    scene.picture.size = {32, 24};
    scene.quality.automatic = true;
    const renderer::Frame before = frameOf(scene, volume);
    ASSERT_TRUE(before.chosen && before.error);
    scene.camera.view = AnatomicalView::Superior;
    renderer::Refinement refinement(scene, before.chosen);
    for (const double times : {4.0, 2.0}) {
        const Scene next = refinement.next();
        EXPECT_FALSE(next.quality.automatic);
        EXPECT_EQ(next.quality.integrator, before.chosen->integrator);
        EXPECT_EQ(next.quality.stepVoxels, times * before.chosen->stepVoxels);
        refinement.take(frameOf(next, volume));
    }
    EXPECT_EQ(refinement.next(), scene);
    const auto shown = refinement.take(frameOf(scene, volume));
    EXPECT_TRUE(refinement.isDone());
    EXPECT_TRUE(shown->chosen);
    EXPECT_TRUE(shown->error->method.starts_with("compared with a quarter")) << shown->error->method;
}

TEST_F(Estimate, ASliceHasNothingToRefine) {
    const VolumePtr volume = accuracy::marschnerLobb(8);
    Scene scene = completed(Scene{}, {volume});
    scene.mode = Mode::Slice;
    renderer::Refinement refinement(scene);
    EXPECT_FALSE(refinement.take(frameOf(refinement.next(), volume))->error);
    EXPECT_TRUE(refinement.isDone());
}

}  // namespace
}  // namespace pellucid::test
