// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "accuracy/extreme.h"

/// What the rows of the table of extreme cases are made of (private to the room). Unless a row says
/// otherwise: unit length 1 mm, unlit, black background, parallel rays, no early termination, 8 x 8 pixels.
namespace pellucid::accuracy::extreme {

using Cases = std::vector<ExtremeCase>;

inline constexpr glm::dvec3 kAlong{0.0, 1.0, 0.0};
inline constexpr glm::dvec3 kOblique{0.4, 1.0, -0.3};
inline constexpr glm::dvec3 kColor{0.25, 0.5, 0.75};
/// Float: some hundred roundings of 6e-8 on a way of up to 100 voxels, positions good to 1e-6 of the box.
inline constexpr double kFloat = 2e-5;
/// A grey level, for scenes whose field is rough: at a 1/16-voxel step bends and jumps leave less.
inline constexpr double kGrey = 1.0 / 255.0;

/// Looks at the grid's centre from outside.
[[nodiscard]] Camera parallel(const Grid& grid, glm::dvec3 forward, double heightMm);
[[nodiscard]] Camera perspective(const Grid& grid, glm::dvec3 eyeFromCentre, glm::dvec3 forward,
                                 double fovDeg);
[[nodiscard]] Scene sceneOf(const TransferFunction1D& function, const Camera& camera);

/// kColor and one extinction.
[[nodiscard]] TransferFunction1D constant(double extinction);
/// Bends and colours for values in [0, 1], extinction per unit length.
[[nodiscard]] TransferFunction1D colourful(double scale);

[[nodiscard]] VolumePtr filled(const Grid& grid, double value);
/// Values in [0, 1].
[[nodiscard]] VolumePtr waves(const Grid& grid);

/// What kColor shows through a depth on black: c (1 - exp(-tau)), alpha 1 - exp(-tau).
[[nodiscard]] glm::dvec4 shown(double depth);
/// A homogeneous slab of 16 mm along the rays.
[[nodiscard]] ExtremeScene slab(double extinction, double stepVoxels, Integrator integrator, Mode mode);

void addOpticalDepths(Cases& cases);
void addFunctions(Cases& cases);
void addVolumes(Cases& cases);
void addGrids(Cases& cases);
void addValues(Cases& cases);
void addCameras(Cases& cases);
void addLights(Cases& cases);

}  // namespace pellucid::accuracy::extreme
