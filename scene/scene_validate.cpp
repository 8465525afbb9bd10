// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "scene/scene.h"
#include "scene/utf8.h"

namespace pellucid {

namespace {

constexpr int kMaxComponents = 4;
constexpr int kMaxPicturePixels = 16384;
// Pictures are computed in floats, whose largest is 3.4e38. What a scene's numbers make of each other is for
// the plan to check.
constexpr double kLargest = 1e30;
constexpr double kSmallest = 1e-30;
// At a larger exponent the rounding of a float cosine changes a highlight by more than a thousandth.
constexpr double kLargestShininess = 1e4;
// Below this the extinction sought cannot be told from none.
constexpr double kSmallestHitOpacity = 1e-9;

/// Collects the first complaint; the checks read as a list of what is allowed.
class Checker {
public:
    void require(bool good, std::string_view pointer, double found, std::string_view allowed) {
        if (good || !m_result) return;
        m_result = fail(ErrorCode::InvalidArgument,
                        fmt::format("{}: found {}, allowed is {}", pointer, found, allowed));
    }
    void positive(double value, std::string_view pointer) {
        require(std::isfinite(value) && value > 0.0, pointer, value, "a finite number above 0");
    }
    /// Computed with in floats.
    void positiveFloat(double value, std::string_view pointer) {
        require(value > 0.0 && value <= kLargest, pointer, value, "a number in (0, 1e30]");
    }
    void notNegative(double value, std::string_view pointer) {
        require(std::isfinite(value) && value >= 0.0, pointer, value, "a finite number >= 0");
    }
    void notNegativeFloat(double value, std::string_view pointer) {
        require(value >= 0.0 && value <= kLargest, pointer, value, "a number in [0, 1e30]");
    }
    void finite(double value, std::string_view pointer) {
        require(std::isfinite(value), pointer, value, "a finite number");
    }
    void finite(glm::dvec3 value, std::string_view pointer) {
        for (int i = 0; i < 3; ++i) finite(value[i], fmt::format("{}/{}", pointer, i));
    }
    void text(std::string_view value, std::string_view pointer) {
        if (isUtf8(value) || !m_result) return;
        m_result = fail(ErrorCode::InvalidArgument,
                        fmt::format("{}: found bytes that are not UTF-8, allowed is UTF-8 text", pointer));
    }
    /// The outcome of a part whose messages begin with a pointer below it.
    void part(Result<void> result, std::string_view pointer) {
        if (result || !m_result) return;
        result.error().message.insert(0, pointer);
        m_result = std::move(result);
    }
    Result<void> result() { return std::move(m_result); }

private:
    Result<void> m_result;
};

void checkSurface(const SurfaceLayer& surface, const std::string& at, Checker& check) {
    check.finite(surface.value, at + "/value");
    for (int c = 0; c < 3; ++c)
        check.require(surface.color[c] >= 0.0 && surface.color[c] <= 1.0, fmt::format("{}/color/{}", at, c),
                      surface.color[c], "a number in [0, 1]");
    check.require(surface.opacity > 0.0 && surface.opacity <= 1.0, at + "/opacity", surface.opacity,
                  "a number in (0, 1]");
}

void checkItem(const VolumeItem& item, const std::string& at, Checker& check) {
    check.text(item.name, at + "/name");
    check.text(item.source, at + "/source");
    check.require(item.component >= 0 && item.component < kMaxComponents, at + "/component", item.component,
                  "an integer in [0, 3]");
    if (item.transferFunction) {
        check.text(item.transferFunction->name, at + "/transferFunction/name");
        check.text(item.transferFunction->unit, at + "/transferFunction/unit");
        check.part(validate(*item.transferFunction), at + "/transferFunction");
    }
    if (item.window) {
        check.finite(item.window->level, at + "/window/level");
        check.positive(item.window->width, at + "/window/width");
    }
    if (item.isovalue) check.finite(*item.isovalue, at + "/isovalue");
    check.require(item.isosurfaces.size() <= kMaxSurfaces, at + "/isosurfaces",
                  static_cast<double>(item.isosurfaces.size()), "at most 8 surfaces");
    for (std::size_t i = 0; i < item.isosurfaces.size(); ++i)
        checkSurface(item.isosurfaces[i], fmt::format("{}/isosurfaces/{}", at, i), check);
}

void checkLight(const Light& light, const std::string& at, Checker& check) {
    for (int c = 0; c < 3; ++c) check.notNegativeFloat(light.color[c], fmt::format("{}/color/{}", at, c));
    check.notNegativeFloat(light.intensity, at + "/intensity");
    check.finite(light.directionMm, at + "/directionMm");
    check.finite(light.positionMm, at + "/positionMm");
    check.require(light.directionMm != glm::dvec3(0.0), at + "/directionMm", 0.0,
                  "a direction other than [0, 0, 0]");
}

}  // namespace

Result<void> validate(const Scene& scene) {
    Checker check;
    for (std::size_t i = 0; i < scene.volumes.size(); ++i)
        checkItem(scene.volumes[i], fmt::format("/volumes/{}", i), check);
    if (scene.lights)
        for (std::size_t i = 0; i < scene.lights->size(); ++i)
            checkLight((*scene.lights)[i], fmt::format("/lights/{}", i), check);
    check.notNegativeFloat(scene.material.ambient, "/material/ambient");
    check.notNegativeFloat(scene.material.diffuse, "/material/diffuse");
    check.notNegativeFloat(scene.material.specular, "/material/specular");
    check.require(scene.material.shininess > 0.0 && scene.material.shininess <= kLargestShininess,
                  "/material/shininess", scene.material.shininess, "a number in (0, 10000]");
    check.part(validate(scene.camera), "/camera");
    check.require(scene.hitOpacity >= kSmallestHitOpacity && scene.hitOpacity <= 1.0, "/hitOpacity",
                  scene.hitOpacity, "a number in [1e-9, 1]");
    if (scene.unitLengthMm)
        check.require(*scene.unitLengthMm >= kSmallest && *scene.unitLengthMm <= kLargest, "/unitLengthMm",
                      *scene.unitLengthMm, "a number in [1e-30, 1e30]");
    check.notNegativeFloat(scene.densityScale, "/densityScale");
    check.positiveFloat(scene.quality.stepVoxels, "/quality/stepVoxels");
    if (scene.quality.stepMm) check.positiveFloat(*scene.quality.stepMm, "/quality/stepMm");
    if (scene.quality.interpolationGreyLevels)
        check.positive(*scene.quality.interpolationGreyLevels, "/quality/interpolationGreyLevels");
    if (scene.quality.toleranceGreyLevels)
        check.positive(*scene.quality.toleranceGreyLevels, "/quality/toleranceGreyLevels");
    check.require(scene.quality.earlyTermination >= 0.0 && scene.quality.earlyTermination < 1.0,
                  "/quality/earlyTermination", scene.quality.earlyTermination, "a number in [0, 1)");
    for (int i = 0; i < 2; ++i)
        check.require(scene.picture.size[i] >= 1 && scene.picture.size[i] <= kMaxPicturePixels,
                      fmt::format("/picture/size/{}", i), scene.picture.size[i], "an integer in [1, 16384]");
    for (int c = 0; c < 3; ++c)
        check.require(scene.picture.background[c] >= 0.0 && scene.picture.background[c] <= 1.0,
                      fmt::format("/picture/background/{}", c), scene.picture.background[c],
                      "a number in [0, 1]");
    return check.result();
}

}  // namespace pellucid
