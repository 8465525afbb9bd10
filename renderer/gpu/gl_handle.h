// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "renderer/gpu/gl_api.h"

namespace pellucid::renderer {

/// Owner of one GL object: move-only, empty is id 0 and legal without a context. Deletion needs the context
/// current.
template <class Traits>
class GlHandle {
public:
    GlHandle() = default;
    explicit GlHandle(GLuint id) : m_id(id) {}
    GlHandle(GlHandle&& other) noexcept : m_id(std::exchange(other.m_id, 0)) {}
    GlHandle& operator=(GlHandle&& other) noexcept {
        std::swap(m_id, other.m_id);
        return *this;
    }
    ~GlHandle() {
        if (m_id != 0) Traits::destroy(m_id);
    }

    [[nodiscard]] GLuint id() const { return m_id; }
    explicit operator bool() const { return m_id != 0; }

private:
    GLuint m_id = 0;
};

struct TextureTraits {
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct BufferTraits {
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct FramebufferTraits {
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayTraits {
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct SamplerTraits {
    static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
};
struct QueryTraits {
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};
struct ShaderTraits {
    static void destroy(GLuint id) { glDeleteShader(id); }
};
struct ProgramTraits {
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

using GlTexture = GlHandle<TextureTraits>;
using GlBuffer = GlHandle<BufferTraits>;
using GlFramebuffer = GlHandle<FramebufferTraits>;
using GlVertexArray = GlHandle<VertexArrayTraits>;
using GlSampler = GlHandle<SamplerTraits>;
using GlQuery = GlHandle<QueryTraits>;
using GlShader = GlHandle<ShaderTraits>;
using GlProgramId = GlHandle<ProgramTraits>;

[[nodiscard]] inline GlTexture createTexture(GLenum target) {
    GLuint id = 0;
    glCreateTextures(target, 1, &id);
    return GlTexture(id);
}
[[nodiscard]] inline GlBuffer createBuffer() {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    return GlBuffer(id);
}
[[nodiscard]] inline GlFramebuffer createFramebuffer() {
    GLuint id = 0;
    glCreateFramebuffers(1, &id);
    return GlFramebuffer(id);
}
[[nodiscard]] inline GlVertexArray createVertexArray() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return GlVertexArray(id);
}
[[nodiscard]] inline GlQuery createQuery(GLenum target) {
    GLuint id = 0;
    glCreateQueries(target, 1, &id);
    return GlQuery(id);
}
/// Clamps to the edge texels; `filter` is GL_NEAREST or GL_LINEAR.
[[nodiscard]] inline GlSampler createSampler(GLint filter) {
    GLuint id = 0;
    glCreateSamplers(1, &id);
    glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
    for (GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glSamplerParameteri(id, wrap, GL_CLAMP_TO_EDGE);
    return GlSampler(id);
}

}  // namespace pellucid::renderer
