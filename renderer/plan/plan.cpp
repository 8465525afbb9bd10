// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/plan.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/blocks.h"
#include "renderer/plan/gradients.h"
#include "renderer/plan/importance.h"
#include "renderer/plan/number_limits.h"
#include "renderer/plan/preintegration.h"
#include "renderer/plan/skipping.h"
#include "renderer/plan/slabs.h"
#include "renderer/plan/stages.h"
#include "renderer/plan/transfer_table.h"
#include "renderer/plan/volume_format.h"
#include "scene/check.h"

namespace pellucid::renderer {

namespace {

// A ray beyond this many segments is refused rather than drawn for minutes; float counts it exactly.
constexpr double kMaxSamplesPerRay = 16777216.0;
// std140: two vec4.
constexpr std::uint64_t kBytesPerLight = 32;
constexpr std::uint64_t kBytesPerSurface = 32;
constexpr int kMaxLights = 256;  // 16 KB guaranteed for a uniform block leaves room for 512

Result<void> checkVolume(const VolumeFacts& facts, const DeviceLimits& limits) {
    if (auto valid = validate(facts.grid); !valid) return tl::unexpected(valid.error());
    if (!facts.hasValues)
        return fail(ErrorCode::Unsupported,
                    "no voxel of the volume is a finite number (all are NaN or infinite): there is nothing "
                    "to draw");
    if (!std::isfinite(facts.physicalRange.hi - facts.physicalRange.lo))
        return fail(ErrorCode::Unsupported,
                    fmt::format("the values {:g} ... {:g} span more than a float64 can hold",
                                facts.physicalRange.lo, facts.physicalRange.hi));
    const auto size = facts.grid.size;
    const int largest = std::max({size.x, size.y, size.z});
    if (largest > limits.max3dTextureSize)
        return fail(
            ErrorCode::TooLarge,
            fmt::format("the volume has {} x {} x {} voxels; this OpenGL driver allows {} along an axis",
                        size.x, size.y, size.z, limits.max3dTextureSize));
    const std::uint64_t bytes = textureBytes(facts);
    if (bytes > limits.maxTextureBytes)
        return fail(ErrorCode::TooLarge,
                    fmt::format("the volume needs {} MB as a texture; the limit is {} MB", bytes >> 20,
                                limits.maxTextureBytes >> 20));
    return {};
}

bool has(const Plan& plan, std::string_view stage, std::string_view variant) {
    return std::any_of(plan.stages.begin(), plan.stages.end(),
                       [&](const StageRow& row) { return row.stage == stage && row.variant == variant; });
}

/// Combinations that no picture is defined for.
Result<void> checkChoices(const Features& features, const Quality& quality) {
    const bool importance = features.integrator == Integrator::Importance;
    if (importance && !boundsBends(features.filter))
        return fail(
            ErrorCode::Unsupported,
            fmt::format("/quality/integrator: importance bounds how far a value leaves a line by the second "
                        "differences of the voxels, which the filter {} does not keep to; take "
                        "trilinear or tricubic-bspline",
                        name(features.filter)));
    if (features.classification == Classification::Post) return {};
    if (quality.automatic)
        return fail(
            ErrorCode::Unsupported,
            "/quality: settings are chosen for post-classified pictures only; state stepVoxels beside "
            "the classification pre");
    if (integratesSegments(features.integrator))
        return fail(
            ErrorCode::Unsupported,
            fmt::format(
                "/volumes/0/classification: pre-classified colours are not a function of one value, as the "
                "integrator {} needs; take exponential or riemann",
                name(features.integrator)));
    if (fieldOf(features.filter) != Filter::Trilinear)
        return fail(
            ErrorCode::Unsupported,
            fmt::format("/volumes/0/classification: pre-classified colours are interpolated linearly; take "
                        "the filter trilinear or nearest in place of {}",
                        name(features.filter)));
    return {};
}

Result<void> checkSamples(const Plan& plan) {
    if (plan.samplesPerRay <= kMaxSamplesPerRay) return {};
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/quality: a step of {:g} mm makes {:.3g} samples on the longest ray; at "
                            "most {:.0f} are allowed",
                            plan.stepMm, plan.samplesPerRay, kMaxSamplesPerRay));
}

TableLayout layoutFor(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    const auto& item = scene.volumes.front();
    PELLUCID_CHECK(item.transferFunction.has_value() && scene.unitLengthMm.has_value());
    // Not over a step: the errors of many small steps add up to those of a long one.
    const double voxelInUnits = smallestSpacingMm(facts.grid) / *scene.unitLengthMm * scene.densityScale;
    const auto function = inCompositingSpace(*item.transferFunction, plan.features.space);
    // A surface has the function's colour, however transparent that is.
    return layoutTable(scene.mode == Mode::Isosurface ? function : visiblePart(function),
                       reachableValues(facts.physicalRange, item.filter), voxelInUnits);
}

void addTransferTable(Plan& plan, const Scene& scene, const VolumeFacts& facts) {
    plan.table = layoutFor(scene, plan, facts);
    if (!has(plan, "classify", "tf1d") && !has(plan, "classify", "pre_classified")) {
        plan.table.size = 0;
        plan.table.worstError = 0.0;
        return;
    }
    plan.resources.push_back(
        {"transfer table", "texture 1D RGBA32F", static_cast<std::uint64_t>(plan.table.size) * 16,
         fmt::format("{} entries over {:g} ... {:g}; largest difference from the function {:.2g}",
                     plan.table.size, plan.table.lo, plan.table.hi, plan.table.worstError)});
}

void addPreintegration(Plan& plan, const Scene& scene, const VolumeFacts& facts) {
    const auto integrator = plan.features.integrator;
    if (usesPreintegration(integrator)) {
        const auto layout = layoutPreintegration(scene, plan, facts);
        const auto entries =
            static_cast<std::uint64_t>(layout.size) * static_cast<std::uint64_t>(layout.size * layout.layers);
        plan.resources.push_back({"pre-integration table",
                                  isPerLength(layout) ? "texture 3D RGBA32F" : "texture 2D array RGBA32F",
                                  entries * 16,
                                  fmt::format("{0} x {0} end values over {1:g} ... {2:g}, {3} lengths",
                                              layout.size, layout.lo, layout.hi, layout.layers)});
    } else if (usesRunningIntegrals(integrator)) {
        const int size = integralTableSize(facts.type);
        plan.resources.push_back({"integral table", "texture 1D RGBA32F",
                                  static_cast<std::uint64_t>(size) * 16,
                                  fmt::format("running integrals at {} values", size)});
    }
    if (integrator == Integrator::Importance)
        plan.resources.push_back(
            {"importance volume", "texture 3D RG32F", importanceBytes(facts.grid),
             fmt::format("how much the data bend in blocks of {0} x {0} x {0} voxels; steps "
                         "of {1:g} to {2:g} mm",
                         kBlockEdge, plan.stepMm, plan.longestStepMm)});
}

void addMainMemory(Plan& plan, const Scene& scene, const VolumeFacts& facts) {
    // Least and largest value of each block in 16 bits, and while a function's occupancy is made a byte each
    // for what it is and for the leaps.
    constexpr std::uint64_t kBytesPerBlock = 4 + 2;
    // Floats of the frame, and the 8 bits that are shown or written.
    constexpr std::uint64_t kBytesPerPixel = 16 + 3;
    plan.volumeBytes = cellCount(facts.grid.size) * bytesPerComponent(facts.type) *
                       static_cast<std::uint64_t>(facts.components);
    plan.mainBytes = plan.volumeBytes + kBytesPerPixel * static_cast<std::uint64_t>(scene.picture.size.x) *
                                            static_cast<std::uint64_t>(scene.picture.size.y);
    if (plan.features.skipping != Skipping::None)
        plan.mainBytes += kBytesPerBlock * cellCount(blockCount(facts.grid.size));
}

}  // namespace

std::string toleranceText(const Quality& quality) {
    return fmt::format("{:g} grey levels {}", toleranceGreyLevels(quality),
                       quality.toleranceNorm == ErrorNorm::Max ? "anywhere" : "RMSE");
}

VolumeFacts factsOf(const Volume& volume, int component) {
    const ValueRange stored = volume.storedRange(component);
    return {volume.grid(),
            volume.type(),
            volume.physicalRange(component),
            volume.mapping().slope < 0.0,
            stored.hi - stored.lo,
            volume.components(),
            volume.hasValues(component)};
}

glm::ivec2 targetSize(glm::ivec2 picture) {
    // Large pictures are drawn in bands, so that the float target stays within 128 MB.
    constexpr int kMaxTargetPixels = 8 << 20;
    return {picture.x, std::clamp(kMaxTargetPixels / std::max(picture.x, 1), 1, picture.y)};
}

Result<Plan> makePlan(const Scene& scene, const std::vector<VolumeFacts>& volumes,
                      const DeviceLimits& limits) {
    if (auto valid = validate(scene); !valid) return tl::unexpected(valid.error());
    if (volumes.size() != 1 || scene.volumes.size() != 1)
        return fail(ErrorCode::Unsupported, fmt::format("the scene has {} volumes; exactly one can be drawn",
                                                        std::max(volumes.size(), scene.volumes.size())));
    const VolumeFacts& facts = volumes.front();
    if (auto fits = checkVolume(facts, limits); !fits) return tl::unexpected(fits.error());

    Plan plan;
    plan.features = featuresOf(scene);
    if (plan.features.lights > kMaxLights)
        return fail(ErrorCode::TooLarge, fmt::format("the scene has {} lights; at most {} are allowed",
                                                     plan.features.lights, kMaxLights));
    if (scene.quality.automatic && scene.mode != Mode::Slice)
        plan.automatic = fmt::format(
            "integrator and step are chosen when drawn, for an error of at most {}; shown is what is stated",
            toleranceText(scene.quality));
    if (auto fine = checkChoices(plan.features, scene.quality); !fine) return tl::unexpected(fine.error());
    plan.stepMm = stepMm(scene.quality, facts.grid);
    plan.longestStepMm = plan.stepMm;
    if (plan.features.integrator == Integrator::Importance)
        plan.longestStepMm = std::max(plan.stepMm, longestImportanceStepMm(facts.grid, plan.features.filter));
    if (auto fine = checkNumbers(scene, plan, facts.grid); !fine) return tl::unexpected(fine.error());
    plan.samplesPerRay =
        scene.mode == Mode::Slice ? 1.0 : std::ceil(2.0 * radiusMm(facts.grid) / plan.stepMm);
    // Borders of voxels are crossed once each.
    if (followsVoxels(plan.features))
        plan.samplesPerRay = facts.grid.size.x + facts.grid.size.y + facts.grid.size.z;
    auto choice = chooseStages(plan.features);
    plan.stages = std::move(choice.rows);
    plan.leftOut = std::move(choice.leftOut);
    if (auto fine = checkSamples(plan); !fine) return tl::unexpected(fine.error());
    if (plan.features.earlyTermination) plan.earlyTerminationBound = scene.quality.earlyTermination;

    const auto target = targetSize(scene.picture.size);
    plan.passes.push_back(
        {"ray casting", fmt::format("{}x{} RGBA32F", target.x, target.y),
         static_cast<std::uint64_t>(target.x) * static_cast<std::uint64_t>(target.y) * 16,
         scene.quality.interpolationGreyLevels
             ? fmt::format("accumulates in 32-bit float; a ray every fourth pixel, more where "
                           "interpolation would be wrong by {:g} grey levels",
                           *scene.quality.interpolationGreyLevels)
             : "accumulates in 32-bit float, drawn tile by tile"});
    plan.resources.push_back({"volume", fmt::format("texture 3D {}", textureFormatName(facts.type)),
                              textureBytes(facts),
                              fmt::format("{} x {} x {} voxels of {}", facts.grid.size.x, facts.grid.size.y,
                                          facts.grid.size.z, name(facts.type))});
    if (usesTransferFunction(scene.mode)) addTransferTable(plan, scene, facts);
    addPreintegration(plan, scene, facts);
    if (plan.features.filter == Filter::TricubicBSplineLut)
        plan.resources.push_back(
            {"filter weights", "texture 1D RGBA32F", kFilterWeightTexels * 16,
             fmt::format("four weights at {} places between voxels", kFilterWeightTexels)});
    if (plan.features.jitter)
        plan.resources.push_back(
            {"blue noise", "texture 2D R32F", 64 * 64 * 4, "one offset a pixel, repeated"});
    if (plan.features.lit)
        plan.resources.push_back(
            {"lights", "uniform block", kBytesPerLight * static_cast<std::uint64_t>(plan.features.lights),
             fmt::format("{} light{}", plan.features.lights, plan.features.lights == 1 ? "" : "s")});
    if (plan.features.surfaces > 0)
        plan.resources.push_back({"isosurfaces", "uniform block",
                                  kBytesPerSurface * static_cast<std::uint64_t>(plan.features.surfaces),
                                  fmt::format("{} surfaces, ascending", plan.features.surfaces)});
    for (const auto& pass : plan.passes) plan.totalBytes += pass.bytes;
    for (const auto& resource : plan.resources) plan.totalBytes += resource.bytes;
    planSkipping(plan, scene, facts);
    if (auto fine = planGradients(plan, scene, facts, limits); !fine) return tl::unexpected(fine.error());
    if (auto fine = fitLoops(plan, limits); !fine) return tl::unexpected(fine.error());
    addMainMemory(plan, scene, facts);
    return plan;
}

}  // namespace pellucid::renderer
