// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/view_scenes.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace pellucid::app {
namespace {

// Positions are of the order of 100 mm and pass through a handful of double operations: 1e-10 is a thousand
// rounding errors.
constexpr double kToleranceMm = 1e-10;

Grid testGrid() {
    return axisAlignedGrid({24, 20, 16}, {2, 3, 4}, {-20, -30, -40});
}

Scene document() {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().window = Window{40, 400};
    return scene;
}

TEST(SliceScene, ShowsThePlaneThroughTheCrosshairInTheRadiologicalConvention) {
    const glm::dvec3 crosshair(4, 6, -8);
    const struct {
        Plane plane;
        EdgeLetters letters;
    } cases[] = {{Plane::Axial, {"R", "L", "A", "P"}},
                 {Plane::Coronal, {"R", "L", "S", "I"}},
                 {Plane::Sagittal, {"A", "P", "S", "I"}}};
    for (const auto& [plane, letters] : cases) {
        SCOPED_TRACE(name(plane));
        const Scene scene = sliceScene(document(), testGrid(), plane, crosshair, {}, {300, 200});
        ASSERT_TRUE(scene.camera.pose);
        EXPECT_EQ(edgeLetters(*scene.camera.pose), letters);
        EXPECT_EQ(scene.mode, Mode::Slice);
        const glm::dvec3 forward = axesOf(viewOf(plane)).forward;
        EXPECT_NEAR(glm::dot(scene.camera.pose->target - crosshair, forward), 0.0, kToleranceMm);
        EXPECT_TRUE(validate(scene)) << validate(scene).error().text();
    }
}

TEST(SliceScene, FitsTheVolumeWithALittleRoom) {
    // Axial, 48 x 60 mm (voxels times spacing): in a square picture the taller side decides.
    const Scene square = sliceScene(document(), testGrid(), Plane::Axial, {}, {}, {100, 100});
    EXPECT_NEAR(square.camera.pose->heightMm, 60.0 * 1.04, kToleranceMm);
    // In a picture a quarter as wide as high, the width of 48 mm does.
    const Scene narrow = sliceScene(document(), testGrid(), Plane::Axial, {}, {}, {100, 400});
    EXPECT_NEAR(narrow.camera.pose->heightMm, 4.0 * 48.0 * 1.04, kToleranceMm);
}

TEST(SliceScene, PicturePositionsAndPatientPositionsAreInverse) {
    const Scene scene =
        sliceScene(document(), testGrid(), Plane::Sagittal, {4, 6, -8}, {2.5, {3.0, -5.0}}, {320, 200});
    const RayFrame frame = rayFrame(scene.camera, testGrid(), {320, 200});
    const glm::dvec2 picture(0.3, 0.8);
    const glm::dvec3 patient = patientFromPicture(frame, picture);
    EXPECT_NEAR(patient.x, 4.0, kToleranceMm);
    EXPECT_NEAR(glm::distance(pictureFromPatient(frame, patient), picture), 0.0, 1e-12);
}

TEST(SliceScene, DependsOnNothingThatASliceDoesNotShow) {
    Scene other = document();
    other.densityScale = 3.0;
    other.material.ambient = 0.7;
    other.volumes.front().transferFunction = rampFunction(0, 5, 0.1);
    other.camera.view = AnatomicalView::Left;
    const auto slice = [](const Scene& scene) {
        return sliceScene(scene, testGrid(), Plane::Axial, {}, {}, {64, 64});
    };
    EXPECT_EQ(slice(other), slice(document()));
    other.volumes.front().window = Window{41, 400};
    EXPECT_NE(slice(other), slice(document()));
}

TEST(VolumeScene, AWindowMattersOnlyToTheModesThatUseIt) {
    Scene a = document(), b = document();
    b.volumes.front().window = Window{0, 80};
    EXPECT_EQ(volumeScene(a, {64, 64}), volumeScene(b, {64, 64}));
    a.mode = b.mode = Mode::Mip;
    EXPECT_NE(volumeScene(a, {64, 64}), volumeScene(b, {64, 64}));
}

TEST(Slices, AreTheVoxelPlanesOfAnAlignedGridCountedUpwardsForwardsAndRightwards) {
    const Grid grid = testGrid();
    EXPECT_EQ(sliceRange(grid, Plane::Axial).count, 16);
    EXPECT_EQ(sliceRange(grid, Plane::Coronal).count, 20);
    EXPECT_EQ(sliceRange(grid, Plane::Sagittal).count, 24);
    EXPECT_DOUBLE_EQ(sliceRange(grid, Plane::Coronal).stepMm, 3.0);
    const auto centre = [&](glm::dvec3 index) { return transformPoint(grid.patientFromIndex, index); };
    EXPECT_EQ(sliceNumber(grid, Plane::Axial, centre({0, 0, 5})), 5);
    EXPECT_EQ(sliceNumber(grid, Plane::Coronal, centre({0, 5, 0})), 20 - 1 - 5);
    EXPECT_EQ(sliceNumber(grid, Plane::Sagittal, centre({5, 0, 0})), 24 - 1 - 5);
}

TEST(Crosshair, SnapsToVoxelCentresOfAnAlignedGridAndStaysInside) {
    const Grid grid = testGrid();
    EXPECT_TRUE(followsPatientAxes(grid));
    EXPECT_EQ(allowedCrosshair(grid, {-19.2, -28.6, -38.1}), glm::dvec3(-20, -30, -40));
    EXPECT_EQ(allowedCrosshair(grid, {1e6, 1e6, 1e6}), glm::dvec3(-20 + 23 * 2, -30 + 19 * 3, -40 + 15 * 4));
}

TEST(Crosshair, IsFreeOnAnObliqueGrid) {
    Grid grid = testGrid();
    grid.patientFromIndex = glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(1, 0, 0)) * grid.patientFromIndex;
    EXPECT_FALSE(followsPatientAxes(grid));
    const glm::dvec3 wish = centreMm(grid) + glm::dvec3(0.1, 0.2, 0.3);
    EXPECT_EQ(allowedCrosshair(grid, wish), wish);
}

TEST(CameraMoves, TheObjectFollowsTheHand) {
    const CameraPose front = framingPose(Camera{}, testGrid(), 1.0);
    const glm::dvec3 toEye = glm::normalize(front.eye - front.target);
    ASSERT_NEAR(toEye.y, -1.0, 1e-12);  // In front of the patient.
    // A quarter turn to the right brings the patient's right side to the front (the picture's left is the
    // patient's right).
    const CameraPose turned = rotated(front, std::numbers::pi / 2, 0.0);
    EXPECT_NEAR(glm::normalize(turned.eye - turned.target).x, -1.0, 1e-12);
    // A quarter turn upwards shows the patient from below.
    const CameraPose lifted = rotated(front, 0.0, std::numbers::pi / 2);
    EXPECT_NEAR(glm::normalize(lifted.eye - lifted.target).z, -1.0, 1e-12);
    EXPECT_EQ(edgeLetters(lifted).top, "A");
    // A quarter turn clockwise brings the top to the right.
    const CameraPose rolledPose = rolled(front, std::numbers::pi / 2);
    EXPECT_EQ(edgeLetters(rolledPose).right, "S");
    EXPECT_EQ(dollied(front, 0.5).target, front.target);
    EXPECT_NEAR(glm::distance(dollied(front, 0.5).eye, front.target),
                glm::distance(front.eye, front.target) / 2, 1e-9);
}

TEST(CameraMoves, AChangeOfProjectionKeepsTheSizeOfTheTargetPlane) {
    Camera camera;
    camera.zoom = 1.5;
    camera.pose = editablePose(camera, testGrid(), 1.2);
    const double before = visibleHeightMm(camera, *camera.pose);
    camera.projection = Projection::Orthographic;
    EXPECT_NEAR(visibleHeightMm(camera, *camera.pose), before, 1e-9);
}

TEST(Text, NamesSidesInsteadOfSigns) {
    EXPECT_EQ(positionText({-17.6, 35.3, 12.1}), "R 17.6  P 35.3  S 12.1 mm");
    EXPECT_EQ(positionText({17.6, -35.3, -12.1}), "L 17.6  A 35.3  I 12.1 mm");
    EXPECT_EQ(sliceText(Plane::Coronal, {1, -35.3, 2}), "A 35.3 mm");
}

}  // namespace
}  // namespace pellucid::app
