// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/gradients.h"
#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid::renderer {

/// Values and central differences of one component of a volume on the GPU, in one texture. It has a voxel
/// more on every side: values continue beyond the border as the border's, as the volume's sampler has it, and
/// from one voxel outside on every difference is what it is further out, so that clamping to the edge is
/// right for it too.
struct FieldTexture {
    GlTexture texture;
    FieldLayout layout;
    int layersMade = 0;

    [[nodiscard]] bool isComplete() const { return layersMade == layout.size.z; }
};

/// Without content. Errors: Gpu when memory runs out.
[[nodiscard]] Result<FieldTexture> allocateField(const FieldLayout& layout);

/// Goes on with `field` where it stands, on all cores, slab by slab for about `budgetMs` (one slab at least).
/// Precondition: its layout is that of this component of the volume. Errors: Cancelled.
Result<void> makeField(FieldTexture& field, const Volume& volume, int component, double budgetMs,
                       const Progress& progress = {});

}  // namespace pellucid::renderer
