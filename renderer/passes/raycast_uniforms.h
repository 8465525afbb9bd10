// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "renderer/plan/plan.h"
#include "renderer/resources/field_texture.h"
#include "renderer/resources/occupancy.h"
#include "renderer/resources/preintegration_texture.h"
#include "renderer/resources/transfer_texture.h"
#include "renderer/resources/volume_texture.h"

namespace pellucid::renderer {

using UniformValue = std::variant<int, float, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::mat4>;
using Uniforms = std::vector<std::pair<std::string, UniformValue>>;

/// The tables of a frame; null where the plan has none.
struct FrameTables {
    const TransferTexture* transfer = nullptr;
    const PreintegrationTexture* preintegration = nullptr;
    const IntegralTexture* integrals = nullptr;
    const Occupancy* occupancy = nullptr;
    const FieldTexture* field = nullptr;
};

/// Numbers of a frame. All that any stage of the plan may declare; those it does not are skipped when they
/// are set. `table` is null in modes without a transfer function. Everything is computed in double relative
/// to the volume's centre.
[[nodiscard]] Uniforms raycastUniforms(const Scene& scene, const Plan& plan, const Grid& grid,
                                       const VolumeTexture& volume, const FrameTables& tables,
                                       double maxLoopTurns);

/// What is behind the volume, in the compositing space; nothing where the picture is transparent.
[[nodiscard]] glm::vec3 backgroundOf(const Scene& scene, const Plan& plan);

/// The std140 block Surfaces: for each surface, ascending in value, colour in the compositing space and
/// opacity, and the normalised value.
[[nodiscard]] std::vector<glm::vec4> surfaceBlock(std::vector<SurfaceLayer> surfaces, CompositingSpace space,
                                                  const VolumeTexture& volume);
/// The std140 block of shade/blinn_phong.glsl: colour * intensity, then direction to the light (w 0) or
/// position (w 1), render coordinates.
[[nodiscard]] std::vector<glm::vec4> lightBlock(const Scene& scene, const Grid& grid);

}  // namespace pellucid::renderer
