// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "renderer/plan/blocks.h"
#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// What is known of the blocks once their values have been looked at.
struct OccupancyFacts {
    std::uint64_t blocks = 0;
    std::uint64_t occupied = 0;   ///< In which something can show.
    std::uint64_t boxBlocks = 0;  ///< In the box around those.
};

/// Chooses what is done about samples that cannot show, as far as it can be told without voxels, and lists it
/// in the plan, or why it is left out. Precondition: the rest of the plan is complete.
void planSkipping(Plan& plan, const Scene& scene, const VolumeFacts& facts);

/// Leaves the box alone of a plan that has leaps.
void giveUpLeaps(Plan& plan, const std::string& reason);

/// The same with the blocks known: what would not pay is left out.
void refineSkipping(Plan& plan, const OccupancyFacts& occupancy);

}  // namespace pellucid::renderer
