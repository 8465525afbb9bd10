// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/block_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "renderer/resources/texel.h"
#include "scene/parallel.h"

namespace pellucid::renderer {

namespace {

/// Stored values of one component, with what is not finite replaced by the smallest finite value.
template <class T>
class Voxels {
public:
    Voxels(const Volume& volume, int component, std::span<const T> all)
        : m_all(all),
          m_size(volume.grid().size),
          m_stride(static_cast<std::size_t>(volume.components())),
          m_component(static_cast<std::size_t>(component)),
          m_lowest(static_cast<T>(volume.storedRange(component).lo)) {}

    /// Widens lo and hi, one value a column, by the row (y, z).
    void widen(int y, int z, std::vector<T>& lo, std::vector<T>& hi) const {
        const auto width = static_cast<std::size_t>(m_size.x);
        const std::size_t row =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(m_size.y) + static_cast<std::size_t>(y);
        const T* from = m_all.data() + row * width * m_stride + m_component;
        const auto take = [&](std::size_t stride) {
            for (std::size_t x = 0; x < width; ++x) {
                const T value = finite(from[x * stride]);
                lo[x] = std::min(lo[x], value);
                hi[x] = std::max(hi[x], value);
            }
        };
        // A stride that the compiler knows lets it take many columns at once.
        if (m_stride == 1)
            take(1);
        else
            take(m_stride);
    }

private:
    [[nodiscard]] T finite(T value) const {
        if constexpr (std::is_floating_point_v<T>)
            return std::isfinite(value) ? value : m_lowest;
        else
            return value;
    }

    std::span<const T> m_all;
    glm::ivec3 m_size;
    std::size_t m_stride, m_component;
    T m_lowest;
};

/// Outward rounding of texel values to quanta.
struct Quanta {
    FloatTexel texel;
    template <class T>
    [[nodiscard]] std::uint16_t below(T stored) const {
        if constexpr (std::is_integral_v<T> && sizeof(T) <= 2)
            return texel16(stored);
        else
            return clamped(std::floor(65535.0 * static_cast<double>(texel(stored))));
    }
    template <class T>
    [[nodiscard]] std::uint16_t above(T stored) const {
        if constexpr (std::is_integral_v<T> && sizeof(T) <= 2)
            return texel16(stored);
        else
            return clamped(std::ceil(65535.0 * static_cast<double>(texel(stored))));
    }
    static std::uint16_t clamped(double quanta) {
        return static_cast<std::uint16_t>(std::clamp(quanta, 0.0, 65535.0));
    }
};

struct Span {
    int begin, end;
};
/// Voxels that count as those of block `index` along an axis.
Span paddedBlock(int index, int padding, int size) {
    return {std::max(index * kBlockEdge - padding, 0), std::min((index + 1) * kBlockEdge + padding, size)};
}

/// One row of blocks: columns first, which the processor takes many at a time, then along the row.
template <class T>
void rowOfBlocks(const Voxels<T>& voxels, glm::ivec3 size, int by, int bz, int padding, const Quanta& quanta,
                 std::uint16_t* lo, std::uint16_t* hi) {
    const auto width = static_cast<std::size_t>(size.x);
    std::vector<T> columnLo(width, std::numeric_limits<T>::max());
    std::vector<T> columnHi(width, std::numeric_limits<T>::lowest());
    const Span ys = paddedBlock(by, padding, size.y);
    const Span zs = paddedBlock(bz, padding, size.z);
    for (int z = zs.begin; z < zs.end; ++z)
        for (int y = ys.begin; y < ys.end; ++y) voxels.widen(y, z, columnLo, columnHi);
    const int blocks = blockCount(size).x;
    for (int bx = 0; bx < blocks; ++bx) {
        const Span xs = paddedBlock(bx, padding, size.x);
        lo[bx] = quanta.below(*std::min_element(columnLo.begin() + xs.begin, columnLo.begin() + xs.end));
        hi[bx] = quanta.above(*std::max_element(columnHi.begin() + xs.begin, columnHi.begin() + xs.end));
    }
}

}  // namespace

BlockRanges blockRanges(const Volume& volume, int component, int padding, const Progress& progress) {
    const glm::ivec3 size = volume.grid().size;
    BlockRanges ranges;
    ranges.blocks = blockCount(size);
    ranges.lo.resize(cellCount(ranges.blocks));
    ranges.hi.resize(cellCount(ranges.blocks));
    const Quanta quanta{{storedFromTexel(volume.type(), volume.storedRange(component))}};
    const auto rows =
        static_cast<std::uint64_t>(ranges.blocks.y) * static_cast<std::uint64_t>(ranges.blocks.z);
    const bool finished = visitVoxels(volume, [&]<class T>(std::span<const T> all) {
        const Voxels<T> voxels(volume, component, all);
        const auto work = [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t row = begin; row < end; ++row) {
                const std::size_t at = row * static_cast<std::size_t>(ranges.blocks.x);
                rowOfBlocks(voxels, size, static_cast<int>(row % static_cast<std::uint64_t>(ranges.blocks.y)),
                            static_cast<int>(row / static_cast<std::uint64_t>(ranges.blocks.y)), padding,
                            quanta, ranges.lo.data() + at, ranges.hi.data() + at);
            }
        };
        return forEachChunk(rows, 64, work, progress, "looking for empty space");
    });
    return finished ? ranges : BlockRanges{};
}

}  // namespace pellucid::renderer
