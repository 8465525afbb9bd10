// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/leap_texture.h"

namespace pellucid::renderer {

GlTexture uploadLeapField(const Occupancy& occupancy) {
    const glm::ivec3 size = occupancy.blocks;
    GlTexture texture = createTexture(GL_TEXTURE_3D);
    glTextureStorage3D(texture.id(), 1, GL_R8UI, size.x, size.y, size.z);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(texture.id(), 0, 0, 0, 0, size.x, size.y, size.z, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                        occupancy.distance.data());
    return texture;
}

}  // namespace pellucid::renderer
