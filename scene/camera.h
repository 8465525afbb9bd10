// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "scene/grid.h"
#include "scene/result.h"

namespace pellucid {

enum class Projection { Perspective, Orthographic };

/// Where the viewer stands: Anterior is in front of the patient, Superior above the head. ViewAxes lists the
/// exact axes.
enum class AnatomicalView { Anterior, Posterior, Left, Right, Superior, Inferior };

/// A camera placed in the patient frame, mm.
struct CameraPose {
    glm::dvec3 eye{0.0, -1.0, 0.0};
    glm::dvec3 target{0.0};        ///< Differs from eye.
    glm::dvec3 up{0.0, 0.0, 1.0};  ///< Not parallel to target - eye; need not be perpendicular or normalised.
    double heightMm = 1.0;         ///< Orthographic only: height of the picture at the target, > 0.
    bool operator==(const CameraPose&) const = default;
};

/// The camera of a scene. Without a pose it is an anatomical view that frames the volume, so that a scene
/// stays short.
struct Camera {
    Projection projection = Projection::Perspective;
    double fovDeg = 30.0;  ///< Perspective: full vertical angle, in (0, 180).
    AnatomicalView view = AnatomicalView::Anterior;
    double zoom = 1.0;               ///< > 0; 2 shows half the width. Applies to view and pose alike.
    double nearMm = 0.0;             ///< Rays start at least this far in front of the eye plane, >= 0.
    std::optional<CameraPose> pose;  ///< When set, `view` is not used.
    bool operator==(const Camera&) const = default;
};

/// Unit axes of a view in the patient frame: right and up of the picture, forward into it.
/// Anterior: forward +y, up +z. Posterior: -y, +z. Left: seen from the patient's left, forward -x, up +z.
/// Right: +x, +z. Superior: seen from the head, forward -z, up -y (anterior up; the patient's left on the
/// left of the picture). Inferior: seen from the feet as in axial slices, forward +z, up -y (anterior up; the
/// patient's left on the right).
struct ViewAxes {
    glm::dvec3 right{1, 0, 0};
    glm::dvec3 up{0, 1, 0};
    glm::dvec3 forward{0, 0, -1};
};
[[nodiscard]] ViewAxes axesOf(AnatomicalView view);
[[nodiscard]] ViewAxes axesOf(const CameraPose& pose);

/// The pose that just fits the whole volume, up to its corners, into a picture at zoom 1 of this aspect
/// (width / height > 0), seen along camera.view; the target is the volume's centre, and heightMm frames it
/// too.
[[nodiscard]] CameraPose framingPose(const Camera& camera, const Grid& grid, double aspect);
/// camera.pose if there is one, else framingPose.
[[nodiscard]] CameraPose resolvedPose(const Camera& camera, const Grid& grid, double aspect);

/// What a ray generator needs, in the patient frame in double; picture coordinates u, v run over [-1, 1] with
/// v up. Orthographic: ray(u, v) starts at eye + u * right + v * up and runs along forward. Perspective: it
/// starts at eye and runs along forward + u * right + v * up (not normalised).
struct RayFrame {
    glm::dvec3 eye{0.0};
    glm::dvec3 right{0.0};    ///< Half width: mm (orthographic) or tangent (perspective).
    glm::dvec3 up{0.0};       ///< Half height, likewise.
    glm::dvec3 forward{0.0};  ///< Unit.
    Projection projection = Projection::Perspective;
    double nearMm = 0.0;
    double targetDistanceMm =
        0.0;  ///< Along forward from the eye to the plane through the target (slices lie there).
};
[[nodiscard]] RayFrame rayFrame(const Camera& camera, const Grid& grid, glm::ivec2 sizePx);

/// Errors: InvalidArgument, the message beginning with the JSON pointer below the camera ("/fovDeg: ...").
[[nodiscard]] Result<void> validate(const Camera& camera);

/// Letters for the picture's left, right, top and bottom edges.
struct EdgeLetters {
    std::string left, right, top, bottom;
    bool operator==(const EdgeLetters&) const = default;
};
[[nodiscard]] EdgeLetters edgeLetters(const CameraPose& pose);

}  // namespace pellucid
