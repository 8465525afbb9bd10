// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rows of the table of extreme cases: cameras and lights.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "accuracy/extreme_scenes.h"
#include "scene/names.h"

namespace pellucid::accuracy::extreme {

void addCameras(Cases& cases) {
    const auto seen = [](const std::function<Camera(const Grid&)>& camera, Mode mode, int pixels) {
        const Grid grid = axisAlignedGrid({12, 12, 12});
        Scene scene = sceneOf(colourful(1.0), camera(grid));
        scene.mode = mode;
        scene.picture.size = glm::ivec2(pixels);
        scene.quality.stepVoxels = 1.0 / 64.0;
        return ExtremeScene{scene, waves(grid)};
    };
    struct View {
        const char* name;
        std::function<Camera(const Grid&)> camera;
        int pixels = 8;
        bool isEmpty = false;
    };
    const std::vector<View> views{
        {"eye inside",
         [](const Grid& g) {
             return perspective(g, {1.3, 0.7, -2.1}, kOblique, 60.0);
         }},
        {"eye on a face",
         [](const Grid& g) {
             return perspective(g, {0.3, -6.0, 0.4}, kAlong, 60.0);
         }},
        {"eye on a corner",
         [](const Grid& g) {
             return perspective(g, {-6.0, -6.0, -6.0}, {1, 1, 1}, 60.0);
         }},
        {"axis-aligned rays on voxel borders", [](const Grid& g) { return parallel(g, kAlong, 8.0); }},
        {"axis-aligned perspective",
         [](const Grid& g) {
             return perspective(g, {0, -40.0, 0}, kAlong, 20.0);
         }},
        {"rays that graze a face",
         [](const Grid& g) {
             Camera c = parallel(g, kAlong, 8.0);
             c.pose->eye.x += 6.5;
             c.pose->target.x += 6.5;
             return c;
         }},
        {"eye at a million diameters",
         [](const Grid& g) {
             return perspective(g, -2e6 * radiusMm(g) * glm::normalize(kOblique), kOblique,
                                2.0 * 57.29577951308232 / 2e6 * 0.4);
         }},
        {"0.1 degrees of view",
         [](const Grid& g) {
             return perspective(g, -5.0 * radiusMm(g) * glm::normalize(kOblique), kOblique, 0.1);
         }},
        {"179 degrees of view",
         [](const Grid& g) {
             return perspective(g, {0.2, -6.1, 0.3}, kAlong, 179.0);
         },
         // One pixel's rays start in the middle; those beside it are 25 times as far aside as forward.
         9},
        {"179 degrees of view, eye inside",
         [](const Grid& g) {
             return perspective(g, {0.2, 0.1, 0.3}, kOblique, 179.0);
         }},
        {"near plane inside",
         [](const Grid& g) {
             Camera c = parallel(g, kOblique, 8.0);
             c.nearMm = 4.0 * radiusMm(g) + 1.0;
             return c;
         }},
        {"near plane behind the volume",
         [](const Grid& g) {
             Camera c = parallel(g, kOblique, 8.0);
             c.nearMm = 1e9;
             return c;
         },
         8, true}};
    for (const View& view : views)
        for (const Mode mode : {Mode::Composite, Mode::Mip, Mode::Average})
            cases.push_back(
                {fmt::format("{}, {}", view.name, name(mode)),
                 [=] { return seen(view.camera, mode, view.pixels); }, AsReference{}, kGrey,
                 "second order at 1/64 voxel; an extremum a sixteenth of a step away, at slopes of "
                 "0.4 a voxel, is missed by 4e-4",
                 0.0, view.isEmpty});
}

void addLights(Cases& cases) {
    for (const int count : {0, 1, 32})
        for (const double intensity : {1.0, 1e4}) {
            if (count == 0 && intensity > 1.0) continue;
            cases.push_back({fmt::format("{} lights of intensity {:g}", count, intensity),
                             [=] {
                                 const Grid grid = axisAlignedGrid({12, 12, 12});
                                 Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, 8.0));
                                 scene.quality.stepVoxels = 1.0 / 64.0;
                                 for (int i = 0; i < count; ++i) {
                                     Light light;
                                     light.kind = i % 2 == 0 ? LightKind::Point : LightKind::Directional;
                                     light.positionMm =
                                         40.0 * glm::dvec3(std::cos(i), std::sin(2.0 * i), std::sin(i));
                                     light.directionMm = {std::sin(3.0 * i), std::cos(i), 0.3};
                                     light.intensity = intensity / count;
                                     scene.lights->push_back(light);
                                 }
                                 return ExtremeScene{scene, waves(grid)};
                             },
                             AsReference{}, kGrey * std::max(1.0, intensity),
                             "second order at 1/64 voxel, times the light"});
        }
    cases.push_back({"257 lights",
                     [] {
                         ExtremeScene s = slab(1.0, 0.5, Integrator::Exponential, Mode::Composite);
                         s.scene.lights->resize(257);
                         return s;
                     },
                     Refused{"lights"}, 0.0, "a uniform block holds 256"});
}

}  // namespace pellucid::accuracy::extreme
