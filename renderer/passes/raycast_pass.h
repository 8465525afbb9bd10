// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "renderer/frame.h"
#include "renderer/gpu/gl_program.h"
#include "renderer/passes/raycast_uniforms.h"
#include "renderer/passes/sparse_rays.h"
#include "renderer/passes/tiles.h"
#include "renderer/renderer.h"
#include "renderer/resources/resource_store.h"

namespace pellucid::renderer {

/// Rays drawn in parts, each blended under those in front of it.
struct Slabs {
    int count = 1;
    double lengthMm = 0.0;
    glm::vec3 background{0.0f};  ///< In the compositing space.
    bool isLinear = false;  ///< That is light-linear: the picture is encoded for display once it is read.
    bool isTransparent = false;  ///< The picture.
};
/// Pixels read once all slabs are drawn, as they are shown: what shaders/encode/srgb.glsl does.
void finish(const Slabs& slabs, std::span<glm::vec4> pixels);

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
    GLuint field = 0;          ///< 0: none.
    GLuint lightsBlock = 0;    ///< 0: none.
    GLuint surfacesBlock = 0;  ///< 0: none.
    bool interpolates = true;  ///< The volume's sampler is linear.
    const ResourceStore::Target* target = nullptr;
    std::optional<Slabs> slabs;  ///< Unset: rays are drawn whole.
    /// Rays only where interpolation would be wrong by more than this, display units in the norm; unset: a
    /// ray a pixel.
    std::optional<double> interpolation;
    ErrorNorm norm = ErrorNorm::Rmse;
};

/// First guess of a sample's cost: slower than any device seen, so that the first tile is not too long for
/// one.
[[nodiscard]] double guessedMsPerSample(const Features& features);

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
    /// Where a picture's rays stand in the target: one every `stride` pixels, the target's lower left corner
    /// at `origin`.
    struct Place {
        double stride = 1.0;
        glm::vec2 origin{0.0f};
    };

    void bind(const RaycastInputs& inputs) const;
    void setPlace(const RaycastInputs& inputs, const Place& place) const;
    /// The tile the scissor is set to, part by part of its rays, each blended under those before it.
    void drawSlabs(const Slabs& slabs, const RaycastInputs& inputs) const;
    /// Milliseconds for all of them.
    double drawTiles(const RaycastInputs& inputs, std::span<const Tile> tiles, FrameCost& cost);
    Result<ImageF> drawEveryPixel(const RaycastInputs& inputs, glm::ivec2 size, const RenderOptions& options,
                                  TileBudget& budget, FrameCost& cost);
    Result<ImageF> drawSparsely(const RaycastInputs& inputs, glm::ivec2 size, const RenderOptions& options,
                                TileBudget& budget, FrameCost& cost);
    /// Draws `runs` of sites of the lattice and reads them into it.
    Result<void> traceSites(const RaycastInputs& inputs, std::span<const Tile> runs, Lattice& lattice,
                            const RenderOptions& options, TileBudget& budget, FrameCost& cost);

    GlVertexArray m_noVertices;
    GlSampler m_linear;
    GlSampler m_nearest;
    GlQuery m_timer;  // empty on a software device
};

}  // namespace pellucid::renderer
