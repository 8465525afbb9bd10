// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/plan/plan.h"

namespace pellucid::renderer {

/// One row of the stage table: a shader file and everything it declares. The lint test holds the table
/// against the folder renderer/shaders, the GL test against what the driver reports.
struct StageVariant {
    const char* stage;                  ///< Folder.
    const char* variant;                ///< File without ending.
    std::vector<const char*> uniforms;  ///< Plain uniforms and samplers it declares.
    std::vector<const char*> blocks;    ///< Uniform blocks it declares.
    std::vector<const char*> needs;     ///< Stages whose functions it calls.
};

/// All variants, in the order in which stages stand in a program.
[[nodiscard]] std::span<const StageVariant> stageTable();
[[nodiscard]] const StageVariant& findVariant(std::string_view stage, std::string_view variant);

/// Uniforms that the skeleton engine/raycast.frag declares.
[[nodiscard]] std::span<const char* const> engineUniforms();

/// The rows that these features need, in program order, and what they leave out.
struct StageChoice {
    std::vector<StageRow> rows;
    std::vector<LeftOutRow> leftOut;
};
[[nodiscard]] StageChoice chooseStages(const Features& features);

/// Gives a plan other features and the stages that go with them. What else it left out stays as it is.
void changeFeatures(Plan& plan, const Features& features);

}  // namespace pellucid::renderer
