// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/field_texture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <type_traits>

#include "renderer/resources/texel.h"
#include "scene/parallel.h"

namespace pellucid::renderer {

namespace {

/// Voxels a slab: made and handed to the driver at once, and what a look at the clock costs.
constexpr std::int64_t kSlabVoxels = 1 << 20;

/// The rows that the texels of one row need: its own and the four beside it, clamped to the volume.
template <class T>
struct Rows {
    const T *own, *yBefore, *yAfter, *zBefore, *zAfter;
};

/// One component's voxels by rows.
template <class T>
class RowsOf {
public:
    RowsOf(const Volume& volume, int component, std::span<const T> voxels)
        : m_size(volume.grid().size),
          m_stride(static_cast<std::size_t>(volume.components())),
          m_first(voxels.data() + component) {}

    /// y, z: of the voxel; -1 and the size stand for what lies beyond.
    [[nodiscard]] Rows<T> at(int y, int z) const {
        return {row(y, z), row(y - 1, z), row(y + 1, z), row(y, z - 1), row(y, z + 1)};
    }
    [[nodiscard]] std::size_t stride() const { return m_stride; }

private:
    [[nodiscard]] const T* row(int y, int z) const {
        const auto j = static_cast<std::size_t>(std::clamp(y, 0, m_size.y - 1));
        const auto k = static_cast<std::size_t>(std::clamp(z, 0, m_size.z - 1));
        return m_first +
               (k * static_cast<std::size_t>(m_size.y) + j) * static_cast<std::size_t>(m_size.x) * m_stride;
    }

    glm::ivec3 m_size;
    std::size_t m_stride;
    const T* m_first;
};

/// 8- and 16-bit data: differences as integers around the middle of the texel's range.
struct Texels16 {
    using Texel = std::uint64_t;
    double texelsPerStored;

    template <class T>
    [[nodiscard]] Texel operator()(glm::ivec3 difference, T own) const {
        const auto texel = [&](int d) {
            return static_cast<std::uint64_t>(32768 + std::lround(d * texelsPerStored));
        };
        return pack(texel(difference.x), texel(difference.y), texel(difference.z), texel16(own));
    }
    static Texel pack(std::uint64_t x, std::uint64_t y, std::uint64_t z, std::uint64_t value) {
        return x | y << 16 | z << 32 | value << 48;
    }
};

/// The same where a stored value is a whole number of texels, in integers.
struct ExactTexels16 {
    using Texel = std::uint64_t;
    int texelsPerStored;

    template <class T>
    [[nodiscard]] Texel operator()(glm::ivec3 difference, T own) const {
        const glm::ivec3 texel = 32768 + difference * texelsPerStored;
        return Texels16::pack(static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y),
                              static_cast<std::uint32_t>(texel.z), texel16(own));
    }
};

/// One row of texels, the two beyond the volume included. `take(x)`: of the row's voxel x from a Rows member.
template <class T, class Make>
void makeRow(const Rows<T>& rows, int width, std::size_t stride, const Make& make, typename Make::Texel* to) {
    const auto one = [&](int before, int x, int after) {
        const auto at = [&](const T* row, int i) {
            return static_cast<int>(row[static_cast<std::size_t>(i) * stride]);
        };
        return make(
            glm::ivec3(at(rows.own, after) - at(rows.own, before), at(rows.yAfter, x) - at(rows.yBefore, x),
                       at(rows.zAfter, x) - at(rows.zBefore, x)),
            rows.own[static_cast<std::size_t>(x) * stride]);
    };
    to[0] = one(0, 0, 0);
    to[1] = one(0, 0, std::min(1, width - 1));
    for (int x = 1; x + 1 < width; ++x) to[x + 1] = one(x - 1, x, x + 1);
    to[width] = one(std::max(width - 2, 0), width - 1, width - 1);
    to[width + 1] = one(width - 1, width - 1, width - 1);
}

/// The same of data that the volume's texture has as float, in float.
template <class T>
void makeFloatRow(const Rows<T>& rows, int width, std::size_t stride, const FloatTexel& texel,
                  glm::vec4* to) {
    const auto at = [&](const T* row, int i) {
        return texel(row[static_cast<std::size_t>(std::clamp(i, 0, width - 1)) * stride]);
    };
    for (int i = -1; i <= width; ++i)
        to[i + 1] = {at(rows.own, i + 1) - at(rows.own, i - 1), at(rows.yAfter, i) - at(rows.yBefore, i),
                     at(rows.zAfter, i) - at(rows.zBefore, i), at(rows.own, i)};
}

/// Makes slabs with `makeOne(rows, y, z, to)`, a row of texels, and hands them to the driver.
template <class Texel, class MakeOne>
Result<void> makeSlabs(FieldTexture& field, GLenum type, double budgetMs, const Progress& progress,
                       const MakeOne& makeOne) {
    const auto start = std::chrono::steady_clock::now();
    const glm::ivec3 size = field.layout.size;
    const auto plane = static_cast<std::int64_t>(size.x) * size.y;
    const int depth = static_cast<int>(std::clamp<std::int64_t>(kSlabVoxels / plane, 1, size.z));
    std::vector<Texel> slab(static_cast<std::size_t>(plane * depth));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    while (!field.isComplete()) {
        const int first = field.layersMade;
        if (!goOn(progress, static_cast<double>(first) / size.z, "making gradients"))
            return fail(ErrorCode::Cancelled, "the making of gradients was cancelled");
        const int count = std::min(depth, size.z - first);
        const auto height = static_cast<std::uint64_t>(size.y);
        forEachChunk(
            height * static_cast<std::uint64_t>(count), 64, [&](std::uint64_t row, std::uint64_t end) {
                for (; row < end; ++row)
                    makeOne(static_cast<int>(row % height) - 1, static_cast<int>(row / height) + first - 1,
                            slab.data() + row * static_cast<std::uint64_t>(size.x));
            });
        glTextureSubImage3D(field.texture.id(), 0, 0, 0, first, size.x, size.y, count, GL_RGBA, type,
                            slab.data());
        field.layersMade += count;
        const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
        if (passed.count() > budgetMs) break;
    }
    return {};
}

}  // namespace

Result<FieldTexture> allocateField(const FieldLayout& layout) {
    while (glGetError() != GL_NO_ERROR) {
    }
    FieldTexture field{createTexture(GL_TEXTURE_3D), layout, 0};
    const glm::ivec3 size = layout.size;
    glTextureStorage3D(field.texture.id(), 1, layout.in16Bits ? GL_RGBA16 : GL_RGBA32F, size.x, size.y,
                       size.z);
    if (glGetError() != GL_NO_ERROR)
        return fail(ErrorCode::Gpu, fmt::format("the graphics memory has no room for {} MB of gradients",
                                                layout.bytes() >> 20));
    return field;
}

Result<void> makeField(FieldTexture& field, const Volume& volume, int component, double budgetMs,
                       const Progress& progress) {
    const int width = volume.grid().size.x;
    return visitVoxels(volume, [&]<class T>(std::span<const T> voxels) -> Result<void> {
        const RowsOf<T> rows(volume, component, voxels);
        const auto stride = rows.stride();
        if constexpr (std::is_integral_v<T> && sizeof(T) <= 2) {
            const auto with = [&](const auto& make) {
                return makeSlabs<std::uint64_t>(field, GL_UNSIGNED_SHORT, budgetMs, progress,
                                                [&](int y, int z, std::uint64_t* to) {
                                                    // A stride that the compiler knows lets it take many
                                                    // voxels at once.
                                                    if (stride == 1)
                                                        makeRow(rows.at(y, z), width, 1, make, to);
                                                    else
                                                        makeRow(rows.at(y, z), width, stride, make, to);
                                                });
            };
            const double texels = field.layout.texelsPerStored;
            return texels < 1.0 ? with(Texels16{texels}) : with(ExactTexels16{static_cast<int>(texels)});
        } else {
            const FloatTexel texel{storedFromTexel(volume.type(), volume.storedRange(component))};
            return makeSlabs<glm::vec4>(
                field, GL_FLOAT, budgetMs, progress,
                [&](int y, int z, glm::vec4* to) { makeFloatRow(rows.at(y, z), width, stride, texel, to); });
        }
    });
}

}  // namespace pellucid::renderer
