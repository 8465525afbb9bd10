// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/transfer_table.h"

namespace pellucid::renderer {

/// A tabulated transfer function on the GPU: RGB in the compositing space and extinction per unit length.
struct TransferTexture {
    GlTexture texture;
    TableLayout layout;
};

[[nodiscard]] TransferTexture uploadTransferTable(const TransferFunction1D& function,
                                                  const TableLayout& layout);

}  // namespace pellucid::renderer
