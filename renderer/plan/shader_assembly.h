// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/plan/plan.h"
#include "scene/result.h"

namespace pellucid::renderer {

/// The text of a program and how to find a line of it again.
struct ShaderText {
    std::string vertex;
    std::string fragment;
    std::vector<std::string> files;     ///< `#line 1000 * K + N` in the text means line N of files[K].
    std::vector<std::string> uniforms;  ///< Declared plain uniforms and samplers.
    std::vector<std::string> blocks;    ///< Declared uniform blocks.
};

/// Puts the skeleton and the files of the rows together. Pure: the same features give the same bytes.
[[nodiscard]] ShaderText assembleShader(const Features& features, const std::vector<StageRow>& rows);

/// A driver's log with "0:N(column)" or "0(N)" replaced by the file's name and line.
[[nodiscard]] std::string locateInFiles(const std::string& driverLog, const std::vector<std::string>& files);

/// Text of one shader file by its path below renderer/shaders ("compose/over.glsl").
[[nodiscard]] const std::string& shaderFile(const std::string& path);

}  // namespace pellucid::renderer
