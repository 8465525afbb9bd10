// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/filter_weights.h"

#include <glm/vec4.hpp>
#include <vector>

namespace pellucid::renderer {

GlTexture createBSplineWeights() {
    std::vector<glm::vec4> weights;
    for (int n = 0; n < kFilterWeightTexels; ++n) {
        const double u = n / (kFilterWeightTexels - 1.0);
        const double v = 1.0 - u;
        weights.emplace_back(v * v * v / 6.0, (4.0 + u * u * (3.0 * u - 6.0)) / 6.0,
                             (4.0 + v * v * (3.0 * v - 6.0)) / 6.0, u * u * u / 6.0);
    }
    GlTexture texture = createTexture(GL_TEXTURE_1D);
    glTextureStorage1D(texture.id(), 1, GL_RGBA32F, kFilterWeightTexels);
    glTextureSubImage1D(texture.id(), 0, 0, kFilterWeightTexels, GL_RGBA, GL_FLOAT, weights.data());
    return texture;
}

}  // namespace pellucid::renderer
