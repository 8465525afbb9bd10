// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gpu/gl_api.h"

namespace pellucid::renderer {

/// Puts back what drawing changes, so that a window's own drawing in the same context is not disturbed.
class GlStateScope {
public:
    GlStateScope();
    ~GlStateScope();
    GlStateScope(const GlStateScope&) = delete;
    GlStateScope& operator=(const GlStateScope&) = delete;

private:
    GLint m_drawFramebuffer = 0, m_readFramebuffer = 0, m_program = 0, m_vertexArray = 0, m_uniformBuffer = 0,
          m_packAlignment = 4, m_unpackAlignment = 4;
    GLint m_blendEquation[2] = {GL_FUNC_ADD, GL_FUNC_ADD};          // RGB, alpha
    GLint m_blendFunction[4] = {GL_ONE, GL_ZERO, GL_ONE, GL_ZERO};  // source and destination of RGB, of alpha
    GLint m_viewport[4] = {}, m_scissor[4] = {};
    GLboolean m_scissorTest = GL_FALSE, m_blend = GL_FALSE, m_depthTest = GL_FALSE, m_cullFace = GL_FALSE;
};

}  // namespace pellucid::renderer
