// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/preintegration_texture.h"

#include <chrono>

namespace pellucid::renderer {

namespace {

void upload(const PreintegrationTexture& table, const std::vector<glm::vec4>& entries) {
    const auto& layout = table.layout;
    glTextureSubImage3D(table.texture.id(), 0, 0, 0, 0, layout.size, layout.size, layout.layers, GL_RGBA,
                        GL_FLOAT, entries.data());
}

}  // namespace

PreintegrationTexture uploadPreintegration(const TransferFunction1D& function,
                                           const PreintegrationLayout& layout, bool wait) {
    PreintegrationTexture table{createTexture(isPerLength(layout) ? GL_TEXTURE_3D : GL_TEXTURE_2D_ARRAY),
                                layout,
                                evaluate(function, layout.lo),
                                evaluate(function, layout.hi),
                                {}};
    glTextureStorage3D(table.texture.id(), 1, GL_RGBA32F, layout.size, layout.size, layout.layers);
    if (wait) {
        upload(table, preintegrate(function, layout, TableQuality::Exact));
        return table;
    }
    table.exact = std::async(std::launch::async, [function, layout] {
        return preintegrate(function, layout, TableQuality::Exact);
    });
    upload(table, preintegrate(function, layout, TableQuality::Preview));
    return table;
}

bool completePreintegration(PreintegrationTexture& table, bool wait) {
    if (!table.exact.valid()) return true;
    if (!wait && table.exact.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    upload(table, table.exact.get());
    return true;
}

IntegralTexture uploadIntegrals(const TransferFunction1D& function, double lo, double hi, int size) {
    const auto entries = tabulateIntegrals(function, lo, hi, size);
    IntegralTexture table{createTexture(GL_TEXTURE_1D), lo, hi, size};
    glTextureStorage1D(table.texture.id(), 1, GL_RGBA32F, size);
    glTextureSubImage1D(table.texture.id(), 0, 0, size, GL_RGBA, GL_FLOAT, entries.data());
    return table;
}

}  // namespace pellucid::renderer
