// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/skipping.h"

#include <algorithm>

#include "renderer/plan/shown_values.h"
#include "renderer/plan/stages.h"
#include "renderer/plan/transfer_table.h"

namespace pellucid::renderer {

namespace {

constexpr const char* kLeapField = "leap field";
constexpr const char* kLeaps = "leaps";
constexpr const char* kEmptyBlocks = "empty blocks";

/// Why values alone cannot tell that a sample does not matter; null when they can.
const char* whyNot(const Features& features) {
    if (features.integrator == Integrator::Adaptive) return "adaptive steps depend on all they pass";
    if (features.integrator == Integrator::Importance) return "steps follow the data, empty or not";
    if (features.surfaces > 0) return "a crossing may lie between any two samples";
    if (features.classification == Classification::Pre)
        return "pre-classified for comparison: every sample is taken";
    if (features.mode == Mode::Slice) return "a slice is one sample a ray";
    if (features.mode == Mode::Average) return "a mean counts every value";
    return nullptr;
}

bool everyValueShows(const Scene& scene, const Plan& plan, const VolumeFacts& facts) {
    const ValueRange all = reachableValues(facts.physicalRange, scene.volumes.front().filter);
    const auto shown = shownValues(scene, plan, facts);
    return std::any_of(shown.begin(), shown.end(),
                       [&](const ValueRange& range) { return range.lo <= all.lo && range.hi >= all.hi; });
}

/// Puts a choice into the plan in place of the one before. `leftOut`: what was not chosen, and why.
void choose(Plan& plan, Skipping skipping, const std::vector<LeftOutRow>& leftOut) {
    std::erase_if(plan.leftOut,
                  [](const LeftOutRow& row) { return row.what == kLeaps || row.what == kEmptyBlocks; });
    Features features = plan.features;
    features.skipping = skipping;
    changeFeatures(plan, features);
    plan.leftOut.insert(plan.leftOut.end(), leftOut.begin(), leftOut.end());
    if (skipping == Skipping::Leaps) return;
    std::erase_if(plan.resources, [&](const ResourceRow& row) {
        if (row.name != kLeapField) return false;
        plan.totalBytes -= row.bytes;
        return true;
    });
}

void addLeapField(Plan& plan, glm::ivec3 blocks) {
    const std::uint64_t count = cellCount(blocks);
    plan.resources.push_back(
        {kLeapField, "texture 3D R8UI", count,
         fmt::format("how far the next of {} x {} x {} blocks is that can show; their value ranges take {} "
                     "bytes beside it, in main memory",
                     blocks.x, blocks.y, blocks.z, 4 * count)});
    plan.totalBytes += count;
}

}  // namespace

void planSkipping(Plan& plan, const Scene& scene, const VolumeFacts& facts) {
    const auto none = [&](const std::string& reason) {
        choose(plan, Skipping::None, {{kEmptyBlocks, reason}});
    };
    if (!scene.quality.skipEmpty) return none("not asked for: every sample is taken");
    if (const char* reason = whyNot(plan.features)) return none(reason);
    const glm::ivec3 blocks = blockCount(facts.grid.size);
    if (blocks == glm::ivec3(1)) return none("the volume is a single block");
    if (everyValueShows(scene, plan, facts)) return none("every value of the data can show");
    addLeapField(plan, blocks);
    choose(plan, Skipping::Leaps, {});
}

void giveUpLeaps(Plan& plan, const std::string& reason) {
    choose(plan, Skipping::Box, {{kLeaps, reason}});
}

void refineSkipping(Plan& plan, const OccupancyFacts& occupancy) {
    if (plan.features.skipping == Skipping::None) return;
    // Below this share of empty blocks within the box a look costs more than it saves.
    constexpr double kLeastEmpty = 0.1;
    const auto box = static_cast<double>(occupancy.boxBlocks);
    const double empty = occupancy.boxBlocks > 0 ? 1.0 - static_cast<double>(occupancy.occupied) / box : 0.0;
    const std::string share =
        fmt::format("{:.0f} % of the blocks in the box of what shows are empty", 100.0 * empty);
    if (empty >= kLeastEmpty) {
        for (auto& row : plan.stages)
            if (row.stage == "leap") row.reason = share;
        return;
    }
    if (occupancy.boxBlocks == occupancy.blocks)
        choose(plan, Skipping::None, {{kEmptyBlocks, share + ", and the box is the volume"}});
    else if (plan.features.skipping == Skipping::Leaps)
        giveUpLeaps(plan, share);
}

}  // namespace pellucid::renderer
