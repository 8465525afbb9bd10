// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "accuracy/synthetic.h"
#include "scene/scene.h"

namespace pellucid::test {

/// A transfer function of one colour and one extinction (per unit length).
inline TransferFunction1D constantFunction(glm::dvec3 color, double extinction) {
    return {"constant", "", {{0.0, color, extinction}}};
}

/// Extinction runs linearly from 0 at value 0 to `atOne` at value 1; one colour.
inline TransferFunction1D linearExtinction(glm::dvec3 color, double atOne) {
    return {"linear", "", {{0.0, color, 0.0}, {1.0, color, atOne}}};
}

/// Colours and bends as real presets have them, for values in [0, 1].
inline TransferFunction1D colourfulFunction(double scale = 1.0) {
    return {"colourful",
            "",
            {{0.1, {0.1, 0.2, 0.9}, 0.0},
             {0.35, {0.2, 0.9, 0.3}, 0.06 * scale},
             {0.6, {0.9, 0.8, 0.1}, 0.02 * scale},
             {0.95, {1.0, 0.3, 0.2}, 0.5 * scale}}};
}

/// Looks at the volume's centre along `forward`; orthographic, `heightMm` high, the eye well outside.
inline Camera orthographicAlong(const Grid& grid, glm::dvec3 forward, double heightMm) {
    const glm::dvec3 unit = glm::normalize(forward);
    const glm::dvec3 up = std::abs(unit.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0);
    Camera camera;
    camera.projection = Projection::Orthographic;
    camera.pose = CameraPose{centreMm(grid) - 4.0 * radiusMm(grid) * unit, centreMm(grid), up, heightMm};
    return camera;
}

inline Camera perspectiveAlong(const Grid& grid, glm::dvec3 forward, double distanceInRadii,
                               double fovDeg = 30.0) {
    Camera camera = orthographicAlong(grid, forward, 1.0);
    camera.projection = Projection::Perspective;
    camera.fovDeg = fovDeg;
    camera.pose->eye = centreMm(grid) - distanceInRadii * radiusMm(grid) * glm::normalize(forward);
    return camera;
}

/// A scene of one volume, unlit, without early termination, unit length 1 mm, black background.
inline Scene sceneOf(const TransferFunction1D& function, const Camera& camera, glm::ivec2 size) {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = function;
    scene.volumes.front().window = Window{0.5, 1.0};
    scene.volumes.front().isovalue = 0.5;
    scene.lights = std::vector<Light>{};
    scene.camera = camera;
    scene.unitLengthMm = 1.0;
    scene.quality.earlyTermination = 0.0;
    scene.picture.size = size;
    return scene;
}

/// One ray: through the volume's centre along `forward`.
inline Scene rayScene(const TransferFunction1D& function, const Grid& grid, glm::dvec3 forward) {
    return sceneOf(function, orthographicAlong(grid, forward, 1.0), {1, 1});
}

/// Every filter with a field of its own (fieldOf); the others draw one of these fields in another way
/// (FilterVariants in filter_test.cpp holds them against it).
inline const std::vector<Filter>& allFilters() {
    static const std::vector<Filter> filters{Filter::Nearest, Filter::Trilinear, Filter::TricubicBSpline,
                                             Filter::CatmullRom, Filter::Lanczos3};
    return filters;
}

inline const std::vector<Mode>& allModes() {
    static const std::vector<Mode> modes{Mode::Composite, Mode::Mip,        Mode::MinIp,
                                         Mode::Average,   Mode::XRay,       Mode::Emission,
                                         Mode::FirstHit,  Mode::Isosurface, Mode::Slice};
    return modes;
}

inline VolumePtr constantVolume(const Grid& grid, double value) {
    return accuracy::sampledVolume(grid, VoxelType::Float32, [value](glm::ivec3) { return value; });
}

/// Value a + b * j: linear along the patient's y for axis-aligned grids.
inline VolumePtr rampVolume(const Grid& grid, double a, double b) {
    return accuracy::sampledVolume(grid, VoxelType::Float64,
                                   [a, b](glm::ivec3 index) { return a + b * index.y; });
}

}  // namespace pellucid::test
