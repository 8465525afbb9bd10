// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/raycast_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/gtc/type_ptr.hpp>

#include "scene/check.h"

namespace pellucid::renderer {

namespace {

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void setUniform(GLuint program, GLint location, const UniformValue& value) {
    std::visit(
        [&]<class T>(const T& v) {
            if constexpr (std::is_same_v<T, int>)
                glProgramUniform1i(program, location, v);
            else if constexpr (std::is_same_v<T, float>)
                glProgramUniform1f(program, location, v);
            else if constexpr (std::is_same_v<T, glm::vec2>)
                glProgramUniform2fv(program, location, 1, glm::value_ptr(v));
            else if constexpr (std::is_same_v<T, glm::vec3>)
                glProgramUniform3fv(program, location, 1, glm::value_ptr(v));
            else if constexpr (std::is_same_v<T, glm::vec4>)
                glProgramUniform4fv(program, location, 1, glm::value_ptr(v));
            else if constexpr (std::is_same_v<T, glm::mat3>)
                glProgramUniformMatrix3fv(program, location, 1, GL_FALSE, glm::value_ptr(v));
            else
                glProgramUniformMatrix4fv(program, location, 1, GL_FALSE, glm::value_ptr(v));
        },
        value);
}

/// Moves the target's rows (bottom first) into the picture (top first); `fromBottom` is the band's first row
/// in the picture. Turned in place: a second buffer could take as much as the picture. Precondition: the
/// target is as wide as the picture.
void readBand(GLuint texture, glm::ivec2 band, int fromBottom, ImageF& image) {
    PELLUCID_CHECK_EQ(band.x, image.size.x);
    glm::vec4* top = &image.at(0, image.size.y - fromBottom - band.y);
    const std::ptrdiff_t width = band.x;
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureSubImage(texture, 0, 0, 0, 0, band.x, band.y, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(static_cast<std::size_t>(width * band.y) * sizeof(glm::vec4)),
                         top);
    for (int row = 0; row < band.y / 2; ++row)
        std::swap_ranges(top + row * width, top + (row + 1) * width, top + (band.y - 1 - row) * width);
}

double fetchesPerValue(Filter filter) {
    switch (filter) {
        case Filter::Nearest:
        case Filter::Trilinear:
            return 1.0;
        case Filter::TricubicBSpline:
        case Filter::TrilinearExact:
            return 8.0;
        case Filter::CatmullRom:
        case Filter::TricubicBSplineDeBoor:
            return 27.0;
        case Filter::TricubicBSplineLut:
            return 64.0;
        case Filter::Lanczos3:
            break;
    }
    return 216.0;
}

}  // namespace

double guessedMsPerSample(const Features& features) {
    constexpr double kMsPerFetch = 10e-6;
    return kMsPerFetch * fetchesPerValue(features.filter) * (features.lit ? 7.0 : 1.0);
}

void finish(const Slabs& slabs, std::span<glm::vec4> pixels) {
    if (!slabs.isLinear) return;
    const auto shown = [](float linear) {
        return static_cast<float>(displayFromLinear(static_cast<double>(linear)));
    };
    for (glm::vec4& pixel : pixels) {
        const float opacity = slabs.isTransparent && pixel.a > 0.0f ? pixel.a : 1.0f;
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = shown(pixel[channel] / opacity) * opacity;
    }
}

RaycastPass::RaycastPass(bool softwareDevice)
    : m_noVertices(createVertexArray()),
      m_linear(createSampler(GL_LINEAR)),
      m_nearest(createSampler(GL_NEAREST)),
      // llvmpipe's timer does not cover the work of its threads (3 ms reported for a draw of 140 ms): there,
      // the wall clock around a finished tile is the device's time.
      m_timer(softwareDevice ? GlQuery() : createQuery(GL_TIME_ELAPSED)) {}

void RaycastPass::bind(const RaycastInputs& inputs) const {
    const GLuint program = inputs.program->id();
    for (const auto& [name, value] : *inputs.uniforms)
        if (const GLint location = inputs.program->location(name); location >= 0)
            setUniform(program, location, value);
    glUseProgram(program);
    glBindVertexArray(m_noVertices.id());
    glBindTextureUnit(0, inputs.volumeTexture);
    glBindSampler(0, inputs.interpolates ? m_linear.id() : m_nearest.id());
    const GLuint tables[] = {inputs.transferTable, inputs.segmentTable, inputs.blueNoise,
                             inputs.filterWeights};
    for (GLuint i = 0; i < std::size(tables); ++i) {
        if (tables[i] == 0) continue;
        glBindTextureUnit(1 + i, tables[i]);
        glBindSampler(1 + i, m_linear.id());
    }
    if (inputs.leapField != 0) {
        glBindTextureUnit(5, inputs.leapField);
        glBindSampler(5, m_nearest.id());
    }
    if (inputs.importance != 0) {
        glBindTextureUnit(6, inputs.importance);
        glBindSampler(6, m_nearest.id());
    }
    if (inputs.field != 0) {
        glBindTextureUnit(7, inputs.field);
        glBindSampler(7, m_linear.id());
    }
    if (inputs.lightsBlock != 0) glBindBufferBase(GL_UNIFORM_BUFFER, 0, inputs.lightsBlock);
    if (inputs.surfacesBlock != 0) glBindBufferBase(GL_UNIFORM_BUFFER, 1, inputs.surfacesBlock);
    glBindFramebuffer(GL_FRAMEBUFFER, inputs.target->framebuffer.id());
    glViewport(0, 0, inputs.target->size.x, inputs.target->size.y);
    if (inputs.slabs) {
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    } else {
        glDisable(GL_BLEND);
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
}

void RaycastPass::setPlace(const RaycastInputs& inputs, const Place& place) const {
    const GLuint program = inputs.program->id();
    glProgramUniform1f(program, inputs.program->location("targetStride"), static_cast<float>(place.stride));
    glProgramUniform2f(program, inputs.program->location("targetOrigin"), place.origin.x, place.origin.y);
}

void RaycastPass::drawSlabs(const Slabs& slabs, const RaycastInputs& inputs) const {
    const GLuint program = inputs.program->id();
    const glm::vec4 nothing(0.0f);
    glClearNamedFramebufferfv(inputs.target->framebuffer.id(), GL_COLOR, 0, glm::value_ptr(nothing));
    for (int slab = 0; slab < slabs.count; ++slab) {
        // Behind the last part there is the background, and no end before the ray's own.
        const bool isLast = slab + 1 == slabs.count;
        glProgramUniform1f(program, inputs.program->location("slabFromMm"),
                           static_cast<float>(slab * slabs.lengthMm));
        glProgramUniform1f(program, inputs.program->location("slabToMm"),
                           static_cast<float>((slab + (isLast ? 2 : 1)) * slabs.lengthMm));
        const glm::vec3 behind = isLast ? slabs.background : glm::vec3(0.0f);
        glProgramUniform3fv(program, inputs.program->location("background"), 1, glm::value_ptr(behind));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
}

double RaycastPass::drawTiles(const RaycastInputs& inputs, std::span<const Tile> tiles, FrameCost& cost) {
    const auto start = std::chrono::steady_clock::now();
    if (m_timer) glBeginQuery(GL_TIME_ELAPSED, m_timer.id());
    for (const Tile& tile : tiles) {
        glScissor(tile.origin.x, tile.origin.y, tile.size.x, tile.size.y);
        if (inputs.slabs)
            drawSlabs(*inputs.slabs, inputs);
        else
            glDrawArrays(GL_TRIANGLES, 0, 3);
        cost.rays += static_cast<std::int64_t>(tile.size.x) * tile.size.y;
    }
    if (m_timer) glEndQuery(GL_TIME_ELAPSED);
    // Waiting here is what lets the next tile be sized by what this one took, and a cancel be heard.
    glFinish();
    const double ms = msSince(start);
    GLuint64 nanoseconds = 0;
    if (m_timer) glGetQueryObjectui64v(m_timer.id(), GL_QUERY_RESULT, &nanoseconds);
    cost.gpuMs += m_timer ? static_cast<double>(nanoseconds) * 1e-6 : ms;
    cost.longestTileMs = std::max(cost.longestTileMs, ms);
    ++cost.tiles;
    return ms;
}

Result<ImageF> RaycastPass::drawEveryPixel(const RaycastInputs& inputs, glm::ivec2 size,
                                           const RenderOptions& options, TileBudget& budget,
                                           FrameCost& cost) {
    ImageF image{size,
                 std::vector<glm::vec4>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))};
    const glm::ivec2 targetSize = inputs.target->size;
    for (int fromBottom = 0; fromBottom < size.y; fromBottom += targetSize.y) {
        const glm::ivec2 band{size.x, std::min(targetSize.y, size.y - fromBottom)};
        setPlace(inputs, {1.0, {0.0f, static_cast<float>(fromBottom)}});
        for (TileCutter cutter(band); !cutter.done();) {
            const Tile tile = cutter.next(budget.wantedPixels());
            const double done = static_cast<double>(fromBottom + tile.origin.y) / size.y;
            if (!goOn(options.progress, done, "drawing"))
                return fail(ErrorCode::Cancelled, "the drawing was cancelled");
            budget.took(static_cast<double>(tile.size.x) * tile.size.y, drawTiles(inputs, {&tile, 1}, cost));
        }
        readBand(inputs.target->color.id(), band, fromBottom, image);
    }
    if (inputs.slabs) finish(*inputs.slabs, image.pixels);
    return image;
}

Result<ImageF> RaycastPass::draw(const RaycastInputs& inputs, glm::ivec2 size, const RenderOptions& options,
                                 double& msPerPixel, FrameCost& cost) {
    bind(inputs);
    TileBudget budget(options.tileTargetMs, msPerPixel);
    const bool sparse = inputs.interpolation && isSparse(size, inputs.target->size);
    auto image = sparse ? drawSparsely(inputs, size, options, budget, cost)
                        : drawEveryPixel(inputs, size, options, budget, cost);
    if (!image) return image;
    msPerPixel = budget.msPerPixel();
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        return fail(ErrorCode::Gpu, fmt::format("OpenGL error {:#x} while drawing", error));
    return image;
}

}  // namespace pellucid::renderer
