// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "bench/bench_cases.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "accuracy/synthetic.h"
#include "io/load.h"

namespace pellucid::bench {
namespace {

/// The outer layer of voxels becomes the lowest value, which is transparent: VTK's volume ends at the outer
/// voxel centres and ours half a voxel further out, and so nothing is there.
VolumePtr framed(const Volume& volume) {
    const Grid& grid = volume.grid();
    return accuracy::sampledVolume(
        grid, volume.type(),
        [&](glm::ivec3 i) {
            const bool outer =
                glm::any(glm::equal(i, glm::ivec3(0))) || glm::any(glm::equal(i, grid.size - 1));
            return outer ? volume.storedRange().lo : volume.stored(i);
        },
        volume.mapping());
}

/// As 16 bits on an upright grid with its own spacing, which is what both renderers take without conversion.
VolumePtr upright16(const Volume& volume) {
    const Grid grid = axisAlignedGrid(volume.grid().size, spacingMm(volume.grid()));
    return accuracy::sampledVolume(grid, VoxelType::Int16, [&](glm::ivec3 i) { return volume.physical(i); });
}

TransferFunction1D signalFunction() {
    return {"signal",
            "",
            {{0.0, {0.1, 0.2, 0.7}, 0.0},
             {0.3, {0.1, 0.5, 0.9}, 0.0},
             {0.5, {0.9, 0.8, 0.3}, 0.25},
             {0.8, {0.9, 0.3, 0.2}, 0.05},
             {1.0, {1.0, 1.0, 1.0}, 0.6}}};
}

TransferFunction1D tissueFunction() {
    return {"tissue",
            "HU",
            {{-200.0, {0.8, 0.5, 0.4}, 0.0},
             {0.0, {0.9, 0.6, 0.5}, 0.01},
             {100.0, {0.8, 0.4, 0.3}, 0.02},
             {300.0, {1.0, 0.9, 0.7}, 0.1},
             {1200.0, {1.0, 1.0, 0.95}, 0.8}}};
}

struct Data {
    std::string name;
    VolumePtr volume;
    TransferFunction1D function;
    Window window;
};

Scene sceneOf(const Data& data, Mode mode, bool lit, Projection projection) {
    const Grid& grid = data.volume->grid();
    Scene scene;
    scene.volumes.emplace_back();
    scene.volumes.front().transferFunction = data.function;
    scene.volumes.front().window = data.window;
    scene.mode = mode;
    scene.lights = lit ? std::vector<Light>{Light{}} : std::vector<Light>{};
    // No highlight: VTK's is Phong's, ours Blinn's, and the pictures are compared.
    scene.material = {0.2, 0.8, 0.0, 10.0};
    scene.picture.size = {512, 512};
    setView(scene, grid, projection);
    return completed(scene, {data.volume});
}

/// Unlit and lit where the mode has light, in both projections.
void addErrorCases(std::vector<BenchCase>& cases, const std::string& name, const VolumePtr& volume,
                   const std::optional<TransferFunction1D>& function, Mode mode, int size) {
    for (const Projection projection : {Projection::Orthographic, Projection::Perspective})
        for (const bool lit : {false, true}) {
            if (lit && !usesLights(mode)) continue;
            Scene scene;
            scene.volumes.emplace_back();
            scene.volumes.front().transferFunction = function;
            scene.mode = mode;
            scene.lights = lit ? std::vector<Light>{Light{}} : std::vector<Light>{};
            scene.material = {0.2, 0.8, 0.0, 10.0};  // No highlight, as above.
            scene.picture.size = {size, size};
            setView(scene, volume->grid(), projection);
            cases.push_back({name, lit ? "lit" : std::string(pellucid::name(mode)),
                             std::string(pellucid::name(projection)), completed(scene, {volume}), volume});
        }
}

}  // namespace

VolumePtr fog(int n) {
    return accuracy::sampledVolume(axisAlignedGrid(glm::ivec3(n)), VoxelType::UInt16, [n](glm::ivec3 i) {
        const glm::dvec3 p = 6.0 * glm::dvec3(i) / static_cast<double>(n);
        return 32768.0 + 14000.0 * (std::sin(p.x) * std::cos(1.3 * p.y) + std::sin(0.7 * p.z + p.x));
    });
}

TransferFunction1D fogFunction() {
    return {"fog", "", {{0.0, {0.3, 0.5, 0.9}, 0.001}, {65535.0, {1.0, 0.9, 0.6}, 0.03}}};
}

TransferFunction1D thinShells() {
    TransferFunction1D function{"shells", "", {}};
    for (const double value : {0.3, 0.5, 0.7}) {
        const glm::dvec3 color(value, 1.0 - value, 0.6);
        function.points.push_back({value - 0.02, color, 0.0});
        function.points.push_back({value, color, 1.0});
        function.points.push_back({value + 0.02, color, 0.0});
    }
    return function;
}

TransferFunction1D boneFunction() {
    return {"bone",
            "HU",
            {{150.0, {0.8, 0.4, 0.3}, 0.0}, {300.0, {1.0, 0.9, 0.7}, 0.3}, {1200.0, {1, 1, 1}, 2.0}}};
}

void setView(Scene& scene, const Grid& grid, Projection projection) {
    scene.camera.projection = projection;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0.4, 1.0, -0.3));
    // 3.864 radii away at 30 degrees.
    scene.camera.pose = CameraPose{
        centreMm(grid) - 3.864 * radiusMm(grid) * forward, centreMm(grid), {0, 0, 1}, 2.0 * radiusMm(grid)};
}

Result<std::vector<BenchCase>> errorCases(const std::vector<std::string>& scans, int size) {
    std::vector<BenchCase> cases;
    const VolumePtr shells = accuracy::ctLikeShells(256);
    addErrorCases(cases, "Marschner-Lobb 128^3", accuracy::marschnerLobb(128), signalFunction(),
                  Mode::Composite, size);
    addErrorCases(cases, "thin shells 128^3", accuracy::marschnerLobb(128), thinShells(), Mode::Composite,
                  size);
    addErrorCases(cases, "fog 256^3", fog(256), fogFunction(), Mode::Composite, size);
    addErrorCases(cases, "CT shells 256^3", shells, boneFunction(), Mode::Composite, size);
    addErrorCases(cases, "CT shells 256^3", shells, std::nullopt, Mode::Mip, size);
    for (const std::string& scan : scans) {
        const auto loaded = io::loadVolume({scan});
        if (!loaded) return tl::unexpected<Error>(loaded.error());
        const VolumePtr volume = upright16(**loaded);
        const glm::ivec3 n = volume->grid().size;
        const std::string name = fmt::format("{} {}x{}x{}", (*loaded)->info().name, n.x, n.y, n.z);
        // The look of the scan itself, which knows its modality.
        const auto function = completed({}, {*loaded}).volumes.front().transferFunction;
        addErrorCases(cases, name, volume, function, Mode::Composite, size);
    }
    return cases;
}

Result<std::vector<BenchCase>> benchCases(const std::string& path) {
    std::vector<Data> data;
    data.push_back(
        {"Marschner-Lobb 128^3", framed(*accuracy::marschnerLobb(128)), signalFunction(), {0.5, 1.0}});
    data.push_back(
        {"CT-like shells 256^3", framed(*accuracy::ctLikeShells(256)), tissueFunction(), {100.0, 2200.0}});
    if (!path.empty()) {
        const auto loaded = io::loadVolume({path});
        if (!loaded) return tl::unexpected<Error>(loaded.error());
        const VolumePtr volume = framed(*upright16(**loaded));
        const Scene scene = completed({}, {*loaded});
        const glm::ivec3 size = volume->grid().size;
        data.push_back({fmt::format("{} {}x{}x{}", (*loaded)->info().name, size.x, size.y, size.z), volume,
                        *scene.volumes.front().transferFunction, *scene.volumes.front().window});
    }
    std::vector<BenchCase> cases;
    for (const Data& d : data)
        for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
            const std::string name = projection == Projection::Orthographic ? "orthographic" : "perspective";
            cases.push_back(
                {d.name, "composite", name, sceneOf(d, Mode::Composite, false, projection), d.volume});
            cases.push_back(
                {d.name, "composite, lit", name, sceneOf(d, Mode::Composite, true, projection), d.volume});
            cases.push_back({d.name, "mip", name, sceneOf(d, Mode::Mip, false, projection), d.volume});
        }
    return cases;
}

}  // namespace pellucid::bench
