// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "scene/image.h"
#include "scene/scene.h"

namespace pellucid::bench {

/// A scene drawn by vtkGPUVolumeRayCastMapper: same camera, data, transfer function and sample distance; no
/// jitter, no automatic sample distances. Needs an X display.
///
/// Differences that cannot be set: 8-bit frame buffer, rays that end at opacity 1 - 1/255, a volume that ends
/// at the outer voxel centres. The transfer function goes over as 4096 opacities per unit length.
class VtkPeer {
public:
    /// Precondition: the scene is completed(), of Composite (unlit or with one headlight) or Mip.
    VtkPeer(const Scene& scene, const Volume& volume);
    ~VtkPeer();

    /// Draws and reads the picture back.
    void draw();
    [[nodiscard]] ImageF image() const;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

}  // namespace pellucid::bench
