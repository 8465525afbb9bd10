// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "accuracy/verify.h"
#include "scene/scene.h"

/// Fields and scenes of the convergence test (private to the room).
namespace pellucid::accuracy {

/// Oblique to every axis, so that rays meet cell borders at all places of a step.
inline constexpr glm::dvec3 kVerifyForward{0.4, 1.0, -0.3};
/// Edges of the box about the origin that the voxels fill. Not a cube: else all central differences would be
/// wrong by one factor, and normals exact.
inline constexpr glm::dvec3 kVerifyBoxMm{24.0, 24.0, 36.0};
inline constexpr double kVerifyHitOpacity = 0.02;
inline constexpr double kVerifyIsovalue = 0.4;

/// n x n x 1.5 n voxels that fill the box. Precondition: n is even.
[[nodiscard]] Grid verifyGrid(int n);

/// A bump prod sin^2(pi x_i / L) in [0, 1], 1 in the middle of the box; or one minus it. It is even about the
/// box's faces, so that the renderer's repeated edge voxels continue it exactly. p: mm from the box's centre.
[[nodiscard]] double bumpAt(glm::dvec3 p, bool inverted);
[[nodiscard]] glm::dvec3 bumpGradient(glm::dvec3 p, bool inverted);
[[nodiscard]] VolumePtr bumpVolume(int n, bool inverted);

/// Waves in [0.1, 0.9] of the box in voxels of 1 mm; and random voxels there, for filters whose errors come
/// from their cell borders.
[[nodiscard]] VolumePtr wavesVolume();
[[nodiscard]] VolumePtr roughVolume();

enum class Rays {
    Oblique,      ///< Parallel, along kVerifyForward.
    Perspective,  ///< From outside the box, 11 degrees apart at the picture's edges from the middle.
    AlongAxis  ///< Parallel to y: all of them meet voxel centres, where trilinear has kinks, at multiples of
               ///< 1/2 voxel.
};
[[nodiscard]] const char* raysName(Rays rays);

/// A transfer function with one linear piece over every value that occurs, so that it adds no kink; no early
/// termination; surfaces lit by a headlight. The picture is heightMm high in the middle of the box.
[[nodiscard]] Scene verifyScene(Mode mode, Filter filter, int pixels, double heightMm,
                                Rays rays = Rays::Oblique);

/// Its extinction per mm and colour at a value.
[[nodiscard]] double verifyExtinction(double value);
[[nodiscard]] glm::dvec3 verifyColor(double value);

/// The index k of the first derivative that jumps at cell borders: 0 for nearest (the value), 1 for
/// trilinear, 2 for Catmull-Rom, 3 for the cubic B-spline. An integral over a segment that holds such a jump
/// is wrong by O(h^(k+1)).
[[nodiscard]] int smoothnessOf(Filter filter);
/// The same as words.
[[nodiscard]] std::string whyOf(Filter filter);

/// One picture. Errors: the renderer's; Internal when a number in it is not finite.
[[nodiscard]] Result<ImageF> pictureOf(renderer::Renderer& renderer, const Scene& scene,
                                       const VolumePtr& volume);

/// Mean absolute difference over RGB; and the largest.
[[nodiscard]] double meanError(const ImageF& a, const ImageF& b);
[[nodiscard]] double largestError(const ImageF& a, const ImageF& b);

}  // namespace pellucid::accuracy
