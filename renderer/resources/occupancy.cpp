// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/occupancy.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "scene/parallel.h"

namespace pellucid::renderer {

namespace {

constexpr int kLastQuantum = 65535;
constexpr std::uint8_t kFar = 255;

int quantum(double texel, int margin) {
    return static_cast<int>(std::clamp(texel * kLastQuantum + margin, 0.0, 1.0 * kLastQuantum));
}

/// Box and count of what one thread saw.
struct Seen {
    std::uint64_t occupied = 0;
    glm::ivec3 lo{1 << 30}, hi{0};

    void add(const Seen& other) {
        occupied += other.occupied;
        lo = glm::min(lo, other.lo);
        hi = glm::max(hi, other.hi);
    }
};

/// Distances within a frame of one far block on every side, so that neighbours need no questions.
class Field {
public:
    explicit Field(glm::ivec3 blocks)
        : m_blocks(blocks),
          m_row(static_cast<std::size_t>(blocks.x) + 2),
          m_plane(m_row * (static_cast<std::size_t>(blocks.y) + 2)),
          m_values(m_plane * (static_cast<std::size_t>(blocks.z) + 2), kFar) {}

    /// The row's first block.
    std::uint8_t* row(int y, int z) {
        return m_values.data() + (static_cast<std::size_t>(z) + 1) * m_plane +
               (static_cast<std::size_t>(y) + 1) * m_row + 1;
    }

    /// Two sweeps of the 13 neighbours that come before a block, and of the 13 that come after, are exact for
    /// this distance.
    void spread() {
        for (int z = 0; z < m_blocks.z; ++z)
            for (int y = 0; y < m_blocks.y; ++y) sweepRow(y, z, -1);
        for (int z = m_blocks.z - 1; z >= 0; --z)
            for (int y = m_blocks.y - 1; y >= 0; --y) sweepRow(y, z, 1);
    }

private:
    void sweepRow(int y, int z, int side) {
        std::uint8_t* own = row(y, z);
        const std::uint8_t* a = row(y - 1, z + side);
        const std::uint8_t* b = row(y, z + side);
        const std::uint8_t* c = row(y + 1, z + side);
        const std::uint8_t* d = row(y + side, z);
        m_across.resize(m_row);
        m_around.resize(m_row);
        for (std::size_t x = 0; x < m_row; ++x)
            m_across[x] = std::min(std::min(a[x - 1], b[x - 1]), std::min(c[x - 1], d[x - 1]));
        const auto width = static_cast<std::size_t>(m_blocks.x);
        for (std::size_t x = 0; x < width; ++x)
            m_around[x] = std::min(m_across[x], std::min(m_across[x + 1], m_across[x + 2]));
        std::uint8_t before = kFar;
        const auto take = [&](std::size_t x) {
            const std::uint8_t nearest = std::min(m_around[x], before);
            before = std::min(own[x], static_cast<std::uint8_t>(nearest + (nearest < kFar ? 1 : 0)));
            own[x] = before;
        };
        if (side < 0)
            for (std::size_t x = 0; x < width; ++x) take(x);
        else
            for (std::size_t x = width; x-- > 0;) take(x);
    }

    glm::ivec3 m_blocks;
    std::size_t m_row, m_plane;
    std::vector<std::uint8_t> m_values;
    std::vector<std::uint8_t> m_across, m_around;
};

/// 0 where something can show, else far.
Seen classify(const BlockRanges& ranges, const ShownQuanta& shown, double overshoot, Field& field) {
    Seen all;
    std::mutex lock;
    const auto rows = static_cast<std::uint64_t>(ranges.blocks.y);
    const auto width = static_cast<std::size_t>(ranges.blocks.x);
    forEachChunk(
        rows * static_cast<std::uint64_t>(ranges.blocks.z), 64, [&](std::uint64_t begin, std::uint64_t end) {
            Seen seen;
            for (std::uint64_t index = begin; index < end; ++index) {
                const glm::ivec3 at(0, static_cast<int>(index % rows), static_cast<int>(index / rows));
                std::uint8_t* row = field.row(at.y, at.z);
                int first = 0, last = -1;
                for (std::size_t x = 0; x < width; ++x) {
                    int lo = ranges.lo[index * width + x];
                    int hi = ranges.hi[index * width + x];
                    const int more = static_cast<int>(std::ceil(overshoot * (hi - lo)));
                    lo = std::max(lo - more, 0);
                    hi = std::min(hi + more, kLastQuantum);
                    if (!shown.any(lo, hi)) continue;
                    row[x] = 0;
                    if (last < 0) first = static_cast<int>(x);
                    last = static_cast<int>(x);
                    ++seen.occupied;
                }
                if (last < 0) continue;
                seen.lo = glm::min(seen.lo, glm::ivec3(first, at.y, at.z));
                seen.hi = glm::max(seen.hi, glm::ivec3(last, at.y, at.z) + 1);
            }
            const std::lock_guard guard(lock);
            all.add(seen);
        });
    return all;
}

}  // namespace

OccupancyFacts Occupancy::facts() const {
    return {distance.size(), occupied, cellCount(boxHi - boxLo)};
}

ShownQuanta::ShownQuanta(std::span<const ValueRange> shownTexels)
    : m_next(kLastQuantum + 1, kLastQuantum + 1) {
    for (const ValueRange& range : shownTexels) {
        // NaN ends (an empty map) count as no end.
        const int lo = range.lo > 0.0 ? quantum(range.lo, -1) : 0;
        const int hi = range.hi < 1.0 ? quantum(range.hi, 2) : kLastQuantum;
        for (int i = lo; i <= hi; ++i) m_next[static_cast<std::size_t>(i)] = i;
    }
    for (int i = kLastQuantum - 1; i >= 0; --i) {
        auto& next = m_next[static_cast<std::size_t>(i)];
        next = std::min(next, m_next[static_cast<std::size_t>(i) + 1]);
    }
}

Occupancy occupancyOf(const BlockRanges& ranges, const ShownQuanta& shown, double overshoot) {
    Occupancy result;
    result.blocks = ranges.blocks;
    Field field(ranges.blocks);
    const Seen seen = classify(ranges, shown, overshoot, field);
    result.occupied = seen.occupied;
    if (seen.occupied > 0) {
        result.boxLo = seen.lo;
        result.boxHi = seen.hi;
    }
    field.spread();
    result.distance.reserve(ranges.lo.size());
    for (int z = 0; z < ranges.blocks.z; ++z)
        for (int y = 0; y < ranges.blocks.y; ++y)
            result.distance.insert(result.distance.end(), field.row(y, z), field.row(y, z) + ranges.blocks.x);
    return result;
}

}  // namespace pellucid::renderer
