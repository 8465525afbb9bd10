// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/stages.h"

#include <algorithm>
#include <array>

#include "scene/check.h"

namespace pellucid::renderer {

std::span<const StageVariant> stageTable() {
    static const std::vector<StageVariant> table{
        {"ray",
         "perspective",
         {"rayBase", "rayAnchorRight", "rayAnchorUp", "rayRight", "rayUp", "rayForward",
          "rayNearFromAnchorMm"},
         {},
         {}},
        {"ray",
         "orthographic",
         {"rayBase", "rayRight", "rayUp", "rayForward", "rayNearFromAnchorMm"},
         {},
         {}},
        {"reconstruct", "nearest", {"volumeTexture"}, {}, {}},
        {"reconstruct", "trilinear", {"volumeTexture"}, {}, {}},
        {"reconstruct", "tricubic_bspline", {"volumeTexture", "volumeSize"}, {}, {}},
        {"reconstruct", "catmull_rom", {"volumeTexture", "volumeSize"}, {}, {}},
        {"reconstruct", "lanczos3", {"volumeTexture"}, {}, {}},
        {"reconstruct", "trilinear_exact", {"volumeTexture"}, {}, {}},
        {"reconstruct", "tricubic_bspline_deboor", {"volumeTexture", "volumeSize"}, {}, {}},
        {"reconstruct", "tricubic_bspline_lut", {"volumeTexture", "filterWeights"}, {}, {}},
        {"bounds", "box", {"boxLo", "boxHi"}, {}, {}},
        {"leap", "cubes", {"leapField", "blocksFromTexture"}, {}, {}},
        {"classify", "tf1d", {"transferTable", "tableFromValue", "extinctionPerMm"}, {}, {}},
        {"classify", "window", {"windowFromValue"}, {}, {}},
        {"classify",
         "pre_classified",
         {"transferTable", "tableFromValue", "extinctionPerMm"},
         {},
         {"reconstruct"}},
        {"integrate", "exponential", {}, {}, {"classify"}},
        {"integrate", "riemann", {}, {}, {"classify"}},
        {"integrate", "trapezoid", {}, {}, {"classify"}},
        {"integrate", "simpson", {}, {}, {"classify", "reconstruct"}},
        {"integrate", "gauss_legendre", {}, {}, {"classify", "reconstruct"}},
        {"segment", "ends", {"preintegrationTable", "fullLengthMm", "extinctionPerMm"}, {}, {}},
        {"segment", "lengths", {"preintegrationTable", "fullLengthMm", "extinctionPerMm"}, {}, {}},
        {"integrate", "preintegrated", {"entryFromValue", "opticsBelow", "opticsAbove"}, {}, {"segment"}},
        {"integrate", "integral_functions", {"integralTable", "integralFromValue"}, {}, {"classify"}},
        {"gradient",
         "central_difference",
         {"voxelStep", "gradientFromIndex", "gradientFloor"},
         {},
         {"reconstruct"}},
        {"gradient",
         "precomputed",
         {"fieldTexture", "fieldScale", "fieldOffset", "differenceFromTexel", "gradientFromIndex",
          "gradientFloor"},
         {},
         {}},
        {"shade", "blinn_phong", {"material"}, {"Lights"}, {"gradient"}},
        {"accumulate", "float32", {}, {}, {}},
        {"accumulate", "half", {}, {}, {}},
        {"accumulate", "unorm8", {}, {}, {}},
        {"terminate", "transmittance", {"terminationTransmittance"}, {}, {}},
        {"compose", "over", {}, {}, {"reconstruct", "integrate", "accumulate"}},
        {"compose", "over_lit", {}, {}, {"integrate", "gradient", "shade", "accumulate"}},
        {"compose", "over_segments", {}, {}, {"integrate", "accumulate"}},
        {"compose", "mip", {}, {}, {"classify"}},
        {"compose", "minip", {}, {}, {"classify"}},
        {"compose", "average", {}, {}, {"classify"}},
        {"compose", "xray_opacity", {}, {}, {"classify"}},
        {"compose", "xray_transmittance", {}, {}, {"classify"}},
        {"compose", "xray_opacity_segments", {}, {}, {"integrate"}},
        {"compose", "xray_transmittance_segments", {}, {}, {"integrate"}},
        {"compose", "emission", {}, {}, {"classify"}},
        {"compose", "first_hit", {"hitExtinctionPerMm"}, {}, {"classify", "reconstruct"}},
        {"compose", "isosurface", {"isovalue"}, {}, {"classify", "reconstruct"}},
        {"compose", "isosurfaces", {}, {"Surfaces"}, {"reconstruct"}},
        {"compose", "slice", {}, {}, {"classify"}},
        {"jitter", "blue_noise", {"blueNoise"}, {}, {}},
        {"traverse", "midpoints", {"stepMm"}, {}, {"reconstruct", "compose"}},
        {"traverse", "midpoints_by_four", {"stepMm"}, {}, {"reconstruct", "compose"}},
        {"traverse", "lit_midpoints_by_four", {"stepMm"}, {}, {"gradient", "compose"}},
        {"traverse", "segments", {"stepMm"}, {}, {"reconstruct", "compose"}},
        {"traverse",
         "adaptive",
         {"stepMm", "shortestStepMm", "tolerance", "mostSegments"},
         {},
         {"reconstruct", "compose"}},
        {"traverse",
         "importance",
         {"stepMm", "longestStepMm", "importanceVolume", "importanceFromTexture", "layerMm",
          "eightTolerances", "kinkWeight"},
         {},
         {"reconstruct", "compose"}},
        {"traverse", "voxels", {}, {}, {"reconstruct", "compose"}},
        {"traverse", "boundaries", {"stepMm"}, {}, {"reconstruct", "compose"}},
        {"traverse", "crossings", {"stepMm"}, {}, {"reconstruct", "compose"}},
        {"traverse", "plane", {"planeForward", "planeFromAnchorMm"}, {}, {"reconstruct", "compose"}},
        {"refine", "extremum", {}, {}, {"reconstruct", "compose"}},
        {"slab", "part", {"slabFromMm", "slabToMm", "slabStepMm"}, {}, {}},
        {"encode", "srgb", {"transparentPicture"}, {}, {}},
    };
    return table;
}

const StageVariant& findVariant(std::string_view stage, std::string_view variant) {
    const auto table = stageTable();
    const auto found = std::find_if(table.begin(), table.end(), [&](const StageVariant& row) {
        return stage == row.stage && variant == row.variant;
    });
    PELLUCID_CHECK(found != table.end());
    return *found;
}

std::span<const char* const> engineUniforms() {
    static constexpr std::array names{"pictureSize", "targetStride", "targetOrigin", "textureFromRender",
                                      "background"};
    return names;
}

namespace {

StageRow rayRow(Projection projection) {
    if (projection == Projection::Orthographic) return {"ray", "orthographic", "the camera is orthographic"};
    return {"ray", "perspective", "the camera is perspective"};
}

StageRow reconstructRow(Filter filter) {
    const auto row = [&](const char* variant) {
        return StageRow{"reconstruct", variant, fmt::format("filter {}", name(filter))};
    };
    switch (filter) {
        case Filter::Nearest:
            return row("nearest");
        case Filter::Trilinear:
            return row("trilinear");
        case Filter::TricubicBSpline:
            return row("tricubic_bspline");
        case Filter::CatmullRom:
            return row("catmull_rom");
        case Filter::Lanczos3:
            return row("lanczos3");
        case Filter::TrilinearExact:
            return row("trilinear_exact");
        case Filter::TricubicBSplineDeBoor:
            return row("tricubic_bspline_deboor");
        case Filter::TricubicBSplineLut:
            break;
    }
    return row("tricubic_bspline_lut");
}

StageRow integrateRow(Integrator integrator) {
    const auto row = [&](const char* variant) {
        return StageRow{"integrate", variant, fmt::format("integrator {}", name(integrator))};
    };
    switch (integrator) {
        case Integrator::Riemann:
            return row("riemann");
        case Integrator::Exponential:
            return row("exponential");
        case Integrator::Trapezoid:
            return row("trapezoid");
        case Integrator::Simpson:
            return row("simpson");
        case Integrator::GaussLegendre:
            return row("gauss_legendre");
        case Integrator::Preintegrated2D:
        case Integrator::Preintegrated3D:
        case Integrator::Importance:
            return row("preintegrated");
        case Integrator::IntegralFunctions:
        case Integrator::Adaptive:
            break;
    }
    return row("integral_functions");
}

StageRow segmentRow(Integrator integrator) {
    if (integrator == Integrator::Preintegrated2D)
        return {"segment", "ends", "segments have one length, but where they are cut"};
    return {"segment", "lengths", "segments have many lengths"};
}

StageRow accumulateRow(Accumulation accumulation) {
    switch (accumulation) {
        case Accumulation::Half:
            return {"accumulate", "half", "accumulation half, for comparison"};
        case Accumulation::EightBit:
            return {"accumulate", "unorm8", "accumulation 8-bit, for comparison"};
        case Accumulation::Float32:
            break;
    }
    return {"accumulate", "float32", "front to back, weights are differences of transmittance"};
}

/// Samples whose value and gradient are one fetch.
bool samplesWholeField(const Features& features) {
    return features.lit && features.gradients == GradientSource::Texture &&
           features.mode == Mode::Composite && !integratesSegments(features.integrator) &&
           features.classification == Classification::Post;
}

StageRow composeRow(const Features& features) {
    const std::string reason = fmt::format("mode {}", name(features.mode));
    const auto row = [&](const char* variant) { return StageRow{"compose", variant, reason}; };
    const bool segments = integratesSegments(features.integrator);
    switch (features.mode) {
        case Mode::Composite:
            if (samplesWholeField(features)) return row("over_lit");
            return row(segments ? "over_segments" : "over");
        case Mode::Mip:
            return row("mip");
        case Mode::MinIp:
            return row("minip");
        case Mode::Average:
            return row("average");
        case Mode::XRay:
            if (features.xray == XRayDisplay::Opacity)
                return row(segments ? "xray_opacity_segments" : "xray_opacity");
            return row(segments ? "xray_transmittance_segments" : "xray_transmittance");
        case Mode::Emission:
            return row("emission");
        case Mode::FirstHit:
            return row("first_hit");
        case Mode::Isosurface:
            return row(features.surfaces > 0 ? "isosurfaces" : "isosurface");
        case Mode::Slice:
            break;
    }
    return row("slice");
}

StageRow traverseRow(const Features& features) {
    const Mode mode = features.mode;
    if (mode == Mode::Slice) return {"traverse", "plane", "a slice is one sample a ray"};
    if (features.surfaces > 0)
        return {"traverse", "crossings", "every crossing of a surface is looked for between samples"};
    if (mode == Mode::FirstHit || mode == Mode::Isosurface)
        return {"traverse", "boundaries", "a surface is searched between samples"};
    if (followsVoxels(features))
        return {"traverse", "voxels", "nearest is constant in each voxel: segments end at its borders"};
    if (features.integrator == Integrator::Adaptive)
        return {"traverse", "adaptive", "steps follow the error estimate of each segment"};
    if (features.integrator == Integrator::Importance)
        return {"traverse", "importance", "steps follow how much the data around bend"};
    if (integratesSegments(features.integrator))
        return {"traverse", "segments", "equal segments, integrated from both ends"};
    if (samplesWholeField(features))
        return {"traverse", "lit_midpoints_by_four",
                "equal segments; value and gradient are one fetch, so four are taken a turn"};
    // Unrolling a wider filter's 8 to 216 fetches would only make the program longer to compile.
    if (features.classification == Classification::Post &&
        (features.filter == Filter::Nearest || features.filter == Filter::Trilinear))
        return {"traverse", "midpoints_by_four",
                "equal segments; a value is one fetch, so four are taken a turn"};
    return {"traverse", "midpoints", "equal segments, each with its own length"};
}

}  // namespace

StageChoice chooseStages(const Features& features) {
    StageChoice choice;
    auto& rows = choice.rows;
    auto& leftOut = choice.leftOut;
    rows.push_back(rayRow(features.projection));
    if (samplesWholeField(features))
        leftOut.push_back({"reconstruct", "values are fetched with their gradients"});
    else
        rows.push_back(reconstructRow(features.filter));
    if (features.skipping != Skipping::None)
        rows.push_back({"bounds", "box", "samples outside the box of what can show are not taken"});
    if (features.skipping == Skipping::Leaps)
        rows.push_back({"leap", "cubes", "blocks in which nothing can show are passed over"});
    if (!usesTransferFunction(features.mode)) {
        rows.push_back({"classify", "window", "the mode shows values through the window"});
        leftOut.push_back({"transfer table", "the mode shows values through the window"});
    } else if (features.surfaces > 0) {
        leftOut.push_back({"classify", "the surfaces have colours of their own"});
    } else if (features.classification == Classification::Pre) {
        rows.push_back(
            {"classify", "pre_classified", "the transfer function is applied to voxels, for comparison"});
    } else if (!usesPreintegration(features.integrator)) {
        rows.push_back({"classify", "tf1d", "colours and extinction come from the transfer function"});
    } else {
        leftOut.push_back({"classify", "the pre-integration table holds what the function would say"});
    }
    const bool integrates = features.mode == Mode::Composite ||
                            (features.mode == Mode::XRay && integratesSegments(features.integrator));
    if (integrates && usesPreintegration(features.integrator))
        rows.push_back(segmentRow(features.integrator));
    if (integrates) rows.push_back(integrateRow(features.integrator));
    if (features.lit) {
        if (features.gradients == GradientSource::Texture)
            rows.push_back({"gradient", "precomputed", "many samples of a ray are lit"});
        else
            rows.push_back({"gradient", "central_difference", "shading needs a normal"});
        rows.push_back(
            {"shade", "blinn_phong",
             fmt::format("the scene has {} light{}", features.lights, features.lights == 1 ? "" : "s")});
    } else {
        const std::string reason =
            usesLights(features.mode) ? "the scene has no light" : "the mode is not lit";
        for (const char* what : {"gradient", "shade", "lights"}) leftOut.push_back({what, reason});
    }
    if (features.mode == Mode::Composite) rows.push_back(accumulateRow(features.accumulation));
    if (features.earlyTermination) {
        rows.push_back({"terminate", "transmittance", "rays stop when nothing behind can show"});
    } else {
        leftOut.push_back({"terminate", features.mode == Mode::Composite
                                            ? "the bound is 0: every ray goes on to its end"
                                            : "the mode needs the whole ray"});
    }
    rows.push_back(composeRow(features));
    if (features.slabs)
        rows.push_back({"slab", "part", "this driver ends loops before rays of so many samples are drawn"});
    else
        leftOut.push_back({"slab", "rays are drawn whole"});
    if (features.jitter) {
        rows.push_back({"jitter", "blue_noise", "ray starts are shifted within a step"});
    } else {
        leftOut.push_back({"jitter", "not asked for, or the mode has no steps of one length"});
    }
    rows.push_back(traverseRow(features));
    if (features.mode == Mode::Mip || features.mode == Mode::MinIp)
        rows.push_back(
            {"refine", "extremum", "the steps miss some of the peak that the extreme value lies on"});
    if (features.space == CompositingSpace::Linear && features.slabs) {
        leftOut.push_back(
            {"encode", "slabs are blended in linear light, what they come to is encoded once read"});
    } else if (features.space == CompositingSpace::Linear) {
        rows.push_back({"encode", "srgb", "colours are blended in linear light"});
    } else {
        leftOut.push_back({"encode", "colours are blended as they are shown"});
    }
    return choice;
}

void changeFeatures(Plan& plan, const Features& features) {
    const auto before = chooseStages(plan.features).leftOut;
    auto choice = chooseStages(features);
    for (auto& row : plan.leftOut)
        if (std::find(before.begin(), before.end(), row) == before.end())
            choice.leftOut.push_back(std::move(row));
    // Reasons may have been made more precise since.
    for (auto& row : choice.rows)
        for (const auto& old : plan.stages)
            if (row.stage == old.stage && row.variant == old.variant) row.reason = old.reason;
    plan.features = features;
    plan.stages = std::move(choice.rows);
    plan.leftOut = std::move(choice.leftOut);
}

}  // namespace pellucid::renderer
