// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/passes/raycast_uniforms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/plan/importance.h"
#include "renderer/plan/number_limits.h"
#include "renderer/plan/slabs.h"
#include "scene/image.h"

namespace pellucid::renderer {

namespace {

/// Distance in front of the eye of the plane that rays are anchored on. Near the volume, so that float
/// positions on it are as exact as the volume is small, however far the eye; the eye itself when it is close,
/// where the plane would be ill-defined.
double anchorDistance(const RayFrame& frame, glm::dvec3 eyeFromCentre, double radius) {
    const double alongForward = -glm::dot(eyeFromCentre, frame.forward);
    if (frame.projection == Projection::Orthographic) return alongForward;
    return alongForward > 2.0 * radius ? alongForward : 0.0;
}

void addRay(Uniforms& uniforms, const RayFrame& frame, const Grid& grid) {
    const glm::dvec3 eye = frame.eye - centreMm(grid);
    const double anchor = anchorDistance(frame, eye, radiusMm(grid));
    const auto add = [&](const char* name, glm::dvec3 value) {
        uniforms.emplace_back(name, glm::vec3(value));
    };
    add("rayBase", eye + anchor * frame.forward);
    add("rayAnchorRight", anchor * frame.right);
    add("rayAnchorUp", anchor * frame.up);
    add("rayRight", frame.right);
    add("rayUp", frame.up);
    add("rayForward", frame.forward);
    add("planeForward", frame.forward);
    uniforms.emplace_back("rayNearFromAnchorMm", static_cast<float>(frame.nearMm - anchor));
    uniforms.emplace_back("planeFromAnchorMm", static_cast<float>(frame.targetDistanceMm - anchor));
}

void addGeometry(Uniforms& uniforms, const Grid& grid, double texelExtent) {
    glm::dmat4 patientFromRender(1.0);
    patientFromRender[3] = glm::dvec4(centreMm(grid), 1.0);
    uniforms.emplace_back("textureFromRender", glm::mat4(textureFromPatient(grid) * patientFromRender));
    uniforms.emplace_back("volumeSize", glm::vec3(grid.size));
    uniforms.emplace_back("voxelStep", glm::vec3(1.0 / glm::dvec3(grid.size)));
    glm::dmat3 gradient = glm::transpose(glm::dmat3(indexFromPatient(grid)));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(gradient[column][row]));
    uniforms.emplace_back("gradientFromIndex", glm::mat3(gradient / largest));
    // Below a millionth of the value range a voxel the direction is rounding noise of the interpolation.
    uniforms.emplace_back("gradientFloor", static_cast<float>(1e-6 * texelExtent));
}

/// Of the texture of values and gradients, which has a voxel more on every side.
void addField(Uniforms& uniforms, const Grid& grid, const FieldLayout& layout) {
    const glm::dvec3 size(layout.size);
    uniforms.emplace_back("fieldScale", glm::vec3(glm::dvec3(grid.size) / size));
    uniforms.emplace_back("fieldOffset", glm::vec3(1.0 / size));
    uniforms.emplace_back("differenceFromTexel", glm::vec2(layout.differenceFromTexel()));
}

/// A table coordinate (or position) of entry i of `size`, i = (value - lo) / (hi - lo) * (size - 1), as a
/// line over u: i * scale + offset.
glm::vec2 entryFromTexel(const VolumeTexture& volume, double lo, double hi, int size, double scale,
                         double offset) {
    // Divided first: over denormal values (size - 1) / (hi - lo) would be infinite.
    if (!(hi > lo)) return {0.0, offset};
    const double entries = (size - 1.0) * scale;
    return {volume.physicalPerTexel() / (hi - lo) * entries,
            (volume.physicalAtZero() - lo) / (hi - lo) * entries + offset};
}

/// Entry i stands at texture coordinate (i + 0.5) / size.
glm::vec2 coordinateFromTexel(const VolumeTexture& volume, double lo, double hi, int size) {
    return entryFromTexel(volume, lo, hi, size, 1.0 / size, 0.5 / size);
}

void addTables(Uniforms& uniforms, const Plan& plan, const VolumeTexture& volume, const FrameTables& tables) {
    if (tables.transfer != nullptr) {
        const auto& layout = tables.transfer->layout;
        uniforms.emplace_back("tableFromValue",
                              coordinateFromTexel(volume, layout.lo, layout.hi, layout.size));
    }
    if (tables.preintegration != nullptr) {
        const auto& table = *tables.preintegration;
        const auto& layout = table.layout;
        uniforms.emplace_back("entryFromValue",
                              entryFromTexel(volume, layout.lo, layout.hi, layout.size, 1.0, 0.0));
        uniforms.emplace_back("opticsBelow", glm::vec4(table.below.color, table.below.extinction));
        uniforms.emplace_back("opticsAbove", glm::vec4(table.above.color, table.above.extinction));
        uniforms.emplace_back("fullLengthMm", static_cast<float>(plan.longestStepMm));
    }
    if (tables.integrals != nullptr) {
        const auto& table = *tables.integrals;
        uniforms.emplace_back("integralFromValue",
                              entryFromTexel(volume, table.lo, table.hi, table.size, 1.0, 0.0));
    }
}

void addSkipping(Uniforms& uniforms, const Grid& grid, const Occupancy& occupancy) {
    const glm::dvec3 textureFromBlock = double(kBlockEdge) / glm::dvec3(grid.size);
    const bool nothing = occupancy.occupied == 0;
    uniforms.emplace_back(
        "boxLo", nothing ? glm::vec3(1.0f) : glm::vec3(glm::dvec3(occupancy.boxLo) * textureFromBlock));
    uniforms.emplace_back(
        "boxHi", nothing ? glm::vec3(0.0f) : glm::vec3(glm::dvec3(occupancy.boxHi) * textureFromBlock));
    uniforms.emplace_back("blocksFromTexture", glm::vec3(1.0 / textureFromBlock));
}

/// The step, and for the adaptive integrator the step it starts from and never exceeds.
void addAdaptive(Uniforms& uniforms, const Scene& scene, const Plan& plan, double maxLoopTurns) {
    constexpr double kShortest = 1.0 / 64.0;  // of a step; what is left there is a jump that no step resolves
    constexpr double kSafety = 0.5;           // estimates are not bounds
    const bool adaptive = plan.features.integrator == Integrator::Adaptive;
    uniforms.emplace_back("stepMm", static_cast<float>(plan.stepMm));
    if (!adaptive) return;
    // Four turns for each of the shortest segments (some are refused before they are short) must fit into
    // what the driver gives.
    maxLoopTurns /= turnsPerSample(plan);
    const double longestRay = plan.samplesPerRay * plan.stepMm;
    const double shortest = std::max(kShortest * plan.stepMm, 4.0 * longestRay / maxLoopTurns);
    uniforms.emplace_back("shortestStepMm", static_cast<float>(shortest));
    uniforms.emplace_back("tolerance",
                          static_cast<float>(toleranceGreyLevels(scene.quality) / 255.0 * kSafety));
    uniforms.emplace_back("mostSegments",
                          static_cast<int>(std::min(4.0 * longestRay / shortest + 64.0, maxLoopTurns)));
}

void addImportance(Uniforms& uniforms, const Scene& scene, const Plan& plan, const Grid& grid) {
    if (plan.features.integrator != Integrator::Importance) return;
    uniforms.emplace_back("longestStepMm", static_cast<float>(plan.longestStepMm));
    uniforms.emplace_back("importanceFromTexture", glm::vec3(glm::dvec3(grid.size) / double{kBlockEdge}));
    uniforms.emplace_back("kinkWeight", static_cast<float>(kinkWeight(plan.features.filter)));
    uniforms.emplace_back("layerMm", static_cast<float>(layerMm(grid)));
    uniforms.emplace_back("eightTolerances", static_cast<float>(8.0 * importanceTolerance(scene.quality)));
}

}  // namespace

glm::vec3 backgroundOf(const Scene& scene, const Plan& plan) {
    if (scene.picture.transparent) return glm::vec3(0.0f);
    const glm::dvec3 shown = scene.picture.background;
    return glm::vec3(plan.features.space == CompositingSpace::Linear ? linearFromDisplay(shown) : shown);
}

Uniforms raycastUniforms(const Scene& scene, const Plan& plan, const Grid& grid, const VolumeTexture& volume,
                         const FrameTables& tables, double maxLoopTurns) {
    Uniforms uniforms;
    const auto& item = scene.volumes.front();
    uniforms.emplace_back("pictureSize", glm::vec2(scene.picture.size));
    addRay(uniforms, rayFrame(scene.camera, grid, scene.picture.size), grid);
    addGeometry(uniforms, grid, volume.texelExtent);
    if (tables.field != nullptr) addField(uniforms, grid, tables.field->layout);
    addAdaptive(uniforms, scene, plan, maxLoopTurns);
    addImportance(uniforms, scene, plan, grid);
    if (plan.features.slabs) uniforms.emplace_back("slabStepMm", static_cast<float>(plan.stepMm));
    uniforms.emplace_back("background", backgroundOf(scene, plan));
    uniforms.emplace_back("transparentPicture", scene.picture.transparent ? 1 : 0);
    uniforms.emplace_back("material", glm::vec4(scene.material.ambient, scene.material.diffuse,
                                                scene.material.specular, scene.material.shininess));
    if (usesWindow(scene.mode)) {
        const auto& window = *item.window;
        uniforms.emplace_back("windowFromValue",
                              glm::vec2(volume.physicalPerTexel() / window.width,
                                        (volume.physicalAtZero() - window.level) / window.width + 0.5));
    }
    if (scene.mode == Mode::Isosurface)
        uniforms.emplace_back("isovalue", static_cast<float>(volume.texelFromPhysical(*item.isovalue)));
    if (usesTransferFunction(scene.mode)) {
        uniforms.emplace_back("extinctionPerMm",
                              static_cast<float>(scene.densityScale / *scene.unitLengthMm));
        // Opacity of one unit length, as extinction per mm; a hair lower, so that a plateau at the threshold
        // itself counts.
        uniforms.emplace_back(
            "hitExtinctionPerMm",
            static_cast<float>(extinctionFromOpacity(scene.hitOpacity) / *scene.unitLengthMm * (1.0 - 1e-6)));
    }
    addTables(uniforms, plan, volume, tables);
    if (tables.occupancy != nullptr) addSkipping(uniforms, grid, *tables.occupancy);
    const bool linear = plan.features.space == CompositingSpace::Linear;
    // The sRGB curve is 12.92 times steeper in the dark than light-linear values.
    const double steepest = (linear ? 12.92 : 1.0) * brightestReflection(scene);
    uniforms.emplace_back("terminationTransmittance",
                          static_cast<float>(plan.earlyTerminationBound / steepest));
    uniforms.emplace_back("volumeTexture", 0);
    uniforms.emplace_back("transferTable", 1);
    uniforms.emplace_back("preintegrationTable", 2);
    uniforms.emplace_back("integralTable", 2);
    uniforms.emplace_back("blueNoise", 3);
    uniforms.emplace_back("filterWeights", 4);
    uniforms.emplace_back("leapField", 5);
    uniforms.emplace_back("importanceVolume", 6);
    uniforms.emplace_back("fieldTexture", 7);
    return uniforms;
}

std::vector<glm::vec4> surfaceBlock(std::vector<SurfaceLayer> surfaces, CompositingSpace space,
                                    const VolumeTexture& volume) {
    const auto texel = [&](const SurfaceLayer& surface) {
        return static_cast<float>(volume.texelFromPhysical(surface.value));
    };
    std::stable_sort(surfaces.begin(), surfaces.end(),
                     [&](const SurfaceLayer& a, const SurfaceLayer& b) { return texel(a) < texel(b); });
    std::vector<glm::vec4> block;
    for (const SurfaceLayer& surface : surfaces) {
        const glm::dvec3 color =
            space == CompositingSpace::Linear ? linearFromDisplay(surface.color) : surface.color;
        block.emplace_back(glm::vec3(color), static_cast<float>(surface.opacity));
        block.emplace_back(texel(surface), 0.0f, 0.0f, 0.0f);
    }
    return block;
}

std::vector<glm::vec4> lightBlock(const Scene& scene, const Grid& grid) {
    std::vector<glm::vec4> block;
    const glm::dvec3 forward = axesOf(resolvedPose(scene.camera, grid, 1.0)).forward;
    for (const auto& light : *scene.lights) {
        block.emplace_back(glm::vec3(light.color * light.intensity), 1.0f);
        switch (light.kind) {
            case LightKind::Headlight:
                block.emplace_back(glm::vec3(-forward), 0.0f);
                break;
            case LightKind::Directional:
                block.emplace_back(glm::vec3(-glm::normalize(light.directionMm)), 0.0f);
                break;
            case LightKind::Point:
                block.emplace_back(glm::vec3(light.positionMm - centreMm(grid)), 1.0f);
                break;
        }
    }
    return block;
}

}  // namespace pellucid::renderer
