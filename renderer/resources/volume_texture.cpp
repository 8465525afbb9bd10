// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/volume_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "renderer/resources/texel.h"

namespace pellucid::renderer {

namespace {

/// Voxels a slab: converted and handed to the driver at once; small enough for the cache, large enough for
/// few calls.
constexpr std::int64_t kSlabVoxels = 1 << 20;

template <class Texel, class T, class Convert>
Result<void> uploadSlabs(const Volume& volume, int component, std::span<const T> voxels, GLuint texture,
                         GLenum type, const Convert& convert, const Progress& progress) {
    const auto size = volume.grid().size;
    const std::int64_t plane = static_cast<std::int64_t>(size.x) * size.y;
    const int depth = static_cast<int>(std::clamp<std::int64_t>(kSlabVoxels / plane, 1, size.z));
    std::vector<Texel> slab(static_cast<std::size_t>(plane * depth));
    const auto stride = static_cast<std::size_t>(volume.components());
    for (int z = 0; z < size.z; z += depth) {
        if (!goOn(progress, static_cast<double>(z) / size.z, "uploading the volume"))
            return fail(ErrorCode::Cancelled, "the upload was cancelled");
        const int count = std::min(depth, size.z - z);
        const T* from = voxels.data() + static_cast<std::size_t>(plane * z) * stride +
                        static_cast<std::size_t>(component);
        const auto total = static_cast<std::size_t>(plane * count);
        // A stride that the compiler knows lets it take many voxels at once.
        if (stride == 1)
            for (std::size_t i = 0; i < total; ++i) slab[i] = convert(from[i]);
        else
            for (std::size_t i = 0; i < total; ++i) slab[i] = convert(from[i * stride]);
        glTextureSubImage3D(texture, 0, 0, 0, z, size.x, size.y, count, GL_RED, type, slab.data());
    }
    return {};
}

Result<GlTexture> allocate(glm::ivec3 size, GLenum format) {
    // The proxy answers whether size and format are possible without taking the memory.
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, static_cast<GLint>(format), size.x, size.y, size.z, 0, GL_RED,
                 GL_FLOAT, nullptr);
    GLint width = 0;
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    if (width != size.x)
        return fail(ErrorCode::TooLarge,
                    fmt::format("the OpenGL driver cannot hold a volume of {} x {} x {} voxels", size.x,
                                size.y, size.z));
    while (glGetError() != GL_NO_ERROR) {
    }
    GlTexture texture = createTexture(GL_TEXTURE_3D);
    glTextureStorage3D(texture.id(), 1, format, size.x, size.y, size.z);
    if (glGetError() != GL_NO_ERROR)
        return fail(ErrorCode::Gpu,
                    fmt::format("the graphics memory cannot hold a volume of {} x {} x {} voxels", size.x,
                                size.y, size.z));
    return texture;
}

}  // namespace

Result<VolumeTexture> uploadVolume(const Volume& volume, int component, const Progress& progress) {
    const bool in16Bits = isStoredIn16Bits(volume.type());
    auto texture = allocate(volume.grid().size, in16Bits ? GL_R16 : GL_R32F);
    if (!texture) return tl::unexpected(texture.error());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const ValueRange range = volume.storedRange(component);
    const auto map = storedFromTexel(volume.type(), range);
    const GLuint id = texture->id();
    auto uploaded = visitVoxels(volume, [&]<class T>(std::span<const T> voxels) -> Result<void> {
        if constexpr (std::is_integral_v<T> && sizeof(T) <= 2)
            return uploadSlabs<std::uint16_t>(
                volume, component, voxels, id, GL_UNSIGNED_SHORT, [](T v) { return texel16(v); }, progress);
        else
            return uploadSlabs<float>(volume, component, voxels, id, GL_FLOAT, FloatTexel{map}, progress);
    });
    if (!uploaded) return tl::unexpected(uploaded.error());
    return VolumeTexture{std::move(*texture), map, volume.mapping(), (range.hi - range.lo) / map.scale};
}

}  // namespace pellucid::renderer
