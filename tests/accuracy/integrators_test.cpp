// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Integrators, accumulation formats and jitter (docs/equations.md, 8 to 15) against closed forms and the
// reference.
#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/metrics.h"
#include "accuracy/reference.h"
#include "scene/names.h"
#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class Integrators : public GpuTest {
protected:
    static ImageF reference(const Scene& scene, const VolumePtr& volume, double bound) {
        accuracy::ReferenceOptions options;
        options.bound = bound;
        auto picture = accuracy::referencePicture(scene, {volume}, options);
        EXPECT_TRUE(picture) << (picture ? "" : picture.error().text());
        return picture ? std::move(picture->image) : ImageF{};
    }
    static double rmse(const ImageF& a, const ImageF& b) { return accuracy::difference(a, b).value().rmse; }
};

/// A field that the B-spline makes twice continuously differentiable, values in [0, 1].
VolumePtr wavyVolume() {
    return accuracy::sampledVolume(axisAlignedGrid({24, 24, 24}), VoxelType::Float32, [](glm::ivec3 i) {
        return 0.5 + 0.3 * std::sin(0.35 * i.x) * std::cos(0.3 * i.y) + 0.2 * std::sin(0.25 * i.z + 0.4);
    });
}

/// Inside one linear piece of the function, so that the integrand is as smooth as the field.
Scene smoothScene(const Grid& grid, Mode mode) {
    Scene scene = sceneOf({"smooth", "", {{-0.5, {0.1, 0.9, 0.3}, 0.0}, {1.5, {1.0, 0.2, 0.7}, 0.5}}},
                          orthographicAlong(grid, kOblique, 30.0), {24, 24});
    scene.mode = mode;
    scene.volumes[0].filter = Filter::TricubicBSpline;
    return scene;
}

struct Order {
    Integrator integrator;
    double expected;
};

/// Observed orders between steps of 2 and 1 voxel of a field with continuous second derivatives.
TEST_F(Integrators, ConvergeWithTheirOrder) {
    const VolumePtr volume = wavyVolume();
    for (const Mode mode : {Mode::Composite, Mode::XRay}) {
        Scene scene = smoothScene(volume->grid(), mode);
        const ImageF exact = reference(scene, volume, 1e-7);
        for (const auto& [integrator, expected] :
             {Order{Integrator::Riemann, 1.0}, Order{Integrator::Exponential, 2.0},
              Order{Integrator::Trapezoid, 2.0}, Order{Integrator::Preintegrated2D, 2.0},
              Order{Integrator::Preintegrated3D, 2.0}, Order{Integrator::IntegralFunctions, 2.0}}) {
            if (mode == Mode::XRay && integrator == Integrator::Riemann)
                continue;  // the same as exponential there
            scene.quality.integrator = integrator;
            scene.quality.stepVoxels = 2.0;
            const double before = rmse(draw(scene, volume), exact);
            scene.quality.stepVoxels = 1.0;
            const double after = rmse(draw(scene, volume), exact);
            EXPECT_NEAR(std::log2(before / after), expected, 0.15) << name(integrator) << ' ' << name(mode);
        }
    }
}

/// The fourth-order rules need four continuous derivatives: extinction and colour linear along the ray, the
/// kinks of the clamped edge cells on segment boundaries, and enough depth a step that the error stands above
/// float rounding.
TEST_F(Integrators, FourthOrderRulesConvergeWithOrderFour) {
    const Grid grid = axisAlignedGrid({1, 3, 1});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0 / 2.0);
    Scene scene = rayScene({"", "", {{0, {0.0, 1.0, 0.0}, 0.5}, {1, {1.0, 0.0, 1.0}, 4.0}}}, grid, {0, 1, 0});
    scene.camera.pose->heightMm = 0.5;
    const ImageF exact = reference(scene, volume, 1e-9);
    for (const Integrator integrator : {Integrator::Simpson, Integrator::GaussLegendre}) {
        scene.quality.integrator = integrator;
        scene.quality.stepVoxels = 0.5;
        const double before = rmse(draw(scene, volume), exact);
        scene.quality.stepVoxels = 0.25;
        const double after = rmse(draw(scene, volume), exact);
        EXPECT_NEAR(std::log2(before / after), 4.0, 0.15)
            << name(integrator) << ' ' << before << ' ' << after;
    }
}

/// At a fine step all agree with the reference. What is left is of second order, below 1/16 of the error at
/// one voxel, for most; the Riemann sum is first order and needs no more than to be named.
TEST_F(Integrators, AgreeWithTheReferenceInEveryFilterAndProjection) {
    const VolumePtr volume = wavyVolume();
    for (const auto& entry : enumNames<Integrator>()) {
        if (entry.value == Integrator::Riemann) continue;
        for (const Filter filter : {Filter::Trilinear, Filter::TricubicBSpline})
            for (const Mode mode : {Mode::Composite, Mode::XRay})
                for (const bool perspective : {false, true}) {
                    Scene scene = smoothScene(volume->grid(), mode);
                    scene.picture.size = {12, 12};
                    scene.volumes[0].filter = filter;
                    scene.volumes[0].transferFunction = colourfulFunction();
                    if (perspective) scene.camera = perspectiveAlong(volume->grid(), kOblique, 3.5);
                    if (mode == Mode::Composite && perspective) scene.lights->push_back(Light{});
                    scene.quality.integrator = entry.value;
                    scene.quality.stepVoxels = 0.125;
                    // The kinks of the function make the error of a step h at most h^2 / 8 times the jump of
                    // slope (0.5 - 0.06) / 0.35 per value, 0.1 value a voxel: 2e-4 per kink; a ray meets a
                    // handful, and lit ones add the change of the normal over half a step. A table entry over
                    // 1/256 of the values adds a quarter of that.
                    EXPECT_LT(largestDifference(draw(scene, volume), reference(scene, volume, 1e-5)), 4e-3)
                        << entry.name << ' ' << name(filter) << ' ' << name(mode)
                        << (perspective ? " perspective" : "");
                }
    }
}

/// B1.4b: the Riemann sum is too bright by x / (1 - exp(-x)), x = kappa d; the exponential rule is exact.
TEST_F(Integrators, TheRiemannSumHasItsKnownError) {
    const Grid grid = axisAlignedGrid({1, 16, 1});
    const VolumePtr volume = constantVolume(grid, 0.5);
    Scene scene = rayScene(constantFunction({0.25, 0.5, 0.5}, 2.0 / 16.0), grid, {0, 1, 0});
    scene.camera.pose->heightMm = 0.5;
    const double opacity = -std::expm1(-2.0);
    for (const double step : {1.0, 0.25}) {
        scene.quality.stepVoxels = step;
        const double x = 2.0 * step / 16.0;
        scene.quality.integrator = Integrator::Riemann;
        EXPECT_NEAR(drawRay(scene, volume).r, 0.25 * opacity * x / -std::expm1(-x), 1e-5) << step;
        scene.quality.integrator = Integrator::Exponential;
        EXPECT_NEAR(drawRay(scene, volume).r, 0.25 * opacity, 1e-6) << step;
    }
}

/// A constant colour shows as c (1 - T) + background T whatever the medium and the rule, Riemann apart.
TEST_F(Integrators, AConstantColourStaysItself) {
    const VolumePtr volume = wavyVolume();
    for (const double dense : {0.01, 1.0, 1000.0}) {
        for (const auto& entry : enumNames<Integrator>()) {
            if (entry.value == Integrator::Riemann) continue;
            Scene scene = smoothScene(volume->grid(), Mode::Composite);
            scene.picture.size = {12, 12};
            scene.picture.background = {0.2, 0.6, 0.4};
            scene.volumes[0].transferFunction = linearExtinction({0.9, 0.5, 0.1}, dense);
            scene.quality.integrator = entry.value;
            for (const glm::vec4& pixel : draw(scene, volume).pixels)
                for (int c = 0; c < 3; ++c) {
                    const double opacity = static_cast<double>(pixel.a);
                    const double expected = scene.volumes[0].transferFunction->points[0].color[c] * opacity +
                                            scene.picture.background[c] * (1.0 - opacity);
                    // Weights telescope to 1 - T; each of some 70 segments rounds its colour to 2^-24. A
                    // quotient of differences of running integrals over 4096 entries loses up to 4096 / 0.5
                    // of these where the ends nearly agree; the weights average them.
                    const bool differences =
                        entry.value == Integrator::IntegralFunctions || entry.value == Integrator::Adaptive;
                    ASSERT_NEAR(pixel[c], expected, (differences ? 4096.0 / 0.5 : 70.0) * kFloatUlp)
                        << entry.name << ' ' << dense;
                }
        }
    }
}

/// B4.5a, B7.2c: a box peak narrower than a step on a linear ramp has the opacity of its width, which point
/// samples miss.
TEST_F(Integrators, PreintegrationSeesAPeakBetweenSamples) {
    const Grid grid = axisAlignedGrid({1, 32, 1});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0 / 31.0);
    // Height 40 per mm over a width of 0.01 of the value: 0.31 mm of the ramp (1/31 a mm), triangular flanks
    // of 0.001.
    const TransferFunction1D peak{"",
                                  "",
                                  {{0, {1, 1, 1}, 0},
                                   {0.500, {1, 1, 1}, 0},
                                   {0.501, {1, 1, 1}, 40},
                                   {0.510, {1, 1, 1}, 40},
                                   {0.511, {1, 1, 1}, 0},
                                   {1, {1, 1, 1}, 0}}};
    Scene scene = rayScene(peak, grid, {0, 1, 0});
    scene.camera.pose->heightMm = 0.5;
    const double opacity = -std::expm1(-40.0 * 0.010 * 31.0);
    for (const double step : {0.7, 2.0, 5.0}) {
        scene.quality.stepVoxels = step;
        for (const Integrator integrator :
             {Integrator::Preintegrated2D, Integrator::Preintegrated3D, Integrator::IntegralFunctions}) {
            scene.quality.integrator = integrator;
            EXPECT_NEAR(drawRay(scene, volume).a, opacity, 0.01 * opacity) << name(integrator) << ' ' << step;
        }
    }
    scene.quality.integrator = Integrator::Exponential;
    scene.quality.stepVoxels = 5.0;
    EXPECT_LT(drawRay(scene, volume).a, 0.5);
}

/// The values that a segment passes before, in and behind the function's points each count, whether or not
/// the points span the data: F(v) of a linear ramp is exact at any step.
TEST_F(Integrators, FunctionsThatDoNotSpanTheDataAreIntegratedWhole) {
    const Grid grid = axisAlignedGrid({1, 32, 1});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0 / 31.0);
    const glm::dvec3 red(1, 0, 0), blue(0, 0, 1);
    const auto scene = [&](std::vector<TransferPoint> points) {
        Scene made = rayScene({"", "", std::move(points)}, grid, {0, 1, 0});
        made.camera.pose->heightMm = 0.5;
        made.quality.earlyTermination = 0.0;
        return made;
    };
    // A peak of 0.02 and one of 2e-9 of the values, and constant ends that begin and end in the middle.
    const Scene peak = scene({{0.49, red, 0}, {0.5, red, 6.25}, {0.51, red, 0}});
    const Scene delta = scene({{0.5 - 1e-9, red, 0}, {0.5, red, 6.25e7}, {0.5 + 1e-9, red, 0}});
    const Scene ends = scene({{0.49, red, 0.25}, {0.51, blue, 0.5}});
    const double opacity = -std::expm1(-31.0 * 0.01 * 6.25);
    // Half a voxel of the clamped edge belongs to each end.
    const double toPeak = 31.0 * 0.49 + 0.5, beyond = 31.0 * 0.49 + 0.5;
    const double opacityOfEnds = -std::expm1(-0.25 * toPeak - 31.0 * 0.02 * 0.375 - 0.5 * beyond);
    for (const double step : {0.25, 4.0})
        for (const Integrator integrator : {Integrator::Preintegrated2D, Integrator::Preintegrated3D,
                                            Integrator::IntegralFunctions, Integrator::Importance}) {
            const auto alpha = [&](Scene drawn) {
                drawn.quality.stepVoxels = step;
                drawn.quality.integrator = integrator;
                return drawRay(drawn, volume).a;
            };
            // 512 entries over the peak alone: its kinks are on entries, so what remains is float. Over the
            // delta, float values that are 6e-8 apart.
            EXPECT_NEAR(alpha(peak), opacity, 2e-5) << name(integrator) << ' ' << step;
            EXPECT_NEAR(alpha(delta), -std::expm1(-31.0 * 1e-9 * 6.25e7), 0.03)
                << name(integrator) << ' ' << step;
            EXPECT_NEAR(alpha(ends), opacityOfEnds, 2e-5) << name(integrator) << ' ' << step;
        }
}

/// A segment that is only partly in the table, with a colour that changes within the part: red is in front.
TEST_F(Integrators, CutSegmentsHideTheirOwnColoursAsMuchAsTheyAreDense) {
    const Grid grid = axisAlignedGrid({1, 32, 1});
    const VolumePtr volume = rampVolume(grid, 0.0, 1.0 / 31.0);
    for (const double extinction : {0.5, 4.0, 40.0}) {
        Scene scene = rayScene({"",
                                "",
                                {{0.45, {1, 0, 0}, 0},
                                 {0.45, {1, 0, 0}, extinction},
                                 {0.55, {0, 0, 1}, extinction},
                                 {0.55, {0, 0, 1}, 0}}},
                               grid, {0, 1, 0});
        scene.camera.pose->heightMm = 0.5;
        scene.quality.earlyTermination = 0.0;
        const double depth = 3.1 * extinction;
        // Integral of the blue part x along the way, seen through what is in front.
        const double blue = (1.0 - (1.0 + depth) * std::exp(-depth)) / depth;
        for (const double step : {1.0, 8.0})
            for (const Integrator integrator : {Integrator::Preintegrated2D, Integrator::Preintegrated3D}) {
                scene.quality.stepVoxels = step;
                scene.quality.integrator = integrator;
                const auto pixel = drawRay(scene, volume);
                EXPECT_NEAR(pixel.a, -std::expm1(-depth), 2e-3) << name(integrator) << ' ' << step;
                EXPECT_NEAR(pixel.b, blue, 0.01) << name(integrator) << ' ' << step << ' ' << extinction;
            }
    }
}

/// On a thin peak over a smooth field, pre-integration at two voxels a step beats point samples at a quarter
/// voxel.
TEST_F(Integrators, PreintegrationAtTwoVoxelsBeatsPointSamplesAtAQuarter) {
    const VolumePtr volume =
        accuracy::sampledVolume(axisAlignedGrid({48, 48, 48}), VoxelType::Float32, [](glm::ivec3 i) {
            const glm::dvec3 d = (glm::dvec3(i) - 23.5) / 24.0;
            return 0.5 + 0.3 * d.x + 0.15 * d.y * d.y - 0.1 * d.z * d.x;
        });
    Scene scene =
        sceneOf({"", "", {{0.600, {1, 0.8, 0.3}, 0}, {0.602, {1, 0.8, 0.3}, 6}, {0.604, {0.2, 0.4, 1}, 0}}},
                orthographicAlong(volume->grid(), {1.0, 0.6, -0.3}, 60.0), {40, 40});
    const ImageF exact = reference(scene, volume, 1e-4);
    const auto error = [&](Integrator integrator, double step) {
        scene.quality.integrator = integrator;
        scene.quality.stepVoxels = step;
        return rmse(draw(scene, volume), exact);
    };
    const double points = error(Integrator::Exponential, 0.25);
    for (const Integrator integrator :
         {Integrator::Preintegrated2D, Integrator::Preintegrated3D, Integrator::IntegralFunctions})
        EXPECT_LT(error(integrator, 2.0), 0.5 * points) << name(integrator);
}

/// The adaptive rule meets its tolerance, on smooth fields and on a thin peak, lit and unlit.
TEST_F(Integrators, AdaptiveStepsMeetTheTolerance) {
    const VolumePtr volume = wavyVolume();
    for (const bool thin : {false, true})
        for (const bool lit : {false, true})
            for (const Filter filter : {Filter::Trilinear, Filter::TricubicBSpline}) {
                Scene scene = smoothScene(volume->grid(), Mode::Composite);
                scene.volumes[0].filter = filter;
                scene.volumes[0].transferFunction = colourfulFunction();
                if (thin)
                    scene.volumes[0].transferFunction = TransferFunction1D{"",
                                                                           "",
                                                                           {{0, {1, 1, 1}, 0},
                                                                            {0.60, {1, 0.5, 0.2}, 0},
                                                                            {0.61, {1, 0.5, 0.2}, 2},
                                                                            {0.62, {0.2, 0.5, 1}, 0},
                                                                            {1, {1, 1, 1}, 0}}};
                if (lit) scene.lights->push_back(Light{});
                const ImageF exact = reference(scene, volume, 1e-4);
                scene.quality.integrator = Integrator::Adaptive;
                for (const double tolerance : {4.0, 1.0}) {
                    scene.quality.toleranceGreyLevels = tolerance;
                    const auto difference = accuracy::difference(draw(scene, volume), exact).value();
                    EXPECT_LE(difference.maxError * 255.0, tolerance)
                        << (thin ? "thin " : "") << (lit ? "lit " : "") << name(filter);
                }
            }
}

/// Values that change from voxel to voxel without a pattern: steps that follow differences of samples would
/// pass over a voxel between two of equal value. One segment a voxel is exact but for float rounding.
TEST_F(Integrators, AdaptiveSegmentsOfTheNearestFilterEndAtVoxels) {
    const VolumePtr volume = accuracy::randomVolume(axisAlignedGrid({24, 20, 16}), 5);
    for (const bool lit : {false, true}) {
        Scene scene = smoothScene(volume->grid(), Mode::Composite);
        scene.volumes[0].filter = Filter::Nearest;
        scene.volumes[0].transferFunction = colourfulFunction();
        if (lit) scene.lights->push_back(Light{});
        const ImageF exact = reference(scene, volume, 1e-6);
        scene.quality.integrator = Integrator::Adaptive;
        scene.quality.toleranceGreyLevels = 100.0;
        scene.quality.stepVoxels = 8.0;
        const auto difference = accuracy::difference(draw(scene, volume), exact).value();
        EXPECT_LE(difference.maxError, 1e-4) << (lit ? "lit" : "unlit");
    }
}

/// B9.5a: where blending stops growing. n layers of opacity a stall when a (1 - A) is half a unit of the
/// format.
TEST_F(Integrators, LowAccumulationFormatsStallWhereTheyMust) {
    const Grid grid = axisAlignedGrid({1, 2000, 1});  // 4000 layers of half a voxel
    const VolumePtr volume = constantVolume(grid, 0.5);
    struct Case {
        Accumulation accumulation;
        double opacity, expected;
    };
    for (const auto& [accumulation, opacity, expected] :
         {Case{Accumulation::EightBit, 0.01, 0.81}, Case{Accumulation::EightBit, 0.004, 0.51},
          Case{Accumulation::EightBit, 0.001, 0.0}, Case{Accumulation::Half, 0.01, 0.976},
          Case{Accumulation::Half, 0.004, 0.939}, Case{Accumulation::Half, 0.001, 0.756},
          Case{Accumulation::Float32, 0.01, 1.0},
          Case{Accumulation::Float32, 0.001, 1.0 - std::pow(0.999, 4000)}}) {
        Scene scene = rayScene(constantFunction({1, 1, 1}, -std::log1p(-opacity)), grid, {0, 1, 0});
        scene.camera.pose->heightMm = 0.5;
        scene.unitLengthMm = 0.5;
        scene.quality.stepVoxels = 0.5;
        scene.quality.accumulation = accumulation;
        EXPECT_NEAR(drawRay(scene, volume).a, expected, 0.01) << name(accumulation) << ' ' << opacity;
    }
}

/// Jitter moves the segments' boundaries, so what is homogeneous is exact with it, and the mean over offsets
/// is unbiased.
TEST_F(Integrators, JitterIsUnbiasedAtBothEnds) {
    const Grid grid = axisAlignedGrid({16, 16, 16});
    Scene scene =
        sceneOf(constantFunction({0.9, 0.5, 0.1}, 0.1), orthographicAlong(grid, kOblique, 10.0), {64, 64});
    scene.quality.stepVoxels = 3.0;
    const VolumePtr flat = constantVolume(grid, 0.5);
    const ImageF plain = draw(scene, flat);
    scene.quality.jitter = true;
    EXPECT_LE(largestDifference(draw(scene, flat), plain), 1e-6);
    // Every offset of the 64 x 64 tile once, on rays that are all the same: a ramp across one value of the
    // function.
    const VolumePtr ramp = rampVolume(axisAlignedGrid({1, 64, 1}), 0.0, 1.0 / 63.0);
    Scene ray = rayScene(
        {"", "", {{0, {1, 1, 1}, 0}, {0.4, {1, 1, 1}, 0}, {0.4, {1, 1, 1}, 0.05}, {1, {1, 1, 1}, 0.05}}},
        ramp->grid(), {0, 1, 0});
    ray.camera.pose->heightMm = 0.5;
    ray.picture.size = {64, 64};
    ray.quality.stepVoxels = 5.0;
    const auto meanOpacity = [&] {
        double sum = 0.0;
        for (const glm::vec4& pixel : draw(ray, ramp).pixels) sum += static_cast<double>(pixel.a);
        return sum / 4096.0;
    };
    const double exact = -std::expm1(-0.05 * (64.0 - 0.5 - 0.4 * 63.0));
    const double unjittered = meanOpacity();
    ray.quality.jitter = true;
    const double jittered = meanOpacity();
    EXPECT_GT(std::abs(unjittered - exact), 5e-3);
    // The offsets are evenly spread over the step, so the mean depth is exact; the mean of its exponential
    // differs by half the variance of the depth, (0.05 * 5)^2 / 12 * T / 2.
    EXPECT_NEAR(jittered, exact, 0.05 * 0.05 * 25.0 / 24.0 * (1.0 - exact) + 1e-4);
}

/// A preview is drawn at once and says so; the exact table follows.
TEST_F(Integrators, APreviewTableIsReplacedByTheExactOne) {
    const VolumePtr volume = wavyVolume();
    Scene scene = smoothScene(volume->grid(), Mode::Composite);
    scene.volumes[0].transferFunction->points[1].extinction = 3.25;  // a table of its own
    scene.quality.integrator = Integrator::Preintegrated2D;
    scene.quality.stepVoxels = 4.0;
    renderer::RenderOptions quick;
    quick.allowPreview = true;
    const renderer::Frame first = frameOf(scene, volume, quick);
    const renderer::Frame exact = frameOf(scene, volume);
    EXPECT_FALSE(exact.preview);
    // The exact table may already be there when the first picture is drawn; a preview differs by its
    // neglected self-attenuation.
    EXPECT_EQ(largestDifference(first.image, exact.image) > 1e-4, first.preview);
    EXPECT_FALSE(frameOf(scene, volume, quick).preview);
}

}  // namespace
}  // namespace pellucid::test
