// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rows of the table of extreme cases: optical depths and transfer functions.
#include <fmt/format.h>

#include <cmath>

#include "accuracy/extreme_scenes.h"
#include "accuracy/synthetic.h"
#include "renderer/plan/features.h"
#include "scene/names.h"

namespace pellucid::accuracy::extreme {

void addOpticalDepths(Cases& cases) {
    // Transmittances just below 1 are multiples of 2^-24, and the sum of their differences is that of the
    // first and the last: one unit is lost at most. 64 steps show 4.8e-7 of the brightest channel.
    constexpr double kFaint = 6e-8;
    for (const double perStep : {1e-8, 1e-4, 1.0, 1e3, 1e6})
        for (const auto& integrator : enumNames<Integrator>()) {
            // Emission without its own attenuation is right only where a step is thin.
            if (integrator.value == Integrator::Riemann && perStep > 1e-6) continue;
            const bool faint = perStep < 1e-6;
            const double step = faint ? 0.25 : 1.0;
            cases.push_back(
                {fmt::format("tau * step = {:g}, composite, {}", perStep, integrator.name),
                 [=, i = integrator.value] { return slab(perStep / step, step, i, Mode::Composite); },
                 EveryPixel{shown(16.0 * perStep / step)}, faint ? kFaint : 2e-6,
                 faint ? "c (1 - exp(-tau)), 6.4e-7 c; float holds 1 - T to 2^-24, a unit in the last place "
                         "of the transmittance"
                       : "c (1 - exp(-tau)); weights telescope: float roundings of 16 exponentials"});
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
                     EveryPixel{glm::dvec4(0.0)}, 0.0, "nothing is drawn", 0.0, true});
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

namespace {

/// Rules that integrate the function between the values at both ends of a segment, and so miss no peak.
bool integratesFunction(Integrator integrator) {
    return renderer::usesPreintegration(integrator) || renderer::usesRunningIntegrals(integrator);
}

/// The value rises linearly from 0 to 1 between the outer voxel centres.
ExtremeScene ramp(TransferFunction1D function, Integrator integrator, double stepVoxels) {
    const Grid grid = axisAlignedGrid({4, 33, 4});
    Scene scene = sceneOf(std::move(function), parallel(grid, kAlong, 2.0));
    scene.quality.integrator = integrator;
    scene.quality.stepVoxels = stepVoxels;
    return {scene, sampledVolume(grid, VoxelType::Float32, [](glm::ivec3 i) { return i.y / 32.0; })};
}

/// Width 2 w and area 1 / 16 value: depth 2 of 32 mm whatever the width. Not at a place where rays of steps
/// of a voxel take a sample.
TransferFunction1D peak(double w) {
    constexpr double kAt = (16.0 + 0.3) / 32.0;
    return {"peak", "", {{kAt - w, kColor, 0.0}, {kAt, kColor, 1.0 / (16.0 * w)}, {kAt + w, kColor, 0.0}}};
}

Truth truthOf(Integrator integrator, double depth) {
    if (integratesFunction(integrator)) return EveryPixel{shown(depth)};
    return Admitted{shown(depth)};
}

}  // namespace

void addFunctions(Cases& cases) {
    const TransferFunction1D jump{"jump", "", {{0.5, kColor, 0.0}, {0.5, kColor, 0.125}}};
    for (const auto& integrator : enumNames<Integrator>()) {
        const bool whole = integratesFunction(integrator.value);
        for (const double w : {1e-2, 1e-6, 1e-12})
            cases.push_back(
                {fmt::format("peak of width {:g} of the values, {}", 2.0 * w, integrator.name),
                 [w, i = integrator.value] { return ramp(peak(w), i, 1.0); }, truthOf(integrator.value, 2.0),
                 1e-3,
                 whole ? "integrals of the function know the peak's area: depth 2; float positions over 4096 "
                         "entries leave 1e-3"
                       : "depth 2, which samples a voxel apart miss: told by the frame's own estimate"});
        cases.push_back(
            {fmt::format("function that jumps, {}", integrator.name),
             [=, i = integrator.value] { return ramp(jump, i, 1.0); },
             truthOf(integrator.value, 0.125 * 16.5), 1e-3,
             whole ? "half of the slab is dense: depth 2.06; an entry of 1/4096 of the values is 1/128 voxel"
                   : "depth 2.06, but for half a step: told by the frame's own estimate"});
    }
    cases.push_back(
        {"function that jumps, post-classified",
         [=] { return ramp(jump, Integrator::Exponential, 1.0 / 64.0); }, EveryPixel{shown(0.125 * 16.5)},
         1e-3,
         "the table has an entry each 1/16384 of the values, 1/512 voxel: 3e-4 of depth, and half a step"});
    cases.push_back(
        {"function of 65536 points",
         [] {
             TransferFunction1D function{"many", "", {}};
             for (int i = 0; i < 65536; ++i)
                 function.points.push_back({i / 65535.0, kColor, 0.125 * (i % 2)});
             return ramp(function, Integrator::IntegralFunctions, 1.0);
         },
         EveryPixel{shown(0.0625 * 32.0 + 0.125 * 0.5)}, 1e-3,
         "saw teeth: mean extinction 1/16 over 32 mm, 1/8 in the last half voxel (and 0 in the first)"});
}

}  // namespace pellucid::accuracy::extreme
