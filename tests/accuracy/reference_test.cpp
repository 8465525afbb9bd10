// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "accuracy/ray_integrator.h"
#include "tests/accuracy/scenes.h"

namespace pellucid::accuracy {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);

/// RGBA of the one ray of a rayScene(), in double.
glm::dvec4 centrePixel(const Scene& scene, const VolumePtr& volume, double stepMm = 0.25) {
    return RayIntegrator(completed(scene, {volume}), *volume).pixel(0.0, 0.0, stepMm);
}

void expectColor(const glm::dvec4& found, const glm::dvec3& expected, double tolerance) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], expected[channel], tolerance) << channel;
}

// Tolerances of 1e-12 and below are rounding: sums of up to 1e3 terms of size 1 in double. Where the colour
// varies on a piece, the order-6 quadrature adds up to 1e-9 (see kDeepestPiece).

TEST(Reference, HomogeneousSlabHasBeersTransparency) {
    const Grid grid = axisAlignedGrid({4, 10, 4}, {1.0, 0.7, 1.3});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    for (const double extinction : {0.0, 1e-8, 0.01, 1.0, 40.0, 1e4}) {
        for (const Filter filter : test::allFilters()) {
            Scene scene = test::rayScene(test::constantFunction(kOrange, extinction), grid, kAlongY);
            scene.volumes.front().filter = filter;
            scene.picture.background = {0.2, 0.4, 0.6};
            scene.unitLengthMm = 2.0;
            const double depth = extinction / 2.0 * 7.0;
            const glm::dvec4 pixel = centrePixel(scene, volume);
            const double t = std::exp(-depth);
            EXPECT_NEAR(pixel.a, -std::expm1(-depth), 1e-12 * std::min(1.0, depth) + 1e-16);
            expectColor(pixel, kOrange * -std::expm1(-depth) + t * scene.picture.background, 1e-12);
        }
    }
}

/// tau = a L + b L^2 / 2 where the value is linear; half a voxel of constant value lies at each end.
TEST(Reference, LinearExtinctionGivesTheQuadraticDepth) {
    const int n = 12;
    const Grid grid = axisAlignedGrid({3, n, 3});
    const VolumePtr volume = test::rampVolume(grid, 0.125, 0.0625);
    const Scene scene = test::rayScene(test::linearExtinction(kOrange, 0.8), grid, kAlongY);
    const double length = n - 1;
    const double last = 0.125 + 0.0625 * length;
    const double depth = 0.8 * (0.125 * length + 0.0625 * length * length / 2.0 + 0.5 * 0.125 + 0.5 * last);
    for (const double step : {0.1, 0.37, 5.0})
        EXPECT_NEAR(centrePixel(scene, volume, step).a, -std::expm1(-depth), 1e-13);
}

/// The cubic filters reproduce linear data too, away from the border.
TEST(Reference, CubicFiltersKeepALinearRamp) {
    const Grid grid = axisAlignedGrid({5, 12, 5});
    const VolumePtr volume = test::rampVolume(grid, 0.125, 0.0625);
    for (const Filter filter : {Filter::TricubicBSpline, Filter::CatmullRom}) {
        Scene scene = test::rayScene(test::linearExtinction(kOrange, 0.8), grid, kAlongY);
        scene.volumes.front().filter = filter;
        const RayIntegrator integrator(completed(scene, {volume}), *volume);
        const auto ray = integrator.rayAt(0.0, 0.0);
        const Interval range{ray.inside->from + 2.5, ray.inside->from + 9.0};  // Index 2 to 8.5.
        const double a = 0.8 * (0.125 + 2.0 * 0.0625);
        EXPECT_NEAR(integrator.integrate(ray, {range}, 0.5).opticalDepth,
                    a * 6.5 + 0.8 * 0.0625 * 6.5 * 6.5 / 2.0, 1e-12);
    }
}

/// Colour c0 + c1 s under constant extinction k: C = integral of k e^(-k s) (c0 + c1 s) ds
///   = c0 (1 - e^(-k L)) + c1 ((1 - e^(-k L)) / k - L e^(-k L)).
TEST(Reference, LinearColourInAConstantMediumHasItsClosedForm) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 0.125);
    for (const double k : {0.01, 0.7, 30.0, 1e4}) {
        const TransferFunction1D function{"", "", {{0.0, {0.0, 0.0, 1.0}, k}, {1.0, {1.0, 0.5, 0.0}, k}}};
        const Scene scene = test::rayScene(function, grid, kAlongY);
        const RayIntegrator integrator(completed(scene, {volume}), *volume);
        const auto ray = integrator.rayAt(0.0, 0.0);
        const double length = 8.0;
        const Interval range{ray.inside->from + 0.5, ray.inside->from + 0.5 + length};
        const double opacity = -std::expm1(-k * length);
        const double ramp = (opacity / k - length * std::exp(-k * length)) / length;
        const RayIntegral found = integrator.integrate(ray, {range}, 1.0);
        EXPECT_NEAR(found.color.r, ramp, 1e-9) << k;
        EXPECT_NEAR(found.color.g, ramp / 2.0, 1e-9) << k;
        EXPECT_NEAR(found.color.b, opacity - ramp, 1e-9) << k;
    }
}

TEST(Reference, TwoSlabsKeepTheirOrder) {
    const Grid grid = axisAlignedGrid({1, 2, 1}, {1, 3, 1});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 1.0);
    const TransferFunction1D function{"", "", {{0.5, {1, 0, 0}, 0.2}, {0.5, {0, 0, 1}, 0.5}}};
    Scene scene = test::rayScene(function, grid, kAlongY);
    scene.volumes.front().filter = Filter::Nearest;
    const double t1 = std::exp(-0.6);
    const double t2 = std::exp(-1.5);
    expectColor(centrePixel(scene, volume), {1 - t1, 0, t1 * (1 - t2)}, 1e-13);
    // With trilinear interpolation the step of the function lies at the same place: half-way.
    scene.volumes.front().filter = Filter::Trilinear;
    expectColor(centrePixel(scene, volume, 10.0), {1 - t1, 0, t1 * (1 - t2)}, 1e-13);
    scene.camera = test::orthographicAlong(grid, -kAlongY, 1.0);
    expectColor(centrePixel(scene, volume), {t2 * (1 - t1), 0, 1 - t2}, 1e-13);
}

/// q = kappa c makes I = I0 T + c (1 - T) for any kappa(s) (Max 1995): exact, because opacity is taken as 1 -
/// T.
TEST(Reference, ConstantColourIsExactInAnyMedium) {
    const Grid grid = axisAlignedGrid({6, 6, 6}, {1.0, 0.4, 2.0});
    const VolumePtr volume = randomVolume(grid, 7);
    for (const double extinction : {1e-6, 0.3, 20.0, 1e5}) {
        for (const Filter filter : test::allFilters()) {
            Scene scene = test::rayScene(test::linearExtinction(kOrange, extinction), grid, {0.3, 1.0, 0.2});
            scene.picture.background = {0.1, 0.9, 0.3};
            scene.volumes.front().filter = filter;
            const glm::dvec4 pixel = centrePixel(scene, volume);
            expectColor(pixel, kOrange * pixel.a + (1.0 - pixel.a) * scene.picture.background, 1e-13);
        }
    }
}

TEST(Reference, SplittingARayAndJoiningItChangesNothing) {
    const Grid grid = axisAlignedGrid({6, 6, 6});
    const VolumePtr volume = randomVolume(grid, 3);
    Scene scene = test::rayScene(test::colourfulFunction(4.0), grid, {0.3, 1.0, 0.2});
    scene.lights = std::vector<Light>{Light{}};
    const RayIntegrator integrator(completed(scene, {volume}), *volume);
    const auto ray = integrator.rayAt(0.0, 0.0);
    const Interval whole = *ray.inside;
    const RayIntegral all = integrator.integrate(ray, {whole}, 1e-3);
    for (const double part : {0.1, 0.37, 0.5, 0.93}) {
        const double middle = whole.from + part * (whole.to - whole.from);
        const RayIntegral front = integrator.integrate(ray, {{whole.from, middle}}, 1e-3);
        const RayIntegral back = integrator.integrate(ray, {{middle, whole.to}}, 1e-3);
        EXPECT_NEAR(front.opticalDepth + back.opticalDepth, all.opticalDepth, 1e-12);
        // The shade jumps where the normal turns; the pieces close in on it to 1e-7 each.
        expectColor({front.color + std::exp(-front.opticalDepth) * back.color, 0.0}, all.color, 1e-6);
    }
}

/// Emission only: I0 + q L; emission-absorption tends to it as the medium thins, and to the colour as it
/// thickens.
TEST(Reference, EmissionAndItsLimits) {
    const Grid grid = axisAlignedGrid({2, 5, 2});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    for (const double k : {1e-10, 1e-3, 2.0}) {
        Scene scene = test::rayScene(test::constantFunction(kOrange, k), grid, kAlongY);
        scene.picture.background = {0.2, 0.2, 0.2};
        scene.mode = Mode::Emission;
        expectColor(centrePixel(scene, volume), scene.picture.background + kOrange * k * 5.0, 1e-13);
        EXPECT_EQ(centrePixel(scene, volume).a, 0.0);
        scene.mode = Mode::Composite;
        scene.picture.background = {0.0, 0.0, 0.0};
        // 1 - e^(-x) = x - x^2 / 2 + ..., so the two differ by at most x^2 / 2.
        const double x = k * 5.0;
        expectColor(centrePixel(scene, volume), kOrange * x, x * x / 2.0 + 1e-15);
    }
    Scene dense = test::rayScene(test::constantFunction(kOrange, 1e6), grid, kAlongY);
    expectColor(centrePixel(dense, volume), kOrange, 1e-15);
}

TEST(Reference, XRayShowsTransmittanceOrOpacity) {
    const Grid grid = axisAlignedGrid({2, 5, 2});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    Scene scene = test::rayScene(test::constantFunction(kOrange, 0.3), grid, kAlongY);
    scene.picture.background = {1.0, 0.0, 0.0};
    scene.mode = Mode::XRay;
    scene.xray = XRayDisplay::Transmittance;
    expectColor(centrePixel(scene, volume), glm::dvec3(std::exp(-1.5)), 1e-14);
    scene.xray = XRayDisplay::Opacity;
    expectColor(centrePixel(scene, volume), glm::dvec3(1.0 - std::exp(-1.5)), 1e-14);
}

/// v = x + y - 2 x y in one cell is 2 s - 2 s^2 on its diagonal: 1/2 in the middle, above both corners.
TEST(Reference, MipFindsTheMaximumInsideACell) {
    const Grid grid = axisAlignedGrid({2, 2, 1});
    const VolumePtr volume =
        sampledVolume(grid, VoxelType::Float64, [](glm::ivec3 i) { return i.x == i.y ? 0.0 : 1.0; });
    Scene scene = test::rayScene(test::colourfulFunction(), grid, {1.0, 1.0, 0.0});
    scene.mode = Mode::Mip;
    for (const double step : {0.11, 0.7, 9.0}) EXPECT_NEAR(centrePixel(scene, volume, step).r, 0.5, 1e-14);
    scene.mode = Mode::MinIp;
    EXPECT_NEAR(centrePixel(scene, volume).r, 0.0, 1e-14);
}

/// A ramp with its constant half voxels at both ends: the mean is the middle value. Of v = s^2 sampled at s =
/// 0, 1, 2 the mean over the box of 3 is (0 * 0.5 + 0.5 + 2.5 + 4 * 0.5) / 3 = 5/3.
TEST(Reference, AverageIsTheMeanOverThePath) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    Scene scene = test::rayScene(test::colourfulFunction(), grid, kAlongY);
    scene.mode = Mode::Average;
    EXPECT_NEAR(centrePixel(scene, test::rampVolume(grid, 0.1, 0.05)).r, 0.3, 1e-14);
    const Grid three = axisAlignedGrid({1, 3, 1});
    scene = test::rayScene(test::colourfulFunction(), three, kAlongY);
    scene.mode = Mode::Average;
    scene.volumes.front().window = Window{2.0, 4.0};
    const VolumePtr squares =
        sampledVolume(three, VoxelType::Float64, [](glm::ivec3 i) { return static_cast<double>(i.y * i.y); });
    EXPECT_NEAR(centrePixel(scene, squares).r, 5.0 / 12.0, 1e-14);
}

/// On a ramp along the ray every place is known, so a point light tells where the hit was: h and l meet at
/// angles that depend on it. Here a light in the plane through the hit, at 45 degrees: n.l = cos 45.
TEST(Reference, IsosurfaceAndFirstHitLieWhereTheFieldSays) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 0.125);
    const TransferFunction1D function{"", "", {{0.0, kOrange, 0.0}, {1.0, kOrange, 1.0}}};
    Scene scene = test::rayScene(function, grid, kAlongY);
    scene.material = {0.0, 1.0, 0.0, 1.0};
    scene.volumes.front().isovalue = 0.43;
    // Opacity per unit length 1 - e^(-0.43): extinction 0.43, value 0.43, index 3.44.
    scene.hitOpacity = -std::expm1(-0.43);
    const glm::dvec3 hit(1.0, 3.44, 1.0);
    Light light;
    light.kind = LightKind::Point;
    light.positionMm = hit + glm::dvec3(2.0, -2.0, 0.0);
    scene.lights = std::vector<Light>{light};
    for (const Mode mode : {Mode::Isosurface, Mode::FirstHit}) {
        scene.mode = mode;
        const glm::dvec4 pixel = centrePixel(scene, volume);
        EXPECT_EQ(pixel.a, 1.0);
        expectColor(pixel, kOrange * std::sqrt(0.5), 1e-12);
    }
}

TEST(Reference, IsosurfaceHitsAtTheFaceWhenTheRayStartsAboveTheValue) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    const VolumePtr volume = test::rampVolume(grid, 1.0, -0.125);
    Scene scene = test::rayScene(test::constantFunction(kOrange, 1.0), grid, kAlongY);
    scene.mode = Mode::Isosurface;
    expectColor(centrePixel(scene, volume), kOrange, 0.0);
    scene.volumes.front().isovalue = 1.5;
    scene.picture.background = {0.25, 0.5, 0.75};
    const glm::dvec4 miss = centrePixel(scene, volume);
    expectColor(miss, scene.picture.background, 0.0);
    EXPECT_EQ(miss.a, 0.0);
}

/// Blinn-Phong by hand: headlight along the ray, so n.l = n.h = 1 whichever way the field runs (two-sided),
/// and the colour alone where the gradient vanishes.
TEST(Reference, ShadingIsTwoSidedAndSparesFlatRegions) {
    const Grid grid = axisAlignedGrid({3, 9, 3});
    for (const double slope : {0.125, -0.125, 0.0}) {
        const VolumePtr volume = test::rampVolume(grid, slope < 0.0 ? 1.0 : 0.0, slope);
        Scene scene = test::rayScene(test::constantFunction(kOrange, 0.3), grid, kAlongY);
        scene.material = {0.1, 0.6, 0.2, 8.0};
        scene.lights = std::vector<Light>{Light{}};
        scene.lights->front().intensity = 0.5;
        const glm::dvec3 shade = slope == 0.0 ? kOrange : 0.1 * kOrange + 0.5 * (0.6 * kOrange + 0.2);
        const glm::dvec4 pixel = centrePixel(scene, volume);
        expectColor(pixel, shade * -std::expm1(-0.3 * 9.0), 1e-12);
    }
}

TEST(Reference, SliceShowsThePlaneThroughTheTarget) {
    const Grid grid = axisAlignedGrid({3, 9, 3}, {1, 2, 1});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 0.125);
    Scene scene = test::rayScene(test::colourfulFunction(), grid, kAlongY);
    scene.mode = Mode::Slice;
    EXPECT_NEAR(centrePixel(scene, volume).r, 0.5, 1e-14);
    scene.camera.pose->target.y += 3.0;
    EXPECT_NEAR(centrePixel(scene, volume).r, 0.5 + 1.5 * 0.125, 1e-14);
    scene.camera.pose->target.y += 100.0;
    EXPECT_EQ(centrePixel(scene, volume).a, 0.0);
}

TEST(Reference, NearPlaneInsideTheVolumeCutsTheRay) {
    const Grid grid = axisAlignedGrid({3, 10, 3});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    Scene scene = test::rayScene(test::constantFunction(kOrange, 0.2), grid, kAlongY);
    const double eyeToFront = -0.5 - scene.camera.pose->eye.y;
    scene.camera.nearMm = eyeToFront + 4.0;
    EXPECT_NEAR(centrePixel(scene, volume).a, -std::expm1(-0.2 * 6.0), 1e-13);
}

TEST(Reference, DensityScalesLikeLength) {
    const Grid grid = axisAlignedGrid({4, 4, 4});
    const VolumePtr volume = randomVolume(grid, 5);
    const Scene scene = test::rayScene(test::colourfulFunction(), grid, {0.2, 1.0, 0.1});
    const Grid small = axisAlignedGrid({4, 4, 4}, {0.25, 0.25, 0.25});
    const VolumePtr shrunk = randomVolume(small, 5);
    Scene dense = test::rayScene(test::colourfulFunction(), small, {0.2, 1.0, 0.1});
    dense.densityScale = 4.0;
    expectColor(centrePixel(dense, shrunk, 0.05), centrePixel(scene, volume, 0.2), 1e-12);
}

/// 50 % black over white is 0.5 of the light, which the sRGB curve shows as 187.5 / 255.
TEST(Reference, LinearSpaceEncodesAtTheEnd) {
    const Grid grid = axisAlignedGrid({2, 4, 2});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    Scene scene = test::rayScene(test::constantFunction({0, 0, 0}, std::log(2.0) / 4.0), grid, kAlongY);
    scene.picture.background = {1, 1, 1};
    scene.space = CompositingSpace::Linear;
    const double encoded = 1.055 * std::pow(0.5, 1.0 / 2.4) - 0.055;
    expectColor(centrePixel(scene, volume), glm::dvec3(encoded), 1e-12);
    EXPECT_EQ(std::lround(255.0 * encoded), 188);
    scene.space = CompositingSpace::Display;
    expectColor(centrePixel(scene, volume), glm::dvec3(0.5), 1e-12);
}

TEST(Reference, AFarOriginLosesNoDigits) {
    const Grid near = axisAlignedGrid({6, 6, 6}, {0.5, 0.5, 0.5});
    const Grid far = axisAlignedGrid({6, 6, 6}, {0.5, 0.5, 0.5}, {1e7, -1e7, 1e7});
    const auto at = [&](const Grid& grid) {
        return centrePixel(test::rayScene(test::colourfulFunction(9.0), grid, {0.3, 1.0, 0.2}),
                           randomVolume(grid, 3));
    };
    // The eye itself is stored to 2e-9 mm there.
    expectColor(at(far), at(near), 1e-7);
}

/// Random data with a bent function, four lights that make the shade jump, every mode and filter: halving the
/// step must reach the asked bound.
TEST(Reference, PicturesConvergeToTheAskedBound) {
    const Grid grid = axisAlignedGrid({8, 8, 8});
    const VolumePtr volume = randomVolume(grid, 11);
    Light side;
    side.kind = LightKind::Directional;
    side.directionMm = {1.0, 0.3, -0.4};
    for (const Mode mode : test::allModes()) {
        for (const Filter filter : test::allFilters()) {
            Scene scene = test::sceneOf(test::colourfulFunction(4.0),
                                        test::perspectiveAlong(grid, {0.4, 1.0, -0.3}, 3.5), {12, 12});
            scene.mode = mode;
            scene.volumes.front().filter = filter;
            scene.lights = std::vector<Light>{Light{}, side};
            const auto reference = referencePicture(scene, {volume}, {1e-5, 8, {}});
            ASSERT_TRUE(reference) << reference.error().text();
            EXPECT_LT(reference->reachedBound, 1e-5) << name(mode) << ' ' << name(filter);
        }
    }
}

TEST(Reference, CancellingEndsTheWork) {
    const Grid grid = axisAlignedGrid({4, 4, 4});
    const Scene scene =
        test::sceneOf(test::colourfulFunction(), test::orthographicAlong(grid, kAlongY, 4.0), {8, 8});
    ReferenceOptions options;
    options.progress = [](double, std::string_view) { return false; };
    const auto result = referencePicture(scene, {randomVolume(grid, 1)}, options);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
}

TEST(Reference, WrongInputIsNamed) {
    const Grid grid = axisAlignedGrid({4, 4, 4});
    const VolumePtr volume = randomVolume(grid, 1);
    Scene scene =
        test::sceneOf(test::colourfulFunction(), test::orthographicAlong(grid, kAlongY, 4.0), {8, 8});
    EXPECT_EQ(referencePicture(scene, {volume, volume}).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(referencePicture(scene, {}).error().code, ErrorCode::Unsupported);
    EXPECT_EQ(referenceAtStep(scene, {volume}, 0.0).error().code, ErrorCode::InvalidArgument);
    scene.volumes.front().component = 1;
    EXPECT_EQ(referencePicture(scene, {volume}).error().code, ErrorCode::InvalidArgument);
    scene.volumes.front().component = 0;
    scene.camera.fovDeg = 200.0;
    EXPECT_EQ(referencePicture(scene, {volume}).error().code, ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace pellucid::accuracy
