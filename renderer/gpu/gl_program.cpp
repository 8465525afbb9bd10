// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gl_program.h"

#include <fmt/format.h>

namespace pellucid::renderer {

namespace {

std::string shaderLog(GLuint id) {
    GLint length = 0;
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(id, length, nullptr, text.data());
    return text.c_str();
}

std::string programLog(GLuint id) {
    GLint length = 0;
    glGetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(id, length, nullptr, text.data());
    return text.c_str();
}

Result<GlShader> compileShader(GLenum kind, const std::string& text, const std::vector<std::string>& files) {
    GlShader shader(glCreateShader(kind));
    const char* source = text.c_str();
    glShaderSource(shader.id(), 1, &source, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled != GL_TRUE)
        return fail(ErrorCode::Gpu, fmt::format("the driver does not compile a shader: {}",
                                                locateInFiles(shaderLog(shader.id()), files)));
    return shader;
}

}  // namespace

GlProgram::GlProgram(GlProgramId program) : m_program(std::move(program)) {
    for (const auto& uniform : activeUniforms())
        m_locations[uniform] = glGetUniformLocation(id(), uniform.c_str());
}

Result<GlProgram> GlProgram::compile(const ShaderText& text) {
    auto vertex = compileShader(GL_VERTEX_SHADER, text.vertex, {"engine/fullscreen.vert"});
    if (!vertex) return tl::unexpected(vertex.error());
    auto fragment = compileShader(GL_FRAGMENT_SHADER, text.fragment, text.files);
    if (!fragment) return tl::unexpected(fragment.error());
    GlProgramId program(glCreateProgram());
    glProgramParameteri(program.id(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glAttachShader(program.id(), vertex->id());
    glAttachShader(program.id(), fragment->id());
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE)
        return fail(ErrorCode::Gpu, fmt::format("the driver does not link a program: {}",
                                                locateInFiles(programLog(program.id()), text.files)));
    return GlProgram(std::move(program));
}

Result<GlProgram> GlProgram::fromBinary(GLenum format, const void* bytes, GLsizei size) {
    GlProgramId program(glCreateProgram());
    glProgramBinary(program.id(), format, bytes, size);
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) return fail(ErrorCode::Gpu, "the driver does not take its stored program back");
    return GlProgram(std::move(program));
}

GLint GlProgram::location(const std::string& uniform) const {
    const auto found = m_locations.find(uniform);
    return found == m_locations.end() ? -1 : found->second;
}

std::vector<std::string> GlProgram::activeUniforms() const {
    std::vector<std::string> names;
    GLint count = 0;
    glGetProgramInterfaceiv(id(), GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLenum property = GL_BLOCK_INDEX;
        GLint block = -1;
        glGetProgramResourceiv(id(), GL_UNIFORM, static_cast<GLuint>(i), 1, &property, 1, nullptr, &block);
        if (block != -1) continue;
        char name[256] = {};
        glGetProgramResourceName(id(), GL_UNIFORM, static_cast<GLuint>(i), sizeof name, nullptr, name);
        names.emplace_back(name);
    }
    return names;
}

std::vector<std::string> GlProgram::activeBlocks() const {
    std::vector<std::string> names;
    GLint count = 0;
    glGetProgramInterfaceiv(id(), GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) {
        char name[256] = {};
        glGetProgramResourceName(id(), GL_UNIFORM_BLOCK, static_cast<GLuint>(i), sizeof name, nullptr, name);
        names.emplace_back(name);
    }
    return names;
}

}  // namespace pellucid::renderer
