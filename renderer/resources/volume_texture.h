// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/volume_format.h"
#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid::renderer {

/// One component of a volume on the GPU, as normalised values u in [0, 1].
struct VolumeTexture {
    GlTexture texture;
    StoredFromTexel storedFromTexel;
    ValueMapping mapping;
    double texelExtent = 0.0;  ///< Largest minus smallest u of the data.

    /// u of a physical value; not clamped.
    [[nodiscard]] double texelFromPhysical(double physical) const {
        return (mapping.stored(physical) - storedFromTexel.offset) / storedFromTexel.scale;
    }
    /// physical = u * slope + intercept.
    [[nodiscard]] double physicalPerTexel() const { return storedFromTexel.scale * mapping.slope; }
    [[nodiscard]] double physicalAtZero() const { return mapping.physical(storedFromTexel.offset); }
};

/// Uploads slab by slab; values that are not finite become the smallest finite one.
/// Errors: TooLarge when the driver refuses the size beforehand (proxy test), Gpu when memory runs out,
/// Cancelled.
[[nodiscard]] Result<VolumeTexture> uploadVolume(const Volume& volume, int component,
                                                 const Progress& progress = {});

}  // namespace pellucid::renderer
