// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gpu_context.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/gpu/gl_api.h"
#include "tests/gl/gl_fixture.h"

namespace pellucid::renderer {
namespace {

using ContextTest = test::GlTest;

TEST_F(ContextTest, AHeadlessContextIsCoreAndNewEnough) {
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_GE(epoxy_gl_version(), 45);
}

TEST_F(ContextTest, FloatTargetsKeepWhatIsWritten) {
    // Unclamped accumulation: 1000 is written and 1000 is read; so is NaN, which must not turn into a number.
    GLuint texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA32F, 4, 4);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    const float color[4] = {1000.0f, -2.5f, 1e-30f, 3e38f};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, color);
    float read[64] = {};
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, sizeof read, read);
    for (int i = 0; i < 64; ++i) EXPECT_EQ(read[i], color[i % 4]);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
}

}  // namespace
}  // namespace pellucid::renderer
