// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Clips of the reference: planes and spheres against closed forms. Tolerances of 1e-9 and below are those of
// the quadrature (accuracy/smooth_piece.h) and of roots of spheres in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "accuracy/ray_integrator.h"
#include "accuracy/reference.h"
#include "tests/accuracy/scenes.h"

namespace pellucid::accuracy {
namespace {

constexpr glm::dvec3 kOrange(0.9, 0.5, 0.1);
constexpr glm::dvec3 kAlongY(0.0, 1.0, 0.0);
constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

/// Keeps the side the normal points to.
RayClip keptByPlane(glm::dvec3 point, glm::dvec3 normal) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction, const Interval& inside) {
        const double slope = glm::dot(normal, direction);
        const double t = glm::dot(normal, point - origin) / slope;
        Interval kept = inside;
        (slope > 0.0 ? kept.from : kept.to) = t;
        return std::vector<Interval>{kept};
    };
}

/// Where a ray is in a sphere; from > to where it passes by.
Interval throughSphere(glm::dvec3 centre, double radius, const glm::dvec3& origin,
                       const glm::dvec3& direction) {
    const double middle = glm::dot(centre - origin, direction);
    const glm::dvec3 aside = origin + middle * direction - centre;
    const double square = radius * radius - glm::dot(aside, aside);
    if (!(square > 0.0)) return {1.0, 0.0};
    return {middle - std::sqrt(square), middle + std::sqrt(square)};
}

/// Takes a sphere away: two intervals of a ray that meets it.
RayClip withoutSphere(glm::dvec3 centre, double radius) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction, const Interval& inside) {
        const Interval hole = throughSphere(centre, radius, origin, direction);
        if (!(hole.from < hole.to)) return std::vector<Interval>{inside};
        return std::vector<Interval>{{inside.from, hole.from}, {hole.to, inside.to}};
    };
}

RayIntegrator clipped(const Scene& scene, const VolumePtr& volume, RayClip clip) {
    return RayIntegrator(completed(scene, {volume}), *volume, 0.0, std::move(clip));
}

void expectColor(const glm::dvec4& found, const glm::dvec3& expected, double tolerance) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], expected[channel], tolerance) << channel;
}

TEST(ReferenceClip, APlaneLeavesTheRestOfAConstantMedium) {
    const Grid grid = axisAlignedGrid({6, 9, 5}, {1.0, 0.7, 1.3}, {900.0, -1200.0, 40.0});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    const glm::dvec3 point = centreMm(grid) + glm::dvec3(0.4, 0.3, -0.2);
    for (const glm::dvec3 forward : {kAlongY, kOblique})
        for (const double side : {1.0, -1.0}) {
            Scene scene = test::rayScene(test::constantFunction(kOrange, 0.7), grid, forward);
            scene.picture.background = {0.2, 0.4, 0.6};
            const glm::dvec3 normal = side * glm::dvec3(0.3, 1.0, 0.5);
            const RayIntegrator whole = clipped(scene, volume, {});
            const ViewRay ray = whole.rayAt(0.0, 0.0);
            const double cut =
                glm::dot(normal, point - centreMm(grid) - ray.originMm) / glm::dot(normal, ray.direction);
            const double length = side > 0.0 ? ray.inside->to - cut : cut - ray.inside->from;
            const double t = std::exp(-0.7 * length);
            const glm::dvec4 found = clipped(scene, volume, keptByPlane(point, normal)).pixel(0.0, 0.0, 0.3);
            expectColor(found, kOrange * (1.0 - t) + t * scene.picture.background, 1e-12);
            EXPECT_NEAR(found.a, 1.0 - t, 1e-12);
        }
}

/// kappa = k (a + b s) with s from the first voxel centre: its integral is k (a s + b s^2 / 2). The sphere
/// lies in the linear part, and a colour that is constant shows as c (1 - T).
TEST(ReferenceClip, ASphereLeavesTwoPartsOfALinearMedium) {
    const Grid grid = axisAlignedGrid({7, 14, 7});
    const double a = 0.125, b = 0.0625, k = 0.8;
    const VolumePtr volume = test::rampVolume(grid, a, b);
    const Scene scene = test::rayScene(test::linearExtinction(kOrange, k), grid, kAlongY);
    for (const double aside : {0.0, 0.9, 1.9, 2.1}) {
        const glm::dvec3 centre = centreMm(grid) + glm::dvec3(aside, 0.7, 0.0);
        const RayIntegrator integrator = clipped(scene, volume, withoutSphere(centre, 2.0));
        const double half = aside < 2.0 ? std::sqrt(4.0 - aside * aside) : 0.0;
        const auto upTo = [&](double s) { return k * (a * s + b * s * s / 2.0); };
        const double last = 13.0;
        const double whole = upTo(last) + k * (0.5 * a + 0.5 * (a + b * last));  // constant half voxels
        const double middle = 6.5 + 0.7;
        const double depth = whole - (upTo(middle + half) - upTo(middle - half));
        const glm::dvec4 found = integrator.pixel(0.0, 0.0, 0.37);
        EXPECT_NEAR(found.a, -std::expm1(-depth), 1e-12) << aside;
        expectColor(found, kOrange * -std::expm1(-depth), 1e-12);
        EXPECT_EQ(integrator.rayAt(0.0, 0.0).visible.size(), aside < 2.0 ? 2u : 1u);
    }
}

/// Colour c1 s / L under constant extinction k over [p, q]: c1 / L (F(q) - F(p)) with
/// F(s) = -exp(-k (s - p)) (s + 1 / k); the second part is seen through the first.
TEST(ReferenceClip, PartsAreSeenThroughThoseInFrontOfThem) {
    const Grid grid = axisAlignedGrid({5, 9, 5});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 0.125);
    for (const double k : {0.01, 0.7, 30.0}) {
        const TransferFunction1D function{"", "", {{0.0, {0.0, 0.0, 0.0}, k}, {1.0, {1.0, 0.5, 0.0}, k}}};
        const Scene scene = test::rayScene(function, grid, kAlongY);
        const ViewRay ray = clipped(scene, volume, {}).rayAt(0.0, 0.0);
        const double first = ray.inside->from + 0.5;  // the voxel centre where the colour is 0
        const std::vector<Interval> parts{{1.0, 2.5}, {3.25, 4.0}, {6.0, 8.0}};
        const auto clip = [&](const glm::dvec3&, const glm::dvec3&, const Interval&) {
            std::vector<Interval> visible;
            for (const Interval& part : parts) visible.push_back({first + part.from, first + part.to});
            return visible;
        };
        double red = 0.0, before = 0.0;
        for (const Interval& part : parts) {
            const auto f = [&](double s) { return -std::exp(-k * (s - part.from)) * (s + 1.0 / k); };
            red += std::exp(-before) * (f(part.to) - f(part.from)) / 8.0;
            before += k * (part.to - part.from);
        }
        const glm::dvec4 found = clipped(scene, volume, clip).pixel(0.0, 0.0, 1.0);
        expectColor(found, {red, red / 2.0, 0.0}, 1e-9);
        EXPECT_NEAR(found.a, -std::expm1(-before), 1e-12);
    }
}

/// A ramp of values along the ray, 0 at the first voxel centre and 1 at the last, of which [2, 3] and
/// [5, 6.5] of 8 mm are left.
TEST(ReferenceClip, EveryProjectionSeesWhatIsLeft) {
    const Grid grid = axisAlignedGrid({5, 9, 5});
    const VolumePtr volume = test::rampVolume(grid, 0.0, 0.125);
    Scene scene = test::rayScene(test::linearExtinction(kOrange, 0.4), grid, kAlongY);
    const double first = clipped(scene, volume, {}).rayAt(0.0, 0.0).inside->from + 0.5;
    const RayClip clip = [&](const glm::dvec3&, const glm::dvec3&, const Interval&) {
        return std::vector<Interval>{{first + 2.0, first + 3.0}, {first + 5.0, first + 6.5}};
    };
    const auto drawn = [&](Mode mode) {
        scene.mode = mode;
        return clipped(scene, volume, clip).pixel(0.0, 0.0, 0.25);
    };
    const double depth = 0.4 * 0.125 * 0.5 * (9.0 - 4.0 + 42.25 - 25.0);
    EXPECT_NEAR(drawn(Mode::Mip).r, 6.5 / 8.0, 1e-12);
    EXPECT_NEAR(drawn(Mode::MinIp).r, 2.0 / 8.0, 1e-12);
    EXPECT_NEAR(drawn(Mode::Average).r, 0.125 * 0.5 * (9.0 - 4.0 + 42.25 - 25.0) / 2.5, 1e-12);
    EXPECT_NEAR(drawn(Mode::XRay).r, -std::expm1(-depth), 1e-12);
    expectColor(drawn(Mode::Emission), kOrange * depth, 1e-12);
    // The middle of the volume, where the slice lies, is 4 mm from there.
    EXPECT_EQ(drawn(Mode::Slice).a, 0.0);
    // The isovalue is reached in the part taken away: the surface is the cut itself.
    scene.volumes.front().isovalue = 0.5;
    EXPECT_EQ(drawn(Mode::Isosurface).a, 1.0);
    scene.volumes.front().isovalue = 6.75 / 8.0;
    EXPECT_EQ(drawn(Mode::Isosurface).a, 0.0);
    scene.hitOpacity = opacityFromExtinction(0.4 * 0.125 * 6.75);
    EXPECT_EQ(drawn(Mode::FirstHit).a, 0.0);
    // Of several surfaces only those crossed where something is left.
    scene.volumes.front().isosurfaces = {{2.5 / 8.0, kOrange, 0.5}, {0.5, {0, 0, 1}, 0.5}};
    expectColor(drawn(Mode::Isosurface), 0.5 * kOrange, 1e-12);
}

/// Nothing left is nothing seen; parts reaching beyond the volume end with it.
TEST(ReferenceClip, EndsWithTheVolumeAndMayLeaveNothing) {
    const Grid grid = axisAlignedGrid({4, 6, 4});
    const VolumePtr volume = test::constantVolume(grid, 0.5);
    Scene scene = test::sceneOf(test::constantFunction(kOrange, 0.3),
                                test::orthographicAlong(grid, kAlongY, 3.0), {4, 4});
    ReferenceOptions options;
    options.clip = [](const glm::dvec3&, const glm::dvec3&, const Interval&) {
        return std::vector<Interval>{};
    };
    for (const Mode mode : test::allModes()) {
        scene.mode = mode;
        const auto reference = referencePicture(scene, {volume}, options);
        ASSERT_TRUE(reference);
        // An X-ray is opaque everywhere; its opacity is what it shows.
        const glm::vec4 seen = reference->image.at(2, 2);
        EXPECT_EQ(mode == Mode::XRay ? seen.r : seen.a, 0.0f) << name(mode);
    }
    scene.mode = Mode::Composite;
    options.clip = [](const glm::dvec3&, const glm::dvec3&, const Interval&) {
        return std::vector<Interval>{{-1e6, 1e6}};
    };
    EXPECT_EQ(referencePicture(scene, {volume}, options)->image.pixels,
              referencePicture(scene, {volume})->image.pixels);
}

}  // namespace
}  // namespace pellucid::accuracy
