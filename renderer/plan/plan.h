// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "renderer/plan/features.h"
#include "scene/scene.h"

namespace pellucid::renderer {

/// What a plan needs to know of a volume: everything but the voxels.
struct VolumeFacts {
    Grid grid;
    VoxelType type = VoxelType::UInt8;
    ValueRange physicalRange;
    bool descending = false;        ///< Physical values fall where stored ones rise (negative slope).
    double storedExtent = 65535.0;  ///< Largest minus smallest stored value, or more.
    int components = 1;             ///< Values of a voxel in main memory; one of them is drawn.
    bool hasValues = true;          ///< Some voxel is a finite number.
    bool operator==(const VolumeFacts&) const = default;
};
[[nodiscard]] VolumeFacts factsOf(const Volume& volume, int component);

/// One row of a plan: a stage and the shader file chosen for it.
struct StageRow {
    std::string stage;    ///< "reconstruct".
    std::string variant;  ///< "trilinear": the file renderer/shaders/reconstruct/trilinear.glsl.
    std::string reason;
    bool operator==(const StageRow&) const = default;
};

struct ResourceRow {
    std::string name;  ///< "volume", "transfer table", "lights".
    std::string kind;  ///< "texture 3D R16", "uniform block".
    std::uint64_t bytes = 0;
    std::string reason;
    bool operator==(const ResourceRow&) const = default;
};

struct PassRow {
    std::string name;    ///< "ray casting".
    std::string target;  ///< "1024x768 RGBA32F".
    std::uint64_t bytes = 0;
    std::string reason;
    bool operator==(const PassRow&) const = default;
};

struct LeftOutRow {
    std::string what;    ///< "gradient".
    std::string reason;  ///< "no light".
    bool operator==(const LeftOutRow&) const = default;
};

/// Where a transfer function is tabulated: `size` entries at lo ... hi (physical values), both ends included.
/// Outside it is constant, as the table's clamped ends are.
struct TableLayout {
    double lo = 0.0;
    double hi = 1.0;
    int size = 0;
    double worstError =
        0.0;  ///< Largest difference between the table, linearly interpolated, and the function: opacity or
              ///< associated colour of one voxel's length. Exact: it occurs at a control point.
    bool operator==(const TableLayout&) const = default;
};

/// Entries of the table of B-spline weights, for places 0 to 1 between two voxels.
inline constexpr int kFilterWeightTexels = 128;

/// What drawing a scene needs, and nothing else: what is not listed is neither compiled, allocated, computed
/// nor bound. Made without a GPU.
struct Plan {
    Features features;
    std::vector<StageRow> stages;
    std::vector<PassRow> passes;
    std::vector<ResourceRow> resources;
    std::vector<LeftOutRow> leftOut;
    /// Of the transfer table; size 0 without one. Where the function is pre-integrated, lo and hi are the
    /// values it is needed for.
    TableLayout table;
    std::string automatic;  ///< What is chosen only when drawn, a sentence; empty: nothing is.
    double stepMm = 0.0;
    double longestStepMm = 0.0;  ///< stepMm, but where steps follow the data.
    double samplesPerRay = 0.0;  ///< Upper bound: volume diagonal / step.
    /// Parts of equally many samples, one behind the other, that rays are drawn in: a driver may end a
    /// pixel's loops before the whole ray is drawn (DeviceLimits::maxLoopTurns).
    int slabs = 1;
    double earlyTerminationBound = 0.0;  ///< Error bound in display units; 0 when rays never stop early.
    std::uint64_t totalBytes = 0;        ///< GPU memory of passes and resources.
    /// Main memory at the most: the volume as stored, what is known of its blocks, the picture. Where the
    /// driver draws on the processor, totalBytes lie there too.
    std::uint64_t mainBytes = 0;
    std::uint64_t volumeBytes = 0;  ///< Of mainBytes, the volume as stored.
    bool operator==(const Plan&) const = default;
};

/// Precondition: the scene is completed(). Errors: InvalidArgument, Unsupported (more than one volume, grids
/// that are not finite), TooLarge (a size beyond `limits`).
struct DeviceLimits {
    int max3dTextureSize = 2048;
    std::uint64_t maxTextureBytes = 16ull << 30;
    /// Turns of all loops of one pixel after which the driver ends them, right or wrong (llvmpipe: 65535).
    /// Measured.
    double maxLoopTurns = 1e9;
    std::uint64_t maxFieldBytes = 1ull << 30;  ///< Of the texture of values and gradients.
};
[[nodiscard]] Result<Plan> makePlan(const Scene& scene, const std::vector<VolumeFacts>& volumes,
                                    const DeviceLimits& limits = {});

/// Size of the float render target of a picture: as wide, and as high as 128 MB allow. Larger pictures are
/// drawn in bands.
[[nodiscard]] glm::ivec2 targetSize(glm::ivec2 picture);

/// The error asked for: "0.5 grey levels RMSE", "4 grey levels anywhere".
[[nodiscard]] std::string toleranceText(const Quality& quality);

[[nodiscard]] std::string planText(const Plan& plan);
[[nodiscard]] nlohmann::ordered_json planJson(const Plan& plan);

}  // namespace pellucid::renderer
