// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame.h"
#include "renderer/gpu/gl_program.h"
#include "renderer/passes/raycast_uniforms.h"
#include "renderer/passes/tiles.h"
#include "renderer/renderer.h"
#include "renderer/resources/resource_store.h"

namespace pellucid::renderer {

/// What one picture is drawn with; all of it outlives the draw.
struct RaycastInputs {
    const GlProgram* program = nullptr;
    const Uniforms* uniforms = nullptr;
    GLuint volumeTexture = 0;
    GLuint transferTable = 0;  ///< 0: none.
    GLuint segmentTable = 0;   ///< Pre-integration or integral table; 0: none.
    GLuint blueNoise = 0;      ///< 0: none.
    GLuint filterWeights = 0;  ///< 0: none.
    GLuint leapField = 0;      ///< 0: none.
    GLuint importance = 0;     ///< 0: none.
    GLuint lightsBlock = 0;    ///< 0: none.
    GLuint surfacesBlock = 0;  ///< 0: none.
    bool interpolates = true;  ///< The volume's sampler is linear.
    const ResourceStore::Target* target = nullptr;
};

/// Draws pictures tile by tile, so that no draw holds the device for long.
class RaycastPass {
public:
    /// `softwareDevice`: the driver draws on the CPU.
    explicit RaycastPass(bool softwareDevice);

    /// A picture of `size` pixels. `cost` gains times and tiles. `msPerPixel` is what a pixel may cost at
    /// worst, and comes back as measured. Errors: Cancelled, Gpu.
    Result<ImageF> draw(const RaycastInputs& inputs, glm::ivec2 size, const RenderOptions& options,
                        double& msPerPixel, FrameCost& cost);

private:
    void bind(const RaycastInputs& inputs) const;
    double drawTile(const Tile& tile, FrameCost& cost);

    GlVertexArray m_noVertices;
    GlSampler m_linear;
    GlSampler m_nearest;
    GlQuery m_timer;  // empty on a software device
};

}  // namespace pellucid::renderer
