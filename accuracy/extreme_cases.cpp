// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The table. Unless a line says otherwise: unit length 1 mm, unlit, black background,
// parallel rays, no early termination, 8 x 8 pixels.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include "accuracy/extreme.h"
#include "accuracy/synthetic.h"
#include "scene/names.h"

namespace pellucid::accuracy {
namespace {

using Cases = std::vector<ExtremeCase>;
constexpr glm::dvec3 kAlong{0.0, 1.0, 0.0};
constexpr glm::dvec3 kOblique{0.4, 1.0, -0.3};
constexpr glm::dvec3 kColor{0.25, 0.5, 0.75};
/// Float: some hundred roundings of 6e-8 on a way of up to 100 voxels, positions good to 1e-6 of the box.
constexpr double kFloat = 2e-5;
/// A grey level, for scenes whose field is rough: at a 1/16-voxel step bends and jumps leave less.
constexpr double kGrey = 1.0 / 255.0;

Camera parallel(const Grid& grid, glm::dvec3 forward, double height) {
    const glm::dvec3 unit = glm::normalize(forward);
    const glm::dvec3 up = std::abs(unit.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, -1, 0);
    Camera camera;
    camera.projection = Projection::Orthographic;
    camera.pose = CameraPose{centreMm(grid) - 4.0 * radiusMm(grid) * unit, centreMm(grid), up, height};
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
/// Bends and colours for values in [0, 1], extinction per unit length.
TransferFunction1D colourful(double scale) {
    return {"colourful",
            "",
            {{0.1, {0.1, 0.2, 0.9}, 0.0},
             {0.35, {0.2, 0.9, 0.3}, 0.06 * scale},
             {0.6, {0.9, 0.8, 0.1}, 0.02 * scale},
             {0.95, {1.0, 0.3, 0.2}, 0.5 * scale}}};
}

VolumePtr filled(const Grid& grid, double value, VoxelType type = VoxelType::Float32) {
    return sampledVolume(grid, type, [value](glm::ivec3) { return value; });
}
VolumePtr waves(const Grid& grid, ValueMapping mapping = {}, VoxelType type = VoxelType::Float32) {
    return sampledVolume(
        grid, type,
        [&](glm::ivec3 i) {
            return mapping.stored(0.5 + 0.3 * std::sin(0.9 * i.x) * std::cos(0.7 * i.y) +
                                  0.2 * std::sin(0.8 * i.z + 0.4));
        },
        mapping);
}

/// c (1 - exp(-tau)), alpha 1 - exp(-tau).
glm::dvec4 shown(double depth) {
    const double opacity = -std::expm1(-depth);
    return {kColor * opacity, opacity};
}

/// A homogeneous slab of 16 mm along the rays.
ExtremeScene slab(double extinction, double stepVoxels, Integrator integrator, Mode mode) {
    const Grid grid = axisAlignedGrid({4, 16, 4});
    Scene scene = sceneOf(constant(extinction), parallel(grid, kAlong, 2.0));
    scene.mode = mode;
    scene.quality.integrator = integrator;
    scene.quality.stepVoxels = stepVoxels;
    return {scene, filled(grid, 0.5)};
}

void addOpticalDepths(Cases& cases) {
    for (const double perStep : {1e-8, 1e-4, 1.0, 1e3, 1e6})
        for (const auto& integrator : enumNames<Integrator>()) {
            if (integrator.value == Integrator::Riemann) continue;
            cases.push_back({fmt::format("tau * step = {:g}, composite, {}", perStep, integrator.name),
                             [=, i = integrator.value] { return slab(perStep, 1.0, i, Mode::Composite); },
                             EveryPixel{shown(16.0 * perStep)}, 2e-6,
                             "c (1 - exp(-tau)); weights telescope: float roundings of 16 exponentials"});
        }
    for (const double perStep : {1e-8, 1e6}) {
        const double opacity = -std::expm1(-16.0 * perStep);
        cases.push_back({fmt::format("tau * step = {:g}, x-ray", perStep),
                         [=] { return slab(perStep, 1.0, Integrator::Simpson, Mode::XRay); },
                         EveryPixel{{opacity, opacity, opacity, 1.0}}, std::max(1e-6 * opacity, 1e-12),
                         "1 - exp(-tau) to float precision, also when faint"});
    }
    cases.push_back({"opacity exactly 0",
                     [] { return slab(0.0, 0.5, Integrator::Exponential, Mode::Composite); },
                     EveryPixel{glm::dvec4(0.0)}, 0.0, "nothing is drawn"});
    cases.push_back(
        {"opacity exactly 1",
         [] { return slab(extinctionFromOpacity(1.0), 0.5, Integrator::Exponential, Mode::Composite); },
         EveryPixel{{kColor, 1.0}}, 2e-7, "the colour itself, to a float rounding"});
    cases.push_back(
        {"100000 segments of tau 1e-5 each",
         [] { return slab(1e-5 / (16.0 / 1e5), 16.0 / 1e5, Integrator::Exponential, Mode::Composite); },
         EveryPixel{shown(1.0)}, 1.2e-3,
         "depths are summed in float: 1e5 roundings of up to 6e-8 half the depth on average, random: 2e-5, "
         "all one way: 3e-3"});
    cases.push_back({"2e9 segments on a ray",
                     [] { return slab(1.0, 1e-8, Integrator::Exponential, Mode::Composite); },
                     Refused{"samples"}, 0.0, "would take minutes"});
}

void addFunctions(Cases& cases) {
    const auto ramp = [](TransferFunction1D function, Integrator integrator, double step) {
        // The value rises linearly from 0 to 1 between the outer voxel centres.
        const Grid grid = axisAlignedGrid({4, 33, 4});
        Scene scene = sceneOf(std::move(function), parallel(grid, kAlong, 2.0));
        scene.quality.integrator = integrator;
        scene.quality.stepVoxels = step;
        return ExtremeScene{scene,
                            sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) { return i.y / 32.0; })};
    };
    // A peak of width 2 w around 0.5 and area 1 / 16 value: depth 2 of 32 mm whatever the width.
    const auto peak = [](double w) {
        return TransferFunction1D{
            "peak", "", {{0.5 - w, kColor, 0.0}, {0.5, kColor, 1.0 / (16.0 * w)}, {0.5 + w, kColor, 0.0}}};
    };
    for (const double w : {1e-2, 1e-6, 1e-12})
        for (const Integrator integrator : {Integrator::IntegralFunctions, Integrator::Adaptive})
            cases.push_back({fmt::format("peak of width {:g} of the values, {}", 2.0 * w, name(integrator)),
                             [=] { return ramp(peak(w), integrator, 1.0); }, EveryPixel{shown(2.0)}, 1e-3,
                             "running integrals know the peak's area: depth 2; float positions over 4096 "
                             "entries leave 1e-3"});
    const TransferFunction1D jump{"jump", "", {{0.5, kColor, 0.0}, {0.5, kColor, 0.125}}};
    for (const Integrator integrator : {Integrator::IntegralFunctions, Integrator::Adaptive})
        cases.push_back(
            {fmt::format("function that jumps, {}", name(integrator)),
             [=] { return ramp(jump, integrator, 1.0); }, EveryPixel{shown(0.125 * 16.5)}, 1e-3,
             "half of the slab is dense: depth 2.06; an entry of 1/4096 of the values is 1/128 voxel of it"});
    cases.push_back(
        {"function that jumps, post-classified",
         [=] { return ramp(jump, Integrator::Exponential, 1.0 / 64.0); }, EveryPixel{shown(0.125 * 16.5)},
         1e-3,
         "the table has an entry each 1/16384 of the values, 1/512 voxel: 3e-4 of depth, and half a step"});
    cases.push_back(
        {"function of 65536 points",
         [=] {
             TransferFunction1D function{"many", "", {}};
             for (int i = 0; i < 65536; ++i)
                 function.points.push_back({i / 65535.0, kColor, 0.125 * (i % 2)});
             return ramp(function, Integrator::IntegralFunctions, 1.0);
         },
         EveryPixel{shown(0.0625 * 32.0 + 0.125 * 0.5)}, 1e-3,
         "saw teeth: mean extinction 1/16 over 32 mm, 1/8 in the last half voxel (and 0 in the first)"});
}

void addVolumes(Cases& cases) {
    for (const auto& mode : enumNames<Mode>())
        cases.push_back({fmt::format("constant volume, zero gradients, {}", mode.name),
                         [m = mode.value] {
                             const Grid grid = axisAlignedGrid({6, 6, 6});
                             Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, 4.0));
                             scene.mode = m;
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
                     EveryPixel{{0.1, 0.2, 0.3, 0.0}}, 1e-7, "the background"});
}

void addGrids(Cases& cases) {
    const auto drawn = [](const Grid& grid, double perUnit) {
        Scene scene = sceneOf(colourful(1.0), parallel(grid, kOblique, radiusMm(grid)));
        scene.unitLengthMm = perUnit;
        scene.quality.stepMm = radiusMm(grid) / 400.0;
        return ExtremeScene{scene, waves(grid)};
    };
    for (const glm::dvec3 spacing :
         {glm::dvec3(1, 1, 1000), glm::dvec3(1000, 1, 1), glm::dvec3(0.001, 1, 0.03)})
        cases.push_back({fmt::format("spacing {:g} x {:g} x {:g} mm", spacing.x, spacing.y, spacing.z),
                         [=] {
                             const Grid grid = axisAlignedGrid({8, 8, 8}, spacing);
                             return drawn(grid, radiusMm(grid) / 8.0);
                         },
                         AsReference{}, kGrey, "second order, a step of 1/400 radius", 0.05});
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
                     Bounded{0.0, 1.0}, 0.0,
                     "double resolves 2e-9 mm there: finite and within [0, 1] is all that is asked"});
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
                     [=] { return odd(VoxelType::Float64, 1e308, -1.7e308, 1.7e308, Mode::Mip); },
                     Refused{""}, 0.0, "no difference of two values can be held"});
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

void addCameras(Cases& cases) {
    const auto seen = [](const std::function<Camera(const Grid&)>& camera, Mode mode) {
        const Grid grid = axisAlignedGrid({12, 12, 12});
        Scene scene = sceneOf(colourful(1.0), camera(grid));
        scene.mode = mode;
        scene.quality.stepVoxels = 1.0 / 32.0;
        return ExtremeScene{scene, waves(grid)};
    };
    struct View {
        const char* name;
        std::function<Camera(const Grid&)> camera;
        double share;
    };
    const std::vector<View> views{
        {"eye inside",
         [](const Grid& g) {
             return perspective(g, {1.3, 0.7, -2.1}, kOblique, 60.0);
         },
         0.0},
        {"eye on a face",
         [](const Grid& g) {
             return perspective(g, {0.3, -6.0, 0.4}, kAlong, 60.0);
         },
         0.0},
        {"eye on a corner",
         [](const Grid& g) {
             return perspective(g, {-6.0, -6.0, -6.0}, {1, 1, 1}, 60.0);
         },
         0.0},
        {"axis-aligned rays on voxel borders", [](const Grid& g) { return parallel(g, kAlong, 8.0); }, 0.0},
        {"axis-aligned perspective",
         [](const Grid& g) {
             return perspective(g, {0, -40.0, 0}, kAlong, 20.0);
         },
         0.0},
        {"rays that graze a face",
         [](const Grid& g) {
             Camera c = parallel(g, kAlong, 8.0);
             c.pose->eye.x += 6.5;
             c.pose->target.x += 6.5;
             return c;
         },
         0.0},
        {"eye at a million diameters",
         [](const Grid& g) {
             return perspective(g, -2e6 * radiusMm(g) * glm::normalize(kOblique), kOblique,
                                2.0 * 57.29577951308232 / 2e6 * 0.4);
         },
         0.0},
        {"0.1 degrees of view",
         [](const Grid& g) {
             return perspective(g, -5.0 * radiusMm(g) * glm::normalize(kOblique), kOblique, 0.1);
         },
         0.0},
        {"179 degrees of view",
         [](const Grid& g) {
             return perspective(g, {0.2, -7.0, 0.3}, kAlong, 179.0);
         },
         0.0},
        {"179 degrees of view, eye inside",
         [](const Grid& g) {
             return perspective(g, {0.2, 0.1, 0.3}, kOblique, 179.0);
         },
         0.0},
        {"near plane inside",
         [](const Grid& g) {
             Camera c = parallel(g, kOblique, 8.0);
             c.nearMm = 4.0 * radiusMm(g) + 1.0;
             return c;
         },
         0.0},
        {"near plane behind the volume",
         [](const Grid& g) {
             Camera c = parallel(g, kOblique, 8.0);
             c.nearMm = 1e9;
             return c;
         },
         0.0}};
    for (const View& view : views)
        for (const Mode mode : {Mode::Composite, Mode::Mip, Mode::Average})
            cases.push_back({fmt::format("{}, {}", view.name, name(mode)),
                             [=] { return seen(view.camera, mode); }, AsReference{}, kGrey,
                             "second order at 1/32 voxel; extrema between samples", view.share});
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

}  // namespace

std::vector<ExtremeCase> extremeCases() {
    Cases cases;
    addOpticalDepths(cases);
    addFunctions(cases);
    addVolumes(cases);
    addGrids(cases);
    addValues(cases);
    addCameras(cases);
    addLights(cases);
    return cases;
}

}  // namespace pellucid::accuracy
