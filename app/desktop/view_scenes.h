// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "scene/scene.h"

namespace pellucid::app {

/// The three slice views, along the patient's axes.
enum class Plane { Axial, Coronal, Sagittal };

/// Axial as seen from the feet (patient left on the right), coronal from the front, sagittal from the
/// patient's left (anterior on the left): the radiological convention.
[[nodiscard]] AnatomicalView viewOf(Plane plane);
[[nodiscard]] const char* name(Plane plane);

/// How a slice view is moved within its plane. Not part of the scene: it says where one looks, not what is
/// drawn.
struct SlicePlacement {
    double zoom = 1.0;       ///< 1 fits the volume into the view.
    glm::dvec2 panMm{0, 0};  ///< Of the view's centre against the volume's, along the picture's right and up.
    bool operator==(const SlicePlacement&) const = default;
};

/// The scene that a slice view renders: the document's volume in the slice mode, in the plane through the
/// crosshair. Carries only what a slice depends on, so that scenes that show the same slice compare equal.
[[nodiscard]] Scene sliceScene(const Scene& document, const Grid& grid, Plane plane, glm::dvec3 crosshairMm,
                               const SlicePlacement& placement, glm::ivec2 sizePx);

/// The document's scene at the size of the 3D view. What the mode does not use (a window in a composite) is
/// left out, so that scenes that show the same picture compare equal.
[[nodiscard]] Scene volumeScene(const Scene& document, glm::ivec2 sizePx);

/// Where a patient position shows in a picture of this camera: x and y from the top left in [0, 1] inside it.
/// Orthographic.
[[nodiscard]] glm::dvec2 pictureFromPatient(const RayFrame& frame, glm::dvec3 positionMm);
/// The position in the slice plane at x, y from the top left in [0, 1].
[[nodiscard]] glm::dvec3 patientFromPicture(const RayFrame& frame, glm::dvec2 picture);

/// Unit direction of the next slice: superior, anterior, right (the directions that Slicer counts in).
[[nodiscard]] glm::dvec3 nextSliceDirection(Plane plane);

/// The slices of a view: voxel planes where the grid follows the patient's axes, else planes as far apart as
/// the voxels of the axis nearest to the normal, over the extent of the voxel centres.
struct SliceRange {
    double firstMm = 0.0;  ///< Coordinate along nextSliceDirection of slice 0.
    double stepMm = 1.0;   ///< > 0.
    int count = 1;
};
[[nodiscard]] SliceRange sliceRange(const Grid& grid, Plane plane);
/// Number of the slice nearest to the position, from 0 (the most inferior, posterior, left one).
[[nodiscard]] int sliceNumber(const Grid& grid, Plane plane, glm::dvec3 positionMm);

/// True when every voxel axis runs along a patient axis, so that a slice view can show voxel planes as they
/// are stored.
[[nodiscard]] bool followsPatientAxes(const Grid& grid);
/// The crosshair position to use for a wish: a voxel centre where the grid follows the patient's axes (slices
/// then show stored values without interpolation across slices), else the wish; inside the volume's bounds
/// either way.
[[nodiscard]] glm::dvec3 allowedCrosshair(const Grid& grid, glm::dvec3 wishMm);

/// Camera moves for the mouse. Angles in radians, positive as the object follows the hand: to the right and
/// upwards.
[[nodiscard]] CameraPose rotated(const CameraPose& pose, double rightward, double upward);
[[nodiscard]] CameraPose rolled(const CameraPose& pose, double clockwise);
[[nodiscard]] CameraPose panned(const CameraPose& pose, double rightMm, double upMm);
/// Moves the eye towards the target until the distance is multiplied by `factor` > 0.
[[nodiscard]] CameraPose dollied(const CameraPose& pose, double factor);
/// Height in mm of the picture in the plane through the target.
[[nodiscard]] double visibleHeightMm(const Camera& camera, const CameraPose& pose);
/// resolvedPose with the orthographic height that shows the target plane as large as the perspective picture
/// does, so that a change of projection keeps the size.
[[nodiscard]] CameraPose editablePose(const Camera& camera, const Grid& grid, double aspect);

/// "R 17.6  P 35.3  S 12.1 mm".
[[nodiscard]] std::string positionText(glm::dvec3 positionMm);
/// "S 12.1 mm": the coordinate along the plane's normal.
[[nodiscard]] std::string sliceText(Plane plane, glm::dvec3 positionMm);

}  // namespace pellucid::app
