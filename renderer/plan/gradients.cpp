// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/gradients.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/blocks.h"
#include "renderer/plan/slabs.h"
#include "renderer/plan/stages.h"
#include "renderer/plan/volume_format.h"

namespace pellucid::renderer {

namespace {

constexpr const char* kResource = "values and gradients";
constexpr const char* kLeftOut = "gradient texture";
constexpr double kLargest = 32767.0;  // a difference, in texels to each side of the middle

/// Why a texture would not give the same gradients; null when it does.
const char* whyNotExact(const Features& features) {
    if (features.filter == Filter::Trilinear) return nullptr;
    return "differences interpolated by the texture unit are those of the field with the filter trilinear "
           "only";
}

std::string rowReason(const FieldLayout& layout) {
    const std::string what = "a lit sample is one fetch; gradients ";
    if (layout.worstError() == 0.0) return what + "exact to float rounding";
    return what + fmt::format("off by at most {:.2g} of the data's range a voxel", layout.worstError());
}

}  // namespace

glm::dvec2 FieldLayout::differenceFromTexel() const {
    if (!in16Bits) return {0.5, 0.0};
    return {0.5 * 65535.0 / (texelsPerStored * storedFromTexel), 32768.0 / 65535.0};
}

double FieldLayout::worstError() const {
    // Rounded to half a texel; half the difference over two voxels.
    return texelsPerStored < 1.0 ? 0.25 / kLargest : 0.0;
}

std::uint64_t FieldLayout::bytes() const {
    return cellCount(size) * (in16Bits ? 8u : 16u);
}

FieldLayout layoutField(const VolumeFacts& facts) {
    FieldLayout layout;
    layout.size = facts.grid.size + 2;
    layout.in16Bits = isStoredIn16Bits(facts.type);
    if (!layout.in16Bits) return layout;
    layout.storedFromTexel = storedFromTexel(facts.type, {}).scale;
    // As many texels a stored value as there is room for: small differences are far from rounding.
    const double room = kLargest / std::max(facts.storedExtent, 1.0);
    layout.texelsPerStored = room < 1.0 ? room : std::floor(room);
    return layout;
}

Result<void> planGradients(Plan& plan, const Scene& scene, const VolumeFacts& facts,
                           const DeviceLimits& limits) {
    if (!plan.features.lit) return {};
    const bool asked = scene.quality.gradients == Gradients::Texture;
    const FieldLayout layout = layoutField(facts);
    const auto leaveOut = [&](const std::string& reason) {
        plan.leftOut.push_back({kLeftOut, reason});
        return Result<void>();
    };
    if (scene.quality.gradients == Gradients::OnTheFly) return leaveOut("not asked for");
    if (const char* reason = whyNotExact(plan.features)) {
        if (!asked) return leaveOut(reason);
        return fail(ErrorCode::Unsupported, fmt::format("/quality/gradients: {}", reason));
    }
    if (scene.mode != Mode::Composite && !asked) return leaveOut("few samples of a ray are lit");
    const int largest = std::max({layout.size.x, layout.size.y, layout.size.z});
    if (largest > limits.max3dTextureSize || layout.bytes() > limits.maxFieldBytes) {
        const std::string reason =
            fmt::format("it would take {} x {} x {} texels, {} MB; {} along an axis and {} MB are allowed",
                        layout.size.x, layout.size.y, layout.size.z, layout.bytes() >> 20,
                        limits.max3dTextureSize, limits.maxFieldBytes >> 20);
        if (!asked) return leaveOut(reason);
        return fail(ErrorCode::TooLarge, fmt::format("/quality/gradients: {}", reason));
    }
    Features features = plan.features;
    features.gradients = GradientSource::Texture;
    changeFeatures(plan, features);
    plan.resources.push_back({kResource, fmt::format("texture 3D {}", layout.in16Bits ? "RGBA16" : "RGBA32F"),
                              layout.bytes(), rowReason(layout)});
    plan.totalBytes += layout.bytes();
    return {};
}

Result<void> dropGradientTexture(Plan& plan, const DeviceLimits& limits, const std::string& reason) {
    Features features = plan.features;
    features.gradients = GradientSource::OnTheFly;
    changeFeatures(plan, features);
    plan.leftOut.push_back({kLeftOut, reason});
    std::erase_if(plan.resources, [&](const ResourceRow& row) {
        if (row.name != kResource) return false;
        plan.totalBytes -= row.bytes;
        return true;
    });
    return fitLoops(plan, limits);
}

}  // namespace pellucid::renderer
