// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>

#include "tests/lint/rules.h"

namespace pellucid::lint {

using Names = std::set<std::string, std::less<>>;

/// What a row of the stage table says of a shader file.
struct ShaderFacts {
    std::string stage;
    Names uniforms;  ///< Plain uniforms and samplers.
    Names blocks;
    Names needs;  ///< Stages whose functions it calls.
};

/// Stage to the stages it needs in turn, over all its variants.
using StageNeeds = std::map<std::string, Names, std::less<>>;

/// The file declares exactly the uniforms and blocks of its row, and calls only functions of stages that the
/// row needs; between
/// `//@when STAGE` and `//@end` also those of that stage and of what it needs.
[[nodiscard]] Findings checkShader(const SourceFile& file, const ShaderFacts& row, const StageNeeds& needsOf);

}  // namespace pellucid::lint
