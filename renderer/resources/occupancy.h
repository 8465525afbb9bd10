// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/resources/block_ranges.h"
#include "scene/volume.h"

namespace pellucid::renderer {

/// Which of the 65536 quanta of u (BlockRanges) can show. One question is one look-up, however many control
/// points a function has.
class ShownQuanta {
public:
    /// From closed intervals of u, in any order; their ends may be infinite. Each is taken a quantum wider on
    /// both sides: u is a float, its error a hundredth of that.
    explicit ShownQuanta(std::span<const ValueRange> shownTexels);
    /// True when something in lo ... hi can show.
    [[nodiscard]] bool any(int lo, int hi) const { return m_next[static_cast<std::size_t>(lo)] <= hi; }

private:
    std::vector<std::int32_t> m_next;  ///< The smallest shown quantum that is not below the index.
};

/// Where something can show. The empty cube around each block makes leaps (Chebyshev distance; Cohen and
/// Sheffer, "Proximity clouds", 1994).
struct Occupancy {
    glm::ivec3 blocks{0};
    /// 0 where something can show, else the distance in blocks, the largest over the axes, to the nearest
    /// block where something can; at most 255. i fastest.
    std::vector<std::uint8_t> distance;
    std::uint64_t occupied = 0;
    glm::ivec3 boxLo{
        0};  ///< Of the occupied blocks, in blocks; boxHi exclusive, equal to boxLo when there is none.
    glm::ivec3 boxHi{0};

    [[nodiscard]] OccupancyFacts facts() const;
};

/// `overshoot`: what reconstruction may add to a range on both sides, as a part of its extent.
[[nodiscard]] Occupancy occupancyOf(const BlockRanges& ranges, const ShownQuanta& shown, double overshoot);

}  // namespace pellucid::renderer
