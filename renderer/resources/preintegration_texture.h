// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/preintegration.h"
#include "scene/transfer_function.h"

namespace pellucid::renderer {

/// A pre-integration table on the GPU: 3D where length is an axis, otherwise an array of two.
struct PreintegrationTexture {
    GlTexture texture;
    PreintegrationLayout layout;
    OpticalSample below, above;  ///< The function at the table's ends and beyond them.
    std::future<std::vector<glm::vec4>>
        exact;  ///< Valid while the texture is a preview and the exact table is being made.
};

/// `wait` false: a preview at once, and the exact table is made on another thread.
[[nodiscard]] PreintegrationTexture uploadPreintegration(const TransferFunction1D& function,
                                                         const PreintegrationLayout& layout, bool wait);
/// Replaces a preview when the exact table is there (or waits for it). Returns true when the texture is
/// exact.
bool completePreintegration(PreintegrationTexture& table, bool wait);

/// Running integrals of the transfer function on the GPU.
struct IntegralTexture {
    GlTexture texture;
    double lo = 0.0;
    double hi = 1.0;
    int size = 2;
};
[[nodiscard]] IntegralTexture uploadIntegrals(const TransferFunction1D& function, double lo, double hi,
                                              int size);

}  // namespace pellucid::renderer
