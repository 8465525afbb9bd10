// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/camera.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <algorithm>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "scene/names.h"

namespace pellucid {
namespace {

using testing::HasSubstr;

const AnatomicalView kViews[] = {AnatomicalView::Anterior, AnatomicalView::Posterior,
                                 AnatomicalView::Left,     AnatomicalView::Right,
                                 AnatomicalView::Superior, AnatomicalView::Inferior};

void expectNear(glm::dvec3 found, glm::dvec3 expected, double tolerance = 1e-14) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], tolerance);
}

Grid obliqueGrid() {
    Grid grid;
    grid.size = {100, 80, 30};
    grid.patientFromIndex = glm::translate(glm::dmat4(1.0), {-300, 200, 1000}) *
                            glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(1, -1, 2))) *
                            glm::scale(glm::dmat4(1.0), {0.5, 0.5, 2.0});
    return grid;
}

TEST(Camera, TheSixViewsHaveTheAxesOfTheTable) {
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const struct {
        AnatomicalView view;
        glm::dvec3 right, up, forward;
        EdgeLetters letters;
    } cases[] = {{AnatomicalView::Anterior, x, z, y, {"R", "L", "S", "I"}},
                 {AnatomicalView::Posterior, -x, z, -y, {"L", "R", "S", "I"}},
                 {AnatomicalView::Left, y, z, -x, {"A", "P", "S", "I"}},
                 {AnatomicalView::Right, -y, z, x, {"P", "A", "S", "I"}},
                 {AnatomicalView::Superior, -x, -y, -z, {"L", "R", "A", "P"}},
                 {AnatomicalView::Inferior, x, -y, z, {"R", "L", "A", "P"}}};
    for (const auto& test : cases) {
        SCOPED_TRACE(name(test.view));
        const ViewAxes axes = axesOf(test.view);
        expectNear(axes.right, test.right);
        expectNear(axes.up, test.up);
        expectNear(axes.forward, test.forward);
        expectNear(axes.right, glm::cross(axes.forward, axes.up));
        Camera camera;
        camera.view = test.view;
        const CameraPose pose = framingPose(camera, obliqueGrid(), 1.5);
        expectNear(axesOf(pose).right, test.right, 1e-12);
        EXPECT_EQ(edgeLetters(pose), test.letters);
    }
}

/// Picture coordinates of a point; u and v beyond [-1, 1] are outside.
glm::dvec2 project(const RayFrame& frame, glm::dvec3 point) {
    const glm::dvec3 offset = point - frame.eye;
    const double depth = frame.projection == Projection::Perspective ? glm::dot(offset, frame.forward) : 1.0;
    return {glm::dot(offset, frame.right) / glm::dot(frame.right, frame.right) / depth,
            glm::dot(offset, frame.up) / glm::dot(frame.up, frame.up) / depth};
}

TEST(Camera, FramingFitsTheCornersWithAMargin) {
    for (const AnatomicalView view : kViews) {
        for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
            for (const glm::ivec2 size : {glm::ivec2{512, 512}, {1920, 400}, {300, 1600}, {1, 16384}}) {
                for (const double fov : {1.0, 30.0, 90.0, 170.0}) {
                    SCOPED_TRACE(
                        fmt::format("{} {} {}x{} {} deg", name(view), name(projection), size.x, size.y, fov));
                    Camera camera;
                    camera.view = view;
                    camera.projection = projection;
                    camera.fovDeg = fov;
                    const Grid grid = obliqueGrid();
                    const RayFrame frame = rayFrame(camera, grid, size);
                    double furthestOut = 0.0;
                    for (const glm::dvec3& corner : cornersMm(grid)) {
                        EXPECT_GT(glm::dot(corner - frame.eye, frame.forward), 0.0);
                        const glm::dvec2 at = project(frame, corner);
                        furthestOut = std::max({furthestOut, std::abs(at.x), std::abs(at.y)});
                    }
                    EXPECT_NEAR(glm::length(frame.right) / glm::length(frame.up),
                                static_cast<double>(size.x) / size.y, 1e-9 * size.x);
                    expectNear(frame.eye + frame.targetDistanceMm * frame.forward, centreMm(grid), 1e-6);
                    // Nothing is cut off and nothing wasted: the outermost corner leaves the stated margin of
                    // 5 %.
                    EXPECT_NEAR(furthestOut, 1.0 / 1.05, 1e-9);
                }
            }
        }
    }
}

TEST(Camera, ZoomTwoShowsHalfTheWidthOfViewsAndPoses) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        Camera camera;
        camera.projection = projection;
        for (int posed = 0; posed < 2; ++posed) {
            camera.zoom = 1.0;
            const RayFrame one = rayFrame(camera, obliqueGrid(), {640, 480});
            camera.zoom = 2.0;
            const RayFrame two = rayFrame(camera, obliqueGrid(), {640, 480});
            expectNear(two.right * 2.0, one.right, 1e-12 * glm::length(one.right));
            expectNear(two.up * 2.0, one.up, 1e-12 * glm::length(one.up));
            expectNear(two.eye, one.eye, 0.0);
            camera.pose = framingPose(camera, obliqueGrid(), 1.0);
        }
    }
}

TEST(Camera, APoseIsUsedAsItIs) {
    Camera camera;
    camera.fovDeg = 90.0;
    camera.nearMm = 7.0;
    camera.pose = CameraPose{{10, 0, 0}, {0, 0, 0}, {0, 0, 5}, 40.0};
    RayFrame frame = rayFrame(camera, obliqueGrid(), {200, 100});
    expectNear(frame.eye, {10, 0, 0});
    expectNear(frame.forward, {-1, 0, 0});
    expectNear(frame.right, {0, 2, 0});  // Tangent of 45 degrees times the aspect.
    expectNear(frame.up, {0, 0, 1});
    EXPECT_EQ(frame.nearMm, 7.0);
    EXPECT_EQ(frame.targetDistanceMm, 10.0);
    camera.projection = Projection::Orthographic;
    frame = rayFrame(camera, obliqueGrid(), {200, 100});
    expectNear(frame.right, {0, 40, 0});
    expectNear(frame.up, {0, 0, 20});
    EXPECT_EQ(resolvedPose(camera, obliqueGrid(), 2.0), *camera.pose);
}

TEST(Camera, ObliqueLettersGoByDominance) {
    const CameraPose pose{{0, 0, 0}, {-0.6, 0.8, 0}, {0, 0, 1}, 1.0};
    // right = forward x up = (0.8, 0.6, 0): left, then posterior.
    EXPECT_EQ(edgeLetters(pose), (EdgeLetters{"RA", "LP", "S", "I"}));
}

TEST(Camera, ExtremeButValidCamerasGiveFiniteFrames) {
    const struct {
        const char* name;
        Grid grid;
        double fovDeg;
        double zoom;
    } cases[] = {
        {"tiny angle", obliqueGrid(), 1e-300, 1.0},
        {"angle near 180", obliqueGrid(), std::nextafter(180.0, 0.0), 1.0},
        {"one tiny voxel", axisAlignedGrid({1, 1, 1}, {1e-9, 1e-9, 1e-9}, {1e4, 1e4, 1e4}), 30.0, 1.0},
        {"spacing 1:1000", axisAlignedGrid({10, 10, 10}, {1e-3, 1.0, 1.0}), 30.0, 1.0},
        {"zoom 1e6", obliqueGrid(), 30.0, 1e6}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        Camera camera;
        camera.fovDeg = test.fovDeg;
        camera.zoom = test.zoom;
        ASSERT_TRUE(validate(camera));
        const RayFrame frame = rayFrame(camera, test.grid, {64, 64});
        for (const glm::dvec3 v : {frame.eye, frame.right, frame.up, frame.forward})
            for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(v[axis]));
        EXPECT_NEAR(glm::length(frame.forward), 1.0, 1e-12);
    }
}

TEST(Camera, InvalidCamerasAreRefusedWithTheMember) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    const auto with = [](auto change) {
        Camera camera;
        change(camera);
        return camera;
    };
    const auto posed = [](CameraPose pose) {
        Camera camera;
        camera.pose = pose;
        return camera;
    };
    const struct {
        const char* name;
        Camera camera;
        const char* message;
    } cases[] = {{"angle 0", with([](Camera& c) { c.fovDeg = 0; }),
                  "/fovDeg: found 0, allowed is a number in (0, 180)"},
                 {"angle 180", with([](Camera& c) { c.fovDeg = 180; }), "/fovDeg: found 180"},
                 {"angle NaN", with([=](Camera& c) { c.fovDeg = nan; }), "/fovDeg: found nan"},
                 {"zoom 0", with([](Camera& c) { c.zoom = 0; }), "/zoom: found 0"},
                 {"zoom infinite", with([=](Camera& c) { c.zoom = inf; }), "/zoom: found inf"},
                 {"near negative", with([](Camera& c) { c.nearMm = -1; }), "/nearMm: found -1"},
                 {"eye NaN", posed({{nan, 0, 0}, {0, 0, 0}, {0, 0, 1}, 1}), "/pose/eye"},
                 {"target infinite", posed({{0, 0, 0}, {inf, 0, 0}, {0, 0, 1}, 1}), "/pose/target"},
                 {"up NaN", posed({{0, 0, 0}, {1, 0, 0}, {0, nan, 1}, 1}), "/pose/up"},
                 {"eye at the target", posed({{1, 2, 3}, {1, 2, 3}, {0, 0, 1}, 1}), "/pose/target"},
                 {"distance overflows", posed({{-1e308, 0, 0}, {1e308, 0, 0}, {0, 0, 1}, 1}), "/pose/target"},
                 {"up zero", posed({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, 1}), "/pose/up"},
                 {"up along the view", posed({{0, 0, 0}, {0, 0, 3}, {0, 0, -1}, 1}), "/pose/up"},
                 {"height 0", posed({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0}), "/pose/heightMm: found 0"}};
    for (const auto& test : cases) {
        SCOPED_TRACE(test.name);
        const auto result = validate(test.camera);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(result.error().message, HasSubstr(test.message));
    }
    EXPECT_TRUE(validate(posed({{1e150, 0, 0}, {-1e150, 1, 0}, {0, 0, 1e-150}, 1})));
}

}  // namespace
}  // namespace pellucid
