// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/loop_limit.h"

#include "renderer/gpu/gl_handle.h"
#include "renderer/plan/shader_assembly.h"

namespace pellucid::renderer {

double measuredLoopLimit() {
    constexpr GLuint kTurns = 1000000;
    constexpr double kUnlimited = 1e9;
    GlShader shader(glCreateShader(GL_COMPUTE_SHADER));
    const std::string text = "#version 450 core\n" + shaderFile("engine/loop_limit.comp");
    const char* source = text.c_str();
    glShaderSource(shader.id(), 1, &source, nullptr);
    glCompileShader(shader.id());
    GlProgramId program(glCreateProgram());
    glAttachShader(program.id(), shader.id());
    glLinkProgram(program.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) return kUnlimited;
    GlBuffer count = createBuffer();
    GLuint turns = 0;
    glNamedBufferStorage(count.id(), sizeof turns, &turns, 0);
    GLint before = 0, bufferBefore = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &before);
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &bufferBefore);
    glUseProgram(program.id());
    glProgramUniform1ui(program.id(), glGetUniformLocation(program.id(), "wanted"), kTurns);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, count.id());
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(count.id(), 0, sizeof turns, &turns);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLuint>(bufferBefore));
    glUseProgram(static_cast<GLuint>(before));
    return turns < kTurns ? static_cast<double>(turns) : kUnlimited;
}

}  // namespace pellucid::renderer
