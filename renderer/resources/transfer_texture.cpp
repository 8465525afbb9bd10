// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/resources/transfer_texture.h"

namespace pellucid::renderer {

TransferTexture uploadTransferTable(const TransferFunction1D& function, const TableLayout& layout) {
    const auto entries = bakeTable(function, layout.lo, layout.hi, layout.size);
    TransferTexture table{createTexture(GL_TEXTURE_1D), layout};
    glTextureStorage1D(table.texture.id(), 1, GL_RGBA32F, layout.size);
    glTextureSubImage1D(table.texture.id(), 0, 0, layout.size, GL_RGBA, GL_FLOAT, entries.data());
    return table;
}

}  // namespace pellucid::renderer
