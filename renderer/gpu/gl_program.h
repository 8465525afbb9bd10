// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/shader_assembly.h"

namespace pellucid::renderer {

/// A linked program and where its uniforms are.
class GlProgram {
public:
    /// Errors: Gpu, with the file and line of each complaint and the driver's words.
    static Result<GlProgram> compile(const ShaderText& text);
    /// From a driver binary; empty when the driver no longer takes it.
    static Result<GlProgram> fromBinary(GLenum format, const void* bytes, GLsizei size);

    [[nodiscard]] GLuint id() const { return m_program.id(); }
    /// -1 when the program has no such uniform (or the compiler found that it does not matter).
    [[nodiscard]] GLint location(const std::string& uniform) const;
    /// Names of the plain uniforms and of the uniform blocks the driver kept.
    [[nodiscard]] std::vector<std::string> activeUniforms() const;
    [[nodiscard]] std::vector<std::string> activeBlocks() const;

private:
    explicit GlProgram(GlProgramId program);
    GlProgramId m_program;
    std::unordered_map<std::string, GLint> m_locations;
};

}  // namespace pellucid::renderer
