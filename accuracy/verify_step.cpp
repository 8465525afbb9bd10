// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Step refinement: the renderer at several steps against the reference picture of the same voxels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "accuracy/reference.h"
#include "accuracy/synthetic.h"
#include "accuracy/verify_scenes.h"
#include "scene/names.h"

namespace pellucid::accuracy {
namespace {

// Orders are those of the limit; where a jump or a kink of the value decides, the errors are those of many
// borders at random places of a step, and their mean scatters.
constexpr double kSmoothTolerance = 0.15;
constexpr double kRoughTolerance = 0.3;
constexpr int kPixels = 24;
constexpr double kHeightMm = 16.0;  // all rays cross the middle of the box

/// Order of a rule where everything is smooth (docs/equations.md, 8 to 13).
double ruleOrder(Integrator integrator) {
    switch (integrator) {
        case Integrator::Riemann:
            return 1.0;
        case Integrator::Simpson:
        case Integrator::GaussLegendre:
            return 4.0;
        default:
            return 2.0;
    }
}

std::vector<double> stepsFor(double order, Filter filter) {
    // Fourth order leaves little above float rounding: coarse steps.
    if (order > 3.5) return {2.0, 1.7, 1.4, 1.2, 1.0};
    // Where cell borders decide, a step must be shorter than a cell.
    if (order > 2.5) return {0.7, 0.5, 0.35, 0.25};
    if (order > 1.5 && filter != Filter::TricubicBSpline) return {0.35, 0.25, 0.18, 0.125, 0.09};
    if (order > 1.5) return {1.0, 0.7, 0.5, 0.35, 0.25};
    return {0.5, 0.25, 0.125, 0.0625, 0.03125};
}

struct Case {
    Mode mode;
    Integrator integrator = Integrator::Exponential;
    Filter filter = Filter::Trilinear;
};

/// What theory says of a case.
OrderRow expectation(const Case& c) {
    OrderRow row{"step", name(c.mode), usesIntegrator(c.mode) ? name(c.integrator) : "", name(c.filter)};
    const double rule = usesIntegrator(c.mode) ? ruleOrder(c.integrator) : 2.0;
    const double border = smoothnessOf(c.filter) + 1.0;
    row.expected = std::min(rule, border);
    const bool rough = border <= 2.0 && border <= rule;
    row.tolerance = rough ? kRoughTolerance : kSmoothTolerance;
    if (border < rule) row.reason = whyOf(c.filter) + fmt::format(": order {:g} at most", border);
    if (rough && border == rule)
        row.reason = whyOf(c.filter) + ", at random places of a step: as large an error of the same order";
    if (rule > 3.0 && border > 2.0) {
        // Between the step that resolves a cell and float rounding (1e-6) there is no room for the limit.
        row.claim = Claim::AtLeast;
        row.expected = c.filter == Filter::CatmullRom ? 3.0 : 2.0;
        row.reason = whyOf(c.filter) + "; order 4 shows on a field linear along the ray";
    }
    switch (c.mode) {
        case Mode::Mip:
        case Mode::MinIp:
            // A smooth extremum at distance d from a sample is missed by f'' d^2 / 2, one at a kink by f' d.
            row.expected = c.filter == Filter::Nearest || c.filter == Filter::Trilinear ? 1.0 : 2.0;
            row.tolerance = row.expected == 1.0 ? kRoughTolerance : kSmoothTolerance;
            row.reason = c.filter == Filter::Nearest
                             ? "an extreme voxel crossed by less than a step is missed"
                         : c.filter == Filter::Trilinear ? "extrema lie on kinks at voxel centres, where a "
                                                           "sample beside them is wrong by slope x distance"
                                                         : "";
            break;
        case Mode::FirstHit:
        case Mode::Isosurface:
            row.claim = Claim::Independent;
            row.expected = 0.0;
            // The root is halved to a millionth of a step (docs/equations.md, Projections); the shade changes
            // by at most 1 a voxel there, and a float position in the box is good to 1e-6 of a voxel.
            row.tolerance = 1e-4;
            row.reason = "the root is refined to 1e-6 of a step, whatever the step";
            break;
        case Mode::Slice:
            row.claim = Claim::Independent;
            row.expected = 0.0;
            row.tolerance = 1e-5;  // a value interpolated in float on coordinates good to 1e-6 of a voxel
            row.reason = "one sample a pixel, no step";
            break;
        default:
            break;
    }
    return row;
}

VolumePtr volumeFor(Mode mode, Filter filter) {
    const bool surface = mode == Mode::FirstHit || mode == Mode::Isosurface;
    if (surface || mode == Mode::Mip) return bumpVolume(24, false);
    if (mode == Mode::MinIp) return bumpVolume(24, true);
    return filter == Filter::TricubicBSpline ? wavesVolume() : roughVolume();
}

Scene sceneFor(const Case& c) {
    // Surfaces: only the part of the bump that faces the viewer, so that no ray grazes it.
    const bool surface = c.mode == Mode::FirstHit || c.mode == Mode::Isosurface;
    Scene scene = verifyScene(c.mode, c.filter, kPixels, surface || c.mode == Mode::Slice ? 6.0 : kHeightMm);
    scene.quality.integrator = c.integrator;
    if (surface && c.filter == Filter::Nearest) scene.lights->clear();
    return scene;
}

}  // namespace

namespace {

/// Fourth order, on values linear along the rays between outer voxel centres; the kinks there lie on segment
/// borders.
Result<OrderRow> fourthOrder(renderer::Renderer& renderer, Integrator integrator) {
    const Grid grid = axisAlignedGrid({1, 3, 1});
    const VolumePtr volume = sampledVolume(grid, VoxelType::Float64, [](glm::ivec3 i) { return 0.5 * i.y; });
    Scene scene = verifyScene(Mode::Composite, Filter::Trilinear, 1, 0.5);
    scene.densityScale = 1.0;
    scene.volumes.front().transferFunction =
        TransferFunction1D{"line", "", {{0.0, {0.0, 1.0, 0.0}, 0.5}, {1.0, {1.0, 0.0, 1.0}, 4.0}}};
    scene.camera.pose =
        CameraPose{centreMm(grid) - glm::dvec3(0.0, 10.0, 0.0), centreMm(grid), {0, 0, 1}, 0.5};
    scene.quality.integrator = integrator;
    ReferenceOptions options;
    options.bound = 1e-9;
    const auto exact = referencePicture(scene, {volume}, options);
    if (!exact) return tl::unexpected<Error>(exact.error());
    OrderRow row{"step",           name(scene.mode),
                 name(integrator), "linear field",
                 Claim::Order,     4.0,
                 kSmoothTolerance, "",
                 {0.5, 0.25},      {}};
    for (const double size : row.sizes) {
        scene.quality.stepVoxels = size;
        const auto image = pictureOf(renderer, scene, volume);
        if (!image) return tl::unexpected<Error>(image.error());
        row.errors.push_back(meanError(*image, exact->image));
    }
    return row;
}

}  // namespace

Result<std::vector<OrderRow>> verifyStepOrders(renderer::Renderer& renderer, const Progress& progress,
                                               const OrderFound& found) {
    std::vector<OrderRow> rows;
    for (const Integrator integrator : {Integrator::Simpson, Integrator::GaussLegendre}) {
        auto row = fourthOrder(renderer, integrator);
        if (!row) return tl::unexpected<Error>(row.error());
        if (found) found(*row);
        rows.push_back(std::move(*row));
    }
    const auto modes = enumNames<Mode>();
    constexpr std::array kFilters{Filter::Nearest, Filter::Trilinear, Filter::TricubicBSpline,
                                  Filter::CatmullRom};
    double done = 0.0;
    const double all = static_cast<double>(modes.size() * kFilters.size());
    for (const auto& mode : modes) {
        for (const Filter filter : kFilters) {
            const std::string what = fmt::format("step: {} {}", mode.name, name(filter));
            const double fraction = done++ / all;
            const VolumePtr volume = volumeFor(mode.value, filter);
            ReferenceOptions options;
            options.bound = 1e-8;
            options.maxHalvings = 3;
            auto exact =
                referencePicture(sceneFor({mode.value, Integrator::Exponential, filter}), {volume}, options);
            if (!exact) return tl::unexpected<Error>(exact.error());
            for (const auto& integrator : enumNames<Integrator>()) {
                if (!goOn(progress, fraction, what))
                    return fail(ErrorCode::Cancelled, "the verification was cancelled");
                if (integrator.value == Integrator::Adaptive && !usesIntegrator(mode.value)) continue;
                if (!usesIntegrator(mode.value) && integrator.value != Integrator::Exponential) continue;
                // An X-ray has no emission: the same sum as the exponential rule.
                if (mode.value == Mode::XRay && integrator.value == Integrator::Riemann) continue;
                if (integrator.value == Integrator::Importance && !boundsBends(filter)) continue;
                const Case c{mode.value, integrator.value, filter};
                OrderRow row = expectation(c);
                Scene scene = sceneFor(c);
                // So tight that every step is the shortest one, whose order this is.
                if (integrator.value == Integrator::Importance) scene.quality.toleranceGreyLevels = 1e-6;
                if (integrator.value == Integrator::Adaptive) {
                    row = {"tolerance",
                           mode.name,
                           integrator.name,
                           name(filter),
                           Claim::Independent,
                           0.0,
                           1.0,
                           "largest error over the tolerance asked for",
                           {8.0, 4.0, 2.0, 1.0, 0.5},
                           {}};
                } else {
                    row.sizes =
                        row.claim == Claim::Independent
                            ? std::vector{1.0, 0.5, 0.25}
                            : stepsFor(filter == Filter::TricubicBSpline && ruleOrder(integrator.value) > 3.0
                                           ? 4.0
                                           : row.expected,
                                       filter);
                    // Sampled more closely around the extremum, so that its errors are small.
                    if (mode.value == Mode::Mip || mode.value == Mode::MinIp)
                        row.sizes = row.expected < 1.5
                                        ? std::vector{0.125, 0.0625, 0.03125, 0.015625, 0.0078125}
                                        : std::vector{1.0, 0.7, 0.5, 0.35, 0.25};
                }
                for (const double size : row.sizes) {
                    if (integrator.value == Integrator::Adaptive)
                        scene.quality.toleranceGreyLevels = size;
                    else
                        scene.quality.stepVoxels = size;
                    const auto image = pictureOf(renderer, scene, volume);
                    if (!image) return tl::unexpected<Error>(image.error());
                    double error = meanError(*image, exact->image);
                    if (row.claim == Claim::Independent) error = largestError(*image, exact->image);
                    if (integrator.value == Integrator::Adaptive) error *= 255.0 / size;
                    row.errors.push_back(error);
                }
                if (found) found(row);
                rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

}  // namespace pellucid::accuracy
