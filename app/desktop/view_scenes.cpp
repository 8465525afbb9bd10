// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/view_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

namespace pellucid::app {

namespace {

// Room around a fitted slice, so that its edge shows.
constexpr double kFitMargin = 1.04;

glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
    return glm::angleAxis(angle, axis) * v;
}

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

// Height in mm that shows the whole volume in an axis-aligned view of this aspect.
double fitHeightMm(const Grid& grid, const ViewAxes& axes, double aspect) {
    const glm::dvec3 centre = centreMm(grid);
    double halfWidth = 0.0, halfHeight = 0.0;
    for (const glm::dvec3& corner : cornersMm(grid)) {
        halfWidth = std::max(halfWidth, std::abs(glm::dot(corner - centre, axes.right)));
        halfHeight = std::max(halfHeight, std::abs(glm::dot(corner - centre, axes.up)));
    }
    return 2.0 * kFitMargin * std::max(halfHeight, halfWidth / aspect);
}

}  // namespace

AnatomicalView viewOf(Plane plane) {
    switch (plane) {
        case Plane::Axial:
            return AnatomicalView::Inferior;
        case Plane::Coronal:
            return AnatomicalView::Anterior;
        case Plane::Sagittal:
            break;
    }
    return AnatomicalView::Left;
}

const char* name(Plane plane) {
    switch (plane) {
        case Plane::Axial:
            return "Axial";
        case Plane::Coronal:
            return "Coronal";
        case Plane::Sagittal:
            break;
    }
    return "Sagittal";
}

Scene sliceScene(const Scene& document, const Grid& grid, Plane plane, glm::dvec3 crosshairMm,
                 const SlicePlacement& placement, glm::ivec2 sizePx) {
    const ViewAxes axes = axesOf(viewOf(plane));
    const double aspect = static_cast<double>(sizePx.x) / sizePx.y;
    const glm::dvec3 centre = centreMm(grid);
    CameraPose pose;
    pose.target = centre + placement.panMm.x * axes.right + placement.panMm.y * axes.up +
                  glm::dot(crosshairMm - centre, axes.forward) * axes.forward;
    pose.eye = pose.target - 2.0 * radiusMm(grid) * axes.forward;
    pose.up = axes.up;
    pose.heightMm = fitHeightMm(grid, axes, aspect);

    Scene scene;
    scene.volumes = document.volumes;
    for (VolumeItem& item : scene.volumes) {
        item.transferFunction = rampFunction(0.0, 1.0, 1.0);
        item.isovalue = 0.0;
    }
    scene.lights.emplace();
    scene.camera.projection = Projection::Orthographic;
    scene.camera.zoom = placement.zoom;
    scene.camera.pose = pose;
    scene.mode = Mode::Slice;
    scene.quality.accumulation = document.quality.accumulation;
    scene.quality.dither = document.quality.dither;
    scene.picture.size = sizePx;
    return scene;
}

Scene volumeScene(const Scene& document, glm::ivec2 sizePx) {
    Scene scene = document;
    scene.picture.size = sizePx;
    scene.picture.transparent = false;
    for (VolumeItem& item : scene.volumes) {
        if (!usesWindow(scene.mode)) item.window = Window{0.0, 1.0};
        if (!usesTransferFunction(scene.mode)) item.transferFunction = rampFunction(0.0, 1.0, 1.0);
        if (scene.mode != Mode::Isosurface) item.isovalue = 0.0;
    }
    if (!usesLights(scene.mode)) {
        scene.lights.emplace();
        scene.material = Material{};
    }
    return scene;
}

glm::dvec2 pictureFromPatient(const RayFrame& frame, glm::dvec3 positionMm) {
    const glm::dvec3 offset = positionMm - frame.eye;
    const double u = glm::dot(offset, frame.right) / glm::dot(frame.right, frame.right);
    const double v = glm::dot(offset, frame.up) / glm::dot(frame.up, frame.up);
    return {(u + 1.0) / 2.0, (1.0 - v) / 2.0};
}

glm::dvec3 patientFromPicture(const RayFrame& frame, glm::dvec2 picture) {
    const double u = 2.0 * picture.x - 1.0, v = 1.0 - 2.0 * picture.y;
    return frame.eye + u * frame.right + v * frame.up + frame.targetDistanceMm * frame.forward;
}

glm::dvec3 nextSliceDirection(Plane plane) {
    switch (plane) {
        case Plane::Axial:
            return {0, 0, 1};
        case Plane::Coronal:
            return {0, -1, 0};
        case Plane::Sagittal:
            break;
    }
    return {-1, 0, 0};
}

SliceRange sliceRange(const Grid& grid, Plane plane) {
    const glm::dvec3 direction = nextSliceDirection(plane);
    SliceRange range;
    double bestCosine = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 column(grid.patientFromIndex[axis]);
        const double cosine = std::abs(glm::dot(glm::normalize(column), direction));
        if (cosine <= bestCosine) continue;
        bestCosine = cosine;
        range.stepMm = std::abs(glm::dot(column, direction));
    }
    double first = std::numeric_limits<double>::max(), last = std::numeric_limits<double>::lowest();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 isUpper(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
        const glm::dvec3 centre = transformPoint(grid.patientFromIndex, isUpper * glm::dvec3(grid.size - 1));
        first = std::min(first, glm::dot(centre, direction));
        last = std::max(last, glm::dot(centre, direction));
    }
    range.firstMm = first;
    // The small addition keeps the last plane when the division rounds down.
    range.count = 1 + static_cast<int>(std::floor((last - first) / range.stepMm + 1e-3));
    return range;
}

int sliceNumber(const Grid& grid, Plane plane, glm::dvec3 positionMm) {
    const SliceRange range = sliceRange(grid, plane);
    const double along = glm::dot(positionMm, nextSliceDirection(plane));
    return static_cast<int>(
        std::clamp(std::round((along - range.firstMm) / range.stepMm), 0.0, range.count - 1.0));
}

bool followsPatientAxes(const Grid& grid) {
    // Over 1000 voxels this lets a slice drift by less than one voxel.
    constexpr double kMaxTilt = 1e-3;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 unit = glm::abs(glm::normalize(glm::dvec3(grid.patientFromIndex[axis])));
        if (std::max({unit.x, unit.y, unit.z}) < std::sqrt(1.0 - kMaxTilt * kMaxTilt)) return false;
    }
    return true;
}

glm::dvec3 allowedCrosshair(const Grid& grid, glm::dvec3 wishMm) {
    if (followsPatientAxes(grid)) {
        const glm::dvec3 index = glm::round(transformPoint(indexFromPatient(grid), wishMm));
        const glm::dvec3 inside = glm::clamp(index, glm::dvec3(0.0), glm::dvec3(grid.size - 1));
        return transformPoint(grid.patientFromIndex, inside);
    }
    glm::dvec3 lo(std::numeric_limits<double>::max()), hi(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& corner : cornersMm(grid)) {
        lo = glm::min(lo, corner);
        hi = glm::max(hi, corner);
    }
    return glm::clamp(wishMm, lo, hi);
}

CameraPose rotated(const CameraPose& pose, double rightward, double upward) {
    const ViewAxes axes = axesOf(pose);
    // The object follows the hand when the eye goes the other way: first about the picture's up, then its
    // right.
    const glm::dvec3 right = turned(axes.right, axes.up, -rightward);
    CameraPose next = pose;
    next.eye = pose.target + turned(turned(pose.eye - pose.target, axes.up, -rightward), right, upward);
    next.up = turned(axes.up, right, upward);
    return next;
}

CameraPose rolled(const CameraPose& pose, double clockwise) {
    const ViewAxes axes = axesOf(pose);
    CameraPose next = pose;
    next.up = turned(axes.up, axes.forward, -clockwise);
    return next;
}

CameraPose panned(const CameraPose& pose, double rightMm, double upMm) {
    const ViewAxes axes = axesOf(pose);
    const glm::dvec3 shift = rightMm * axes.right + upMm * axes.up;
    CameraPose next = pose;
    next.eye += shift;
    next.target += shift;
    return next;
}

CameraPose dollied(const CameraPose& pose, double factor) {
    CameraPose next = pose;
    next.eye = pose.target + factor * (pose.eye - pose.target);
    return next;
}

double visibleHeightMm(const Camera& camera, const CameraPose& pose) {
    const double height =
        camera.projection == Projection::Orthographic
            ? pose.heightMm
            : 2.0 * glm::distance(pose.eye, pose.target) * std::tan(radians(camera.fovDeg) / 2.0);
    return height / camera.zoom;
}

CameraPose editablePose(const Camera& camera, const Grid& grid, double aspect) {
    CameraPose pose = resolvedPose(camera, grid, aspect);
    if (camera.projection == Projection::Perspective)
        pose.heightMm = visibleHeightMm(camera, pose) * camera.zoom;
    return pose;
}

std::string positionText(glm::dvec3 positionMm) {
    return fmt::format("{} {:.1f}  {} {:.1f}  {} {:.1f} mm", positionMm.x < 0 ? 'R' : 'L',
                       std::abs(positionMm.x), positionMm.y < 0 ? 'A' : 'P', std::abs(positionMm.y),
                       positionMm.z < 0 ? 'I' : 'S', std::abs(positionMm.z));
}

std::string sliceText(Plane plane, glm::dvec3 positionMm) {
    switch (plane) {
        case Plane::Axial:
            return fmt::format("{} {:.1f} mm", positionMm.z < 0 ? 'I' : 'S', std::abs(positionMm.z));
        case Plane::Coronal:
            return fmt::format("{} {:.1f} mm", positionMm.y < 0 ? 'A' : 'P', std::abs(positionMm.y));
        case Plane::Sagittal:
            break;
    }
    return fmt::format("{} {:.1f} mm", positionMm.x < 0 ? 'R' : 'L', std::abs(positionMm.x));
}

}  // namespace pellucid::app
