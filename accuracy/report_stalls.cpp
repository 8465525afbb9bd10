// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_stalls.h"

#include <cmath>

#include "accuracy/report_analysis.h"
#include "accuracy/synthetic.h"

namespace pellucid::accuracy {
namespace {

constexpr int kVoxels = 2000;
constexpr int kLayers = 2 * kVoxels;  // Steps of half a voxel.

Scene mediumScene(const Grid& grid, double layerOpacity, Accumulation accumulation) {
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction =
        TransferFunction1D{"medium", "", {{0.0, glm::dvec3(1.0), -std::log1p(-layerOpacity)}}};
    scene.lights.emplace();
    scene.unitLengthMm = 0.5;
    scene.camera.projection = Projection::Orthographic;
    scene.camera.pose = CameraPose{
        centreMm(grid) - glm::dvec3(0.0, 2.0 * radiusMm(grid), 0.0), centreMm(grid), {0, 0, 1}, 0.5};
    scene.quality.stepVoxels = 0.5;
    scene.quality.earlyTermination = 0.0;
    scene.quality.accumulation = accumulation;
    scene.picture.size = {1, 1};
    return scene;
}

}  // namespace

Result<std::vector<Stall>> measureStalls(renderer::Renderer& renderer, const Progress& progress) {
    const Grid grid = axisAlignedGrid({1, kVoxels, 1});
    const VolumePtr volume = sampledVolume(grid, VoxelType::UInt8, [](glm::ivec3) { return 1.0; });
    std::vector<Stall> stalls;
    for (const auto& format : enumNames<Accumulation>())
        for (const double opacity : {0.01, 0.004, 0.001}) {
            renderer::RenderOptions options;
            options.progress = progress;
            const auto frame = renderer.render(mediumScene(grid, opacity, format.value), {volume}, options);
            if (!frame) return tl::unexpected(frame.error());
            stalls.push_back({format.value, opacity, kLayers, -std::expm1(kLayers * std::log1p(-opacity)),
                              predictedStall(format.value, opacity, kLayers),
                              static_cast<double>(frame->image.pixels.front().a)});
        }
    return stalls;
}

}  // namespace pellucid::accuracy
