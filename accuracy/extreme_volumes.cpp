// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rows of the table of extreme cases: volumes, grids and values.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "accuracy/extreme_scenes.h"
#include "accuracy/synthetic.h"
#include "scene/names.h"

namespace pellucid::accuracy::extreme {

void addVolumes(Cases& cases) {
    for (const auto& mode : enumNames<Mode>())
        cases.push_back({fmt::format("constant volume, zero gradients, {}", mode.name),
                         [m = mode.value] {
                             const Grid grid = axisAlignedGrid({6, 6, 6});
                             Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, 4.0));
                             scene.mode = m;
                             scene.hitOpacity = 0.02;  // below that of the value, so that it is hit
                             scene.lights->emplace_back();
                             return ExtremeScene{scene, filled(grid, 0.5)};
                         },
                         AsReference{}, kFloat, "everywhere one value; no normal, so lights change nothing"});
    for (const auto& filter : enumNames<Filter>())
        cases.push_back(
            {fmt::format("checkerboard at Nyquist, {}", filter.name),
             [f = filter.value] {
                 const Grid grid = axisAlignedGrid({12, 12, 12});
                 Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, 8.0));
                 scene.volumes.front().filter = f;
                 scene.quality.stepVoxels = 1.0 / 64.0;
                 return ExtremeScene{scene, sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) {
                                         return static_cast<double>((i.x + i.y + i.z) % 2);
                                     })};
             },
             AsReference{}, kGrey, "second order at 1/64 voxel; jumps (nearest) half a step each"});
    for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), glm::ivec3(1, 7, 5), glm::ivec3(5, 1, 7),
                                  glm::ivec3(9, 4, 1), glm::ivec3(2, 2, 2)})
        for (const Filter filter : {Filter::Trilinear, Filter::CatmullRom})
            cases.push_back({fmt::format("{}x{}x{} voxels, {}", size.x, size.y, size.z, name(filter)),
                             [=] {
                                 const Grid grid = axisAlignedGrid(size);
                                 Scene scene =
                                     sceneOf(colourful(2.0), parallel(grid, kOblique, 2.0 * radiusMm(grid)));
                                 scene.volumes.front().filter = filter;
                                 scene.lights->emplace_back();
                                 scene.quality.stepVoxels = 1.0 / 64.0;
                                 return ExtremeScene{scene, waves(grid)};
                             },
                             AsReference{}, kGrey, "second order at 1/64 voxel; edges of the box"});
    cases.push_back({"empty scene: the volume is not in the picture",
                     [] {
                         ExtremeScene s = slab(1.0, 0.5, Integrator::Exponential, Mode::Composite);
                         s.scene.camera.pose->eye.x += 1e3;
                         s.scene.camera.pose->target.x += 1e3;
                         s.scene.picture.background = {0.1, 0.2, 0.3};
                         return s;
                     },
                     EveryPixel{{0.1, 0.2, 0.3, 0.0}}, 1e-7, "the background", 0.0, true});
    cases.push_back(
        {"all-opaque scene",
         [] {
             const Grid grid = axisAlignedGrid({12, 12, 12});
             TransferFunction1D function = colourful(1.0);
             for (auto& point : function.points) point.extinction = extinctionFromOpacity(1.0);
             Scene scene = sceneOf(function, parallel(grid, kOblique, 8.0));
             scene.quality.stepVoxels = 1.0 / 64.0;
             return ExtremeScene{scene, waves(grid)};
         },
         AsReference{}, kGrey,
         "opacity 1 a voxel everywhere: the colours of the first 1/16 mm; second order at 1/64 voxel"});
}

namespace {

/// Looks along an axis of a box of very unequal edges, a little askew, so that rays cross cells along all
/// axes. The view is as high as the thinnest edge; steps and unit length follow from the edge looked along.
ExtremeScene through(const Grid& grid, int axis) {
    const glm::dvec3 edges = spacingMm(grid) * glm::dvec3(grid.size);
    glm::dvec3 forward = 0.3 * glm::min(edges, glm::dvec3(edges[axis]));
    forward[axis] = edges[axis];
    const double thin = std::min({edges.x, edges.y, edges.z});
    Scene scene = sceneOf(colourful(1.0), parallel(grid, forward, thin));
    scene.unitLengthMm = edges[axis] / 16.0;
    // Short beside a voxel's edge there; many more on a diagonal are refused by drivers that end loops.
    scene.quality.stepMm = edges[axis] / 256.0;
    return {scene, waves(grid)};
}

}  // namespace

void addGrids(Cases& cases) {
    const auto drawn = [](const Grid& grid, double perUnit) {
        Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, radiusMm(grid)));
        scene.unitLengthMm = perUnit;
        scene.quality.stepMm = radiusMm(grid) / 400.0;
        return ExtremeScene{scene, waves(grid)};
    };
    for (const glm::dvec3 spacing :
         {glm::dvec3(1, 1, 1000), glm::dvec3(1000, 1, 1), glm::dvec3(0.001, 1, 0.03)})
        for (int axis = 0; axis < 3; ++axis)
            cases.push_back({fmt::format("spacing {:g} x {:g} x {:g} mm, along {}", spacing.x, spacing.y,
                                         spacing.z, "xyz"[axis]),
                             [=] {
                                 return through(axisAlignedGrid({8, 8, 8}, spacing), axis);
                             },
                             AsReference{}, kGrey, "second order, a step of 1/32 voxel along the view"});
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double origin : {0.0, 1e7}) {
            if (scale < 1.0 && origin > 0.0) continue;
            cases.push_back(
                {fmt::format("voxels of {:g} mm, origin at {:g} mm", scale, origin),
                 [=] {
                     return drawn(axisAlignedGrid({8, 8, 8}, glm::dvec3(scale), glm::dvec3(origin)), scale);
                 },
                 AsReference{}, 1e-3,
                 "positions are relative to the volume's centre; second order, 1/60 voxel"});
        }
    cases.push_back({"voxels of 1e-6 mm, origin at 1e7 mm",
                     [=] {
                         return drawn(axisAlignedGrid({8, 8, 8}, glm::dvec3(1e-6), glm::dvec3(1e7)), 1e-6);
                     },
                     AsReference{}, kGrey,
                     "double resolves 2e-9 mm there, 1/500 voxel, in the camera of both pictures alike"});
}

void addValues(Cases& cases) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto odd = [](VoxelType type, double strange, double lo, double hi, Mode mode) {
        const Grid grid = axisAlignedGrid({8, 8, 8});
        TransferFunction1D function = colourful(1.0);
        for (auto& p : function.points) p.value = lo + p.value * (hi - lo);
        Scene scene = sceneOf(function, parallel(grid, kOblique, 6.0));
        scene.mode = mode;
        scene.volumes.front().window = Window{0.5 * lo + 0.5 * hi, hi - lo};
        scene.quality.stepVoxels = 1.0 / 64.0;
        return ExtremeScene{scene, sampledVolume(grid, type, [=](glm::ivec3 i) {
                                if (i == glm::ivec3(4, 3, 4)) return strange;
                                return lo + (hi - lo) * ((i.x * 37 + i.y * 59 + i.z * 83) % 120) / 119.0;
                            })};
    };
    struct Odd {
        const char* name;
        VoxelType type;
        double strange, lo, hi;
    };
    constexpr double kTiny = 1e-310;  // denormal in double
    for (const Odd& o :
         {Odd{"NaN among float values", VoxelType::Float32, kNan, 0.0, 1.0},
          Odd{"+infinity among float values", VoxelType::Float32, kInf, 0.0, 1.0},
          Odd{"-infinity among double values", VoxelType::Float64, -kInf, 0.0, 1.0},
          Odd{"denormal float values", VoxelType::Float32, 0.0, 0.0, 1e-40},
          Odd{"denormal double values", VoxelType::Float64, 0.0, 0.0, 100.0 * kTiny},
          Odd{"float values up to the largest", VoxelType::Float32, 0.0, 0.0, 3.4e38},
          Odd{"int32 over its whole range", VoxelType::Int32, 0.0, -2147483648.0, 2147483647.0},
          Odd{"int32 1 ... 1000 above 2^30", VoxelType::Int32, 1073741824.0, 1073741824.0, 1073742824.0},
          Odd{"float64 1e9 + [0, 1]", VoxelType::Float64, 1e9, 1e9, 1e9 + 1.0},
          Odd{"float64 up to 1e300", VoxelType::Float64, 0.0, 0.0, 1e300}})
        for (const Mode mode : {Mode::Composite, Mode::Mip}) {
            const bool wide = o.hi > 1e38 || o.hi < 1e-30;
            cases.push_back(
                {fmt::format("{}, {}", o.name, name(mode)),
                 [=] { return odd(o.type, o.strange, o.lo, o.hi, mode); }, AsReference{},
                 wide ? 2.0 * kGrey : kGrey,
                 "values are held over their range to 2^-25 of it; not finite ones as the smallest", 0.0});
        }
    cases.push_back({"float64 range beyond the largest double",
                     [] {
                         const Grid grid = axisAlignedGrid({4, 4, 4});
                         return ExtremeScene{sceneOf(constant(0.1), parallel(grid, kAlong, 2.0)),
                                             sampledVolume(grid, VoxelType::Float64, [](glm::ivec3 i) {
                                                 return i.x == 0 ? -1.7e308 : 1.7e308;
                                             })};
                     },
                     Refused{"float64"}, 0.0, "no difference of two values can be held"});
    cases.push_back(
        {"float values that are all NaN",
         [=] {
             const Grid grid = axisAlignedGrid({4, 4, 4});
             return ExtremeScene{sceneOf(constant(0.1), parallel(grid, kAlong, 2.0)), filled(grid, kNan)};
         },
         Refused{"finite"}, 0.0, "there is no value to draw"});
    for (const Mode mode : {Mode::Composite, Mode::Mip})
        cases.push_back({fmt::format("float values all at the largest, {}", name(mode)),
                         [=] {
                             const Grid grid = axisAlignedGrid({4, 16, 4});
                             Scene scene = sceneOf(constant(0.1), parallel(grid, kAlong, 2.0));
                             scene.mode = mode;
                             scene.volumes.front().window = Window{1.7e38, 3.4e38};
                             return ExtremeScene{scene, filled(grid, 3.4e38)};
                         },
                         EveryPixel{mode == Mode::Mip ? glm::dvec4(1.0) : shown(1.6)}, kFloat, "one value"});
}

}  // namespace pellucid::accuracy::extreme
