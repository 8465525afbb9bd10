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
#include "renderer/plan/features.h"
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
    Rays rays = Rays::Oblique;
};

bool isSurface(Mode mode) {
    return mode == Mode::FirstHit || mode == Mode::Isosurface;
}
bool isExtremum(Mode mode) {
    return mode == Mode::Mip || mode == Mode::MinIp;
}

/// Not on random voxels: the B-spline's limit shows on a smooth field, and Lanczos would carry random values
/// beyond the function's line.
bool isOnWaves(Filter filter) {
    return filter == Filter::TricubicBSpline || filter == Filter::Lanczos3;
}

/// What theory says of rays at random places of cells.
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

bool usesTable(const Case& c) {
    return c.mode == Mode::Composite && renderer::usesPreintegration(c.integrator);
}

/// Along an axis every kink lies on a border of segments, and between two of them the value is linear.
OrderRow expectationAlongAxis(const Case& c) {
    OrderRow row = expectation(c);
    if (isSurface(c.mode) || c.mode == Mode::Slice) return row;
    row.tolerance = kSmoothTolerance;
    row.reason = "";
    if (isExtremum(c.mode)) {
        row.reason = "the extreme sample is a sixteenth of a step beside the kink";
    } else if (c.mode == Mode::Average || c.mode == Mode::XRay || usesTable(c)) {
        row.claim = Claim::Independent;
        row.expected = 0.0;
        // Sums of up to 400 floats, positions good to 1e-6 of a voxel; tables of 256 entries or more, between
        // which what is in them is interpolated to some 1e-6.
        row.tolerance = 1e-5;
        row.reason = c.mode == Mode::Composite
                         ? "pre-integration is exact for values linear along a segment"
                         : "a sum of values that are linear in each segment has no error";
    } else {
        row.claim = Claim::Order;
        row.expected = usesIntegrator(c.mode) ? ruleOrder(c.integrator) : 2.0;
    }
    return row;
}

/// An adaptive integrator has no step to refine.
OrderRow expectationOfTolerance(const Case& c) {
    return {"tolerance",
            name(c.mode),
            name(c.integrator),
            name(c.filter),
            Claim::Independent,
            0.0,
            1.0,
            "largest error over the tolerance asked for",
            {8.0, 4.0, 2.0, 1.0, 0.5},
            {}};
}

/// Steps in voxels at which the limit shows.
std::vector<double> stepsOf(const Case& c, const OrderRow& row) {
    // Along an axis only these have borders at all kinks.
    if (row.claim == Claim::Independent)
        return c.rays == Rays::AlongAxis ? std::vector{0.5, 0.25, 0.125} : std::vector{1.0, 0.5, 0.25};
    // Sampled more closely around the extremum, so that its errors are small.
    if (isExtremum(c.mode) && row.expected < 1.5) return {0.125, 0.0625, 0.03125, 0.015625, 0.0078125};
    if (isExtremum(c.mode)) return {1.0, 0.7, 0.5, 0.35, 0.25};
    if (c.rays == Rays::AlongAxis) return {0.5, 0.25, 0.125, 0.0625};
    const bool isFourth = c.filter == Filter::TricubicBSpline && ruleOrder(c.integrator) > 3.0;
    return stepsFor(isFourth ? 4.0 : row.expected, c.filter);
}

OrderRow rowOf(const Case& c) {
    OrderRow row = c.integrator == Integrator::Adaptive ? expectationOfTolerance(c)
                   : c.rays == Rays::AlongAxis          ? expectationAlongAxis(c)
                                                        : expectation(c);
    row.rays = raysName(c.rays);
    if (row.sizes.empty()) row.sizes = stepsOf(c, row);
    return row;
}

VolumePtr volumeFor(const Case& c) {
    if (isSurface(c.mode)) return bumpVolume(24, false);
    if (c.rays == Rays::AlongAxis) return roughVolume();
    if (isExtremum(c.mode)) return bumpVolume(24, c.mode == Mode::MinIp);
    return isOnWaves(c.filter) ? wavesVolume() : roughVolume();
}

Scene sceneFor(const Case& c) {
    // Surfaces: only the part of the bump that faces the viewer, so that no ray grazes it.
    const bool isPart = isSurface(c.mode) || c.mode == Mode::Slice;
    Scene scene = verifyScene(c.mode, c.filter, kPixels, isPart ? 6.0 : kHeightMm, c.rays);
    scene.quality.integrator = c.integrator;
    if (isSurface(c.mode) && c.filter == Filter::Nearest) scene.lights->clear();
    // So dense that errors are well above float rounding.
    if (c.rays == Rays::AlongAxis && c.mode == Mode::Composite) scene.densityScale = 8.0;
    // So tight that every step is the shortest one, whose order this is.
    if (c.integrator == Integrator::Importance) scene.quality.toleranceGreyLevels = 1e-6;
    return scene;
}

std::vector<Integrator> integratorsOf(const Case& c) {
    std::vector<Integrator> integrators;
    // Lanczos takes 216 voxels a sample; what it adds to a rule shows in one mode.
    const bool hasAll = usesIntegrator(c.mode) && (c.filter != Filter::Lanczos3 || c.mode == Mode::Composite);
    for (const auto& integrator : enumNames<Integrator>()) {
        if (!hasAll && integrator.value != Integrator::Exponential) continue;
        // An X-ray has no emission: the same sum as the exponential rule.
        if (c.mode == Mode::XRay && integrator.value == Integrator::Riemann) continue;
        // On voxels of Lanczos there is no room between the step that resolves a cell and float rounding;
        // along an axis fourthOrder() shows them.
        const bool isShown =
            c.filter == Filter::Lanczos3 || (c.rays == Rays::AlongAxis && c.mode == Mode::Composite);
        if (isShown && ruleOrder(integrator.value) > 3.0) continue;
        // Its table is made for steps of several voxels; what that is off by is not the rule's error.
        if (integrator.value == Integrator::Importance && c.rays == Rays::AlongAxis) continue;
        if (integrator.value == Integrator::Importance && !boundsBends(c.filter)) continue;
        integrators.push_back(integrator.value);
    }
    return integrators;
}

/// Cases that differ in the integrator only, which the reference picture does not depend on.
std::vector<Case> groups() {
    std::vector<Case> found;
    for (const auto& mode : enumNames<Mode>())
        for (const Filter filter : {Filter::Nearest, Filter::Trilinear, Filter::TricubicBSpline,
                                    Filter::CatmullRom, Filter::Lanczos3})
            found.push_back({mode.value, Integrator::Exponential, filter});
    for (const auto& mode : enumNames<Mode>()) {
        found.push_back({mode.value, Integrator::Exponential, Filter::TricubicBSpline, Rays::Perspective});
        found.push_back({mode.value, Integrator::Exponential, Filter::Trilinear, Rays::AlongAxis});
    }
    return found;
}

/// Draws the case at each of the row's sizes.
Result<void> measure(renderer::Renderer& renderer, const Case& c, const VolumePtr& volume,
                     const ImageF& exact, OrderRow& row) {
    Scene scene = sceneFor(c);
    const bool isTolerance = c.integrator == Integrator::Adaptive;
    for (const double size : row.sizes) {
        if (isTolerance)
            scene.quality.toleranceGreyLevels = size;
        else
            scene.quality.stepVoxels = size;
        const auto image = pictureOf(renderer, scene, volume);
        if (!image) return tl::unexpected<Error>(image.error());
        const bool isLargest = row.claim == Claim::Independent;
        const double error = isLargest ? largestError(*image, exact) : meanError(*image, exact);
        row.errors.push_back(isTolerance ? error * 255.0 / size : error);
    }
    return {};
}

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
                 {0.5, 0.25},      {},
                 "along an axis"};
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
    const std::vector<Case> all = groups();
    for (std::size_t i = 0; i < all.size(); ++i) {
        Case c = all[i];
        const std::string what = fmt::format("step: {} {}", name(c.mode), name(c.filter));
        const VolumePtr volume = volumeFor(c);
        ReferenceOptions options;
        options.bound = 1e-8;
        options.maxHalvings = 3;
        const auto exact = referencePicture(sceneFor(c), {volume}, options);
        if (!exact) return tl::unexpected<Error>(exact.error());
        for (const Integrator integrator : integratorsOf(c)) {
            if (!goOn(progress, static_cast<double>(i) / static_cast<double>(all.size()), what))
                return fail(ErrorCode::Cancelled, "the verification was cancelled");
            c.integrator = integrator;
            OrderRow row = rowOf(c);
            if (auto drawn = measure(renderer, c, volume, exact->image, row); !drawn)
                return tl::unexpected<Error>(drawn.error());
            if (found) found(row);
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace pellucid::accuracy
