// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme_scenes.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "accuracy/synthetic.h"

namespace pellucid::accuracy::extreme {

Camera parallel(const Grid& grid, glm::dvec3 forward, double heightMm) {
    const glm::dvec3 unit = glm::normalize(forward);
    const glm::dvec3 up = std::abs(unit.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0);
    Camera camera;
    camera.projection = Projection::Orthographic;
    camera.pose = CameraPose{centreMm(grid) - 4.0 * radiusMm(grid) * unit, centreMm(grid), up, heightMm};
    return camera;
}

Camera perspective(const Grid& grid, glm::dvec3 eyeFromCentre, glm::dvec3 forward, double fovDeg) {
    Camera camera = parallel(grid, forward, 1.0);
    camera.projection = Projection::Perspective;
    camera.fovDeg = fovDeg;
    camera.pose->eye = centreMm(grid) + eyeFromCentre;
    camera.pose->target = camera.pose->eye + radiusMm(grid) * glm::normalize(forward);
    return camera;
}

Scene sceneOf(const TransferFunction1D& function, const Camera& camera) {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = function;
    scene.volumes.front().window = Window{0.5, 1.0};
    scene.volumes.front().isovalue = 0.5;
    scene.lights = std::vector<Light>{};
    scene.camera = camera;
    scene.unitLengthMm = 1.0;
    scene.quality.earlyTermination = 0.0;
    scene.picture.size = {8, 8};
    return scene;
}

TransferFunction1D constant(double extinction) {
    return {"constant", "", {{0.0, kColor, extinction}}};
}

TransferFunction1D colourful(double scale) {
    return {"colourful",
            "",
            {{0.1, {0.1, 0.2, 0.9}, 0.0},
             {0.35, {0.2, 0.9, 0.3}, 0.06 * scale},
             {0.6, {0.9, 0.8, 0.1}, 0.02 * scale},
             {0.95, {1.0, 0.3, 0.2}, 0.5 * scale}}};
}

VolumePtr filled(const Grid& grid, double value) {
    return sampledVolume(grid, VoxelType::Float32, [value](glm::ivec3) { return value; });
}

VolumePtr waves(const Grid& grid) {
    return sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) {
        return 0.5 + 0.3 * std::sin(0.9 * i.x) * std::cos(0.7 * i.y) + 0.2 * std::sin(0.8 * i.z + 0.4);
    });
}

glm::dvec4 shown(double depth) {
    const double opacity = -std::expm1(-depth);
    return {kColor * opacity, opacity};
}

ExtremeScene slab(double extinction, double stepVoxels, Integrator integrator, Mode mode) {
    const Grid grid = axisAlignedGrid({4, 16, 4});
    Scene scene = sceneOf(constant(extinction), parallel(grid, kAlong, 2.0));
    scene.mode = mode;
    scene.quality.integrator = integrator;
    scene.quality.stepVoxels = stepVoxels;
    return {scene, filled(grid, 0.5)};
}

}  // namespace pellucid::accuracy::extreme
