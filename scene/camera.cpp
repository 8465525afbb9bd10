// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/check.h"

namespace pellucid {

namespace {

/// Unit vector without overflow or underflow of squares; not finite for a zero or infinite vector.
glm::dvec3 unitVector(glm::dvec3 v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::normalize(v / largest);
}

bool isFinite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

ViewAxes axesFrom(glm::dvec3 forward, glm::dvec3 up) {
    ViewAxes axes;
    axes.forward = unitVector(forward);
    axes.right = unitVector(glm::cross(axes.forward, unitVector(up)));
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

/// Half the height of the picture: a tangent (perspective) or mm (orthographic).
double halfHeight(const Camera& camera, const CameraPose& pose) {
    const double full = camera.projection == Projection::Perspective
                            ? std::tan(glm::radians(camera.fovDeg) / 2.0)
                            : pose.heightMm / 2.0;
    return full / camera.zoom;
}

Result<void> validatePose(const CameraPose& pose) {
    const auto refuse = [](const char* member, const std::string& what) {
        return fail(ErrorCode::InvalidArgument, fmt::format("/pose/{}: {}", member, what));
    };
    if (!isFinite(pose.eye)) return refuse("eye", "allowed are finite numbers");
    if (!isFinite(pose.target)) return refuse("target", "allowed are finite numbers");
    if (!isFinite(pose.up)) return refuse("up", "allowed are finite numbers");
    if (!(pose.heightMm > 0.0) || !std::isfinite(pose.heightMm))
        return refuse("heightMm", fmt::format("found {}, allowed is a finite number above 0", pose.heightMm));
    const glm::dvec3 forward = pose.target - pose.eye;
    if (forward == glm::dvec3(0.0))
        return refuse("target", "found the place of the eye, allowed is any other");
    if (!std::isfinite(std::hypot(forward.x, forward.y, forward.z)))
        return refuse("target", "it is too far from the eye for the distance to be a number");
    if (pose.up == glm::dvec3(0.0))
        return refuse("up", "found [0, 0, 0], allowed is any direction not along the view");
    // Below this sine the cross product has no correct digits left for a steady picture.
    const glm::dvec3 across = glm::cross(unitVector(forward), unitVector(pose.up));
    if (!(glm::length(across) > 1e-9))
        return refuse("up",
                      "found the direction of view itself, allowed is any direction not along the view");
    return {};
}

}  // namespace

ViewAxes axesOf(AnatomicalView view) {
    switch (view) {
        case AnatomicalView::Anterior:
            return axesFrom({0, 1, 0}, {0, 0, 1});
        case AnatomicalView::Posterior:
            return axesFrom({0, -1, 0}, {0, 0, 1});
        case AnatomicalView::Left:
            return axesFrom({-1, 0, 0}, {0, 0, 1});
        case AnatomicalView::Right:
            return axesFrom({1, 0, 0}, {0, 0, 1});
        case AnatomicalView::Superior:
            return axesFrom({0, 0, -1}, {0, -1, 0});
        case AnatomicalView::Inferior:
            break;
    }
    return axesFrom({0, 0, 1}, {0, -1, 0});
}

ViewAxes axesOf(const CameraPose& pose) {
    return axesFrom(pose.target - pose.eye, pose.up);
}

CameraPose framingPose(const Camera& camera, const Grid& grid, double aspect) {
    PELLUCID_CHECK(aspect > 0.0);
    // Room between the volume and the picture's edge, as a part of the half picture.
    constexpr double kMargin = 1.05;
    const ViewAxes axes = axesOf(camera.view);
    // Angles below this would put the eye where its distance to the volume is no longer a number of mm.
    const double tangentUp = std::max(std::tan(glm::radians(camera.fovDeg) / 2.0), 1e-9);
    double distance = 0.0;
    double halfHeightMm = 0.0;
    for (const glm::dvec3& corner : cornersMm(grid)) {
        const glm::dvec3 offset = corner - centreMm(grid);
        const double up = kMargin * std::max(std::abs(glm::dot(offset, axes.up)),
                                             std::abs(glm::dot(offset, axes.right)) / aspect);
        halfHeightMm = std::max(halfHeightMm, up);
        distance = std::max(distance, up / tangentUp - glm::dot(offset, axes.forward));
    }
    // Orthographic: anywhere outside the volume shows the same.
    if (camera.projection == Projection::Orthographic) distance = 2.0 * radiusMm(grid);
    CameraPose pose;
    pose.target = centreMm(grid);
    pose.eye = pose.target - distance * axes.forward;
    pose.up = axes.up;
    pose.heightMm = 2.0 * halfHeightMm;
    return pose;
}

CameraPose resolvedPose(const Camera& camera, const Grid& grid, double aspect) {
    return camera.pose ? *camera.pose : framingPose(camera, grid, aspect);
}

RayFrame rayFrame(const Camera& camera, const Grid& grid, glm::ivec2 sizePx) {
    PELLUCID_CHECK(sizePx.x > 0 && sizePx.y > 0);
    const double aspect = static_cast<double>(sizePx.x) / sizePx.y;
    const CameraPose pose = resolvedPose(camera, grid, aspect);
    const ViewAxes axes = axesOf(pose);
    const double half = halfHeight(camera, pose);
    RayFrame frame;
    frame.eye = pose.eye;
    frame.right = axes.right * (half * aspect);
    frame.up = axes.up * half;
    frame.forward = axes.forward;
    frame.projection = camera.projection;
    frame.nearMm = camera.nearMm;
    frame.targetDistanceMm = glm::dot(pose.target - pose.eye, axes.forward);
    return frame;
}

Result<void> validate(const Camera& camera) {
    const auto refuse = [](const char* member, double found, const char* allowed) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("/{}: found {}, allowed is {}", member, found, allowed));
    };
    if (!(camera.fovDeg > 0.0 && camera.fovDeg < 180.0))
        return refuse("fovDeg", camera.fovDeg, "a number in (0, 180)");
    if (!(camera.zoom > 0.0) || !std::isfinite(camera.zoom))
        return refuse("zoom", camera.zoom, "a finite number above 0");
    if (!(camera.nearMm >= 0.0) || !std::isfinite(camera.nearMm))
        return refuse("nearMm", camera.nearMm, "a finite number >= 0");
    return camera.pose ? validatePose(*camera.pose) : Result<void>{};
}

EdgeLetters edgeLetters(const CameraPose& pose) {
    const ViewAxes axes = axesOf(pose);
    return {orientationLetters(-axes.right), orientationLetters(axes.right), orientationLetters(axes.up),
            orientationLetters(-axes.up)};
}

}  // namespace pellucid
