// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gl_state_scope.h"

namespace pellucid::renderer {

namespace {

void setEnabled(GLenum what, GLboolean on) {
    if (on == GL_TRUE)
        glEnable(what);
    else
        glDisable(what);
}

}  // namespace

GlStateScope::GlStateScope() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_drawFramebuffer);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &m_readFramebuffer);
    glGetIntegerv(GL_CURRENT_PROGRAM, &m_program);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &m_vertexArray);
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 0, &m_uniformBuffer);
    glGetIntegerv(GL_PACK_ALIGNMENT, &m_packAlignment);
    glGetIntegerv(GL_UNPACK_ALIGNMENT, &m_unpackAlignment);
    glGetIntegerv(GL_VIEWPORT, m_viewport);
    glGetIntegerv(GL_SCISSOR_BOX, m_scissor);
    glGetIntegerv(GL_BLEND_EQUATION_RGB, &m_blendEquation[0]);
    glGetIntegerv(GL_BLEND_EQUATION_ALPHA, &m_blendEquation[1]);
    glGetIntegerv(GL_BLEND_SRC_RGB, &m_blendFunction[0]);
    glGetIntegerv(GL_BLEND_DST_RGB, &m_blendFunction[1]);
    glGetIntegerv(GL_BLEND_SRC_ALPHA, &m_blendFunction[2]);
    glGetIntegerv(GL_BLEND_DST_ALPHA, &m_blendFunction[3]);
    m_scissorTest = glIsEnabled(GL_SCISSOR_TEST);
    m_blend = glIsEnabled(GL_BLEND);
    m_depthTest = glIsEnabled(GL_DEPTH_TEST);
    m_cullFace = glIsEnabled(GL_CULL_FACE);
}

GlStateScope::~GlStateScope() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(m_drawFramebuffer));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(m_readFramebuffer));
    glUseProgram(static_cast<GLuint>(m_program));
    glBindVertexArray(static_cast<GLuint>(m_vertexArray));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, static_cast<GLuint>(m_uniformBuffer));
    glPixelStorei(GL_PACK_ALIGNMENT, m_packAlignment);
    glPixelStorei(GL_UNPACK_ALIGNMENT, m_unpackAlignment);
    glViewport(m_viewport[0], m_viewport[1], m_viewport[2], m_viewport[3]);
    glScissor(m_scissor[0], m_scissor[1], m_scissor[2], m_scissor[3]);
    glBlendEquationSeparate(static_cast<GLenum>(m_blendEquation[0]), static_cast<GLenum>(m_blendEquation[1]));
    glBlendFuncSeparate(static_cast<GLenum>(m_blendFunction[0]), static_cast<GLenum>(m_blendFunction[1]),
                        static_cast<GLenum>(m_blendFunction[2]), static_cast<GLenum>(m_blendFunction[3]));
    setEnabled(GL_SCISSOR_TEST, m_scissorTest);
    setEnabled(GL_BLEND, m_blend);
    setEnabled(GL_DEPTH_TEST, m_depthTest);
    setEnabled(GL_CULL_FACE, m_cullFace);
    for (GLuint unit = 0; unit < 8; ++unit) glBindSampler(unit, 0);
}

}  // namespace pellucid::renderer
