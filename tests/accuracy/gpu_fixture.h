// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "renderer/renderer.h"
#include "tests/accuracy/scenes.h"

namespace pellucid::test {

/// One unit in the last place of 1 in float, rounded to nearest: the error of one operation on numbers up
/// to 1.
inline constexpr double kFloatUlp = 5.9604644775390625e-08;

/// One renderer for all tests of a process. Without OpenGL a test is skipped, unless PELLUCID_REQUIRE_GL=1.
class GpuTest : public testing::Test {
protected:
    void SetUp() override {
        static const Result<renderer::Renderer>& made = shared();
        if (made) return;
        const char* required = std::getenv("PELLUCID_REQUIRE_GL");
        if (required != nullptr && std::string(required) == "1") FAIL() << made.error().text();
        GTEST_SKIP() << made.error().text();
    }

    static renderer::Renderer& gpu() { return *shared(); }

    /// The frame; every number in it must be finite.
    static renderer::Frame frameOf(const Scene& scene, const VolumePtr& volume,
                                   const renderer::RenderOptions& options = {}) {
        auto frame = gpu().render(scene, {volume}, options);
        if (!frame) {
            ADD_FAILURE() << frame.error().text();
            return {};
        }
        for (const glm::vec4& p : frame->image.pixels) {
            if (std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a))
                continue;
            ADD_FAILURE() << "a pixel is not finite: " << p.r << ' ' << p.g << ' ' << p.b << ' ' << p.a;
            break;
        }
        return std::move(*frame);
    }

    static ImageF draw(const Scene& scene, const VolumePtr& volume) { return frameOf(scene, volume).image; }

    static glm::dvec4 drawRay(const Scene& scene, const VolumePtr& volume) {
        const ImageF image = draw(scene, volume);
        if (image.pixels.empty()) return glm::dvec4(std::numeric_limits<double>::quiet_NaN());
        return glm::dvec4(image.pixels.front());
    }

    /// What 32-bit texture units add to an interpolated value: nothing on the software driver; hardware
    /// rounds its filter weights to 8 bits, so three axes add up to 3/512 of the range of the data.
    static double filterError() { return gpu().deviceInfo().software ? 0.0 : 3.0 / 512.0; }

private:
    static Result<renderer::Renderer>& shared() {
        static Result<renderer::Renderer> made = renderer::Renderer::headless();
        return made;
    }
};

/// Largest difference over pixels and channels, alpha included; NaN when there is one.
inline double largestDifference(const ImageF& a, const ImageF& b) {
    if (a.size != b.size) return std::numeric_limits<double>::quiet_NaN();
    double result = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel) {
            const double error = std::abs(static_cast<double>(a.pixels[i][channel]) -
                                          static_cast<double>(b.pixels[i][channel]));
            if (!(error <= result)) result = error;
        }
    return result;
}

/// Share of pixels in which any channel differs by more than `bound`.
inline double shareBeyond(const ImageF& a, const ImageF& b, double bound) {
    if (a.size != b.size || a.pixels.empty()) return 1.0;
    int beyond = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        double worst = 0.0;
        for (int channel = 0; channel < 4; ++channel)
            worst =
                std::max(worst, static_cast<double>(std::abs(a.pixels[i][channel] - b.pixels[i][channel])));
        if (!(worst <= bound)) ++beyond;
    }
    return static_cast<double>(beyond) / static_cast<double>(a.pixels.size());
}

/// u of the middle of column x, v of the middle of row y (0 on top).
inline double pictureU(int x, int width) {
    return 2.0 * (x + 0.5) / width - 1.0;
}
inline double pictureV(int y, int height) {
    return 1.0 - 2.0 * (y + 0.5) / height;
}

/// Length in mm of a ray inside the grid's box from t = start on; independent of the renderer's and the
/// reference's code.
inline double chordMm(const Grid& grid, glm::dvec3 originMm, glm::dvec3 unit, double start) {
    const glm::dmat4 inverse = indexFromPatient(grid);
    const glm::dvec3 origin = transformPoint(inverse, originMm);
    const glm::dvec3 direction = transformVector(inverse, unit);
    double from = start;
    double to = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (-0.5 - origin[axis]) / direction[axis];
        const double b = (grid.size[axis] - 0.5 - origin[axis]) / direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return std::max(0.0, to - from);
}

/// Origin and unit direction in mm of the ray through a pixel.
struct PixelRay {
    glm::dvec3 originMm;
    glm::dvec3 direction;
    double startMm;
};
inline PixelRay pixelRay(const Scene& scene, const Grid& grid, int x, int y) {
    const RayFrame frame = rayFrame(scene.camera, grid, scene.picture.size);
    const glm::dvec3 across =
        pictureU(x, scene.picture.size.x) * frame.right + pictureV(y, scene.picture.size.y) * frame.up;
    if (frame.projection == Projection::Orthographic)
        return {frame.eye + across, frame.forward, frame.nearMm};
    const glm::dvec3 direction = glm::normalize(frame.forward + across);
    return {frame.eye, direction, frame.nearMm / glm::dot(direction, frame.forward)};
}

}  // namespace pellucid::test
