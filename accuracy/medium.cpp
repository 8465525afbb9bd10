// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/medium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/image.h"

namespace pellucid::accuracy {
namespace {

glm::dvec3 displayed(const glm::dvec3& color, CompositingSpace space) {
    if (space == CompositingSpace::Display) return color;
    return {displayFromLinear(color.r), displayFromLinear(color.g), displayFromLinear(color.b)};
}

}  // namespace

double ViewRay::visibleMm() const {
    double length = 0.0;
    for (const Interval& part : visible) length += part.to - part.from;
    return length;
}

Medium::Medium(const Scene& scene, const Volume& volume, double insetVoxels, RayClip clip)
    : m_scene(scene),
      m_field(volume, scene.volumes.front().component, scene.volumes.front().filter),
      m_optics(*scene.volumes.front().transferFunction, scene.space, *scene.unitLengthMm, scene.densityScale),
      m_frame(rayFrame(scene.camera, volume.grid(), scene.picture.size)),
      m_inset(insetVoxels),
      m_clip(std::move(clip)),
      m_centreMm(centreMm(volume.grid())),
      m_indexFromPatient(glm::inverse(glm::dmat3(volume.grid().patientFromIndex))),
      m_gradientFromIndex(glm::transpose(m_indexFromPatient)),
      m_background(scene.picture.background),
      m_lit(usesLights(scene.mode) && !scene.lights->empty()) {
    const bool linear = scene.space == CompositingSpace::Linear;
    if (linear) m_background = linearFromDisplay(m_background);
    if (scene.volumes.front().classification == Classification::Pre && scene.mode != Mode::FirstHit &&
        scene.mode != Mode::Isosurface)
        m_preClassified = preClassifiedFields();
    m_surfaces = scene.volumes.front().isosurfaces;
    std::stable_sort(m_surfaces.begin(), m_surfaces.end(),
                     [](const SurfaceLayer& a, const SurfaceLayer& b) { return a.value < b.value; });
    if (linear)
        for (SurfaceLayer& surface : m_surfaces) surface.color = linearFromDisplay(surface.color);
    const ValueRange range = volume.physicalRange(scene.volumes.front().component);
    // The second term: rounding of a filter's weights on a constant field.
    m_vanishingGradient =
        1e-6 * (range.hi - range.lo) + 1e-14 * std::max(std::abs(range.lo), std::abs(range.hi));
}

ViewRay Medium::rayAt(double u, double v) const {
    ViewRay ray;
    const glm::dvec3 across = u * m_frame.right + v * m_frame.up;
    ray.originMm = m_frame.eye - m_centreMm;
    if (m_frame.projection == Projection::Orthographic) {
        ray.originMm += across;
        ray.direction = m_frame.forward;
    } else {
        ray.direction = glm::normalize(m_frame.forward + across);
    }
    const double forwardPerMm = glm::dot(ray.direction, m_frame.forward);
    ray.startMm = m_frame.nearMm / forwardPerMm;
    ray.sliceMm = m_frame.targetDistanceMm / forwardPerMm;
    // Relative to the centre, so that a scan far from the origin loses no digits.
    ray.index.origin = m_indexFromPatient * ray.originMm + (glm::dvec3(m_field.size()) - 1.0) / 2.0;
    ray.index.perMm = m_indexFromPatient * ray.direction;
    ray.inside = insideBox(ray.index, m_field.size(), ray.startMm, m_inset);
    if (ray.inside) ray.visible = visibleParts(ray);
    return ray;
}

std::vector<Interval> Medium::visibleParts(const ViewRay& ray) const {
    if (!m_clip) return {*ray.inside};
    std::vector<Interval> parts = m_clip(m_centreMm + ray.originMm, ray.direction, *ray.inside);
    for (Interval& part : parts)
        part = {std::max(part.from, ray.inside->from), std::min(part.to, ray.inside->to)};
    std::erase_if(parts, [](const Interval& part) { return !(part.from < part.to); });
    return parts;
}

Medium::PreClassifiedFields Medium::preClassifiedFields() const {
    std::array<std::vector<double>, 4> fields;
    for (const double value : m_field.voxels()) {
        const LocalOptics local = m_optics.at(value);
        for (std::size_t channel = 0; channel < 3; ++channel)
            fields[channel].push_back(local.extinction * local.color[static_cast<int>(channel)]);
        fields[3].push_back(local.extinction);
    }
    const auto field = [&](std::size_t i) {
        return Field(m_field.size(), m_scene.volumes.front().filter, std::move(fields[i]));
    };
    return {field(0), field(1), field(2), field(3)};
}

LocalOptics Medium::opticsAt(const ViewRay& ray, glm::ivec3 cell, int piece, double t) const {
    if (!m_preClassified) return m_optics.at(piece, valueAt(ray, cell, t));
    const glm::dvec3 index = ray.index.at(t);
    const auto at = [&](const Field& field) { return field.value(cell, index); };
    const double extinction = at(m_preClassified->extinction);
    if (!(extinction > 0.0)) return {};
    return {glm::dvec3(at(m_preClassified->red), at(m_preClassified->green), at(m_preClassified->blue)) /
                extinction,
            extinction};
}

glm::ivec3 Medium::cellAt(const ViewRay& ray, double t) const {
    return m_field.cellOf(ray.index.at(t));
}

double Medium::valueAt(const ViewRay& ray, glm::ivec3 cell, double t) const {
    return m_field.value(cell, ray.index.at(t));
}

glm::dvec3 Medium::shaded(const ViewRay& ray, glm::ivec3 cell, double t, glm::dvec3 color) const {
    if (!m_lit) return color;
    const glm::dvec3 perIndex = m_field.centralDifference(cell, ray.index.at(t));
    if (!(glm::length(perIndex) > m_vanishingGradient)) return color;
    const glm::dvec3 gradient = m_gradientFromIndex * perIndex;

    const glm::dvec3 toViewer = -ray.direction;
    glm::dvec3 normal = -glm::normalize(gradient);
    if (glm::dot(normal, toViewer) < 0.0) normal = -normal;
    const Material& material = m_scene.material;
    glm::dvec3 result = material.ambient * color;
    for (const Light& light : *m_scene.lights) {
        glm::dvec3 toLight = -m_frame.forward;
        if (light.kind == LightKind::Directional) toLight = -glm::normalize(light.directionMm);
        if (light.kind == LightKind::Point)
            toLight = glm::normalize(light.positionMm - m_centreMm - ray.originMm - t * ray.direction);
        const glm::dvec3 between = toLight + toViewer;
        const double halfLength = glm::length(between);
        const double cosHalf = halfLength > 0.0 ? std::max(glm::dot(normal, between) / halfLength, 0.0) : 0.0;
        const double cosLight = std::max(glm::dot(normal, toLight), 0.0);
        result +=
            light.intensity * light.color *
            (material.diffuse * cosLight * color + material.specular * std::pow(cosHalf, material.shininess));
    }
    return result;
}

glm::dvec4 Medium::blended(const glm::dvec3& color, double transmittance, double alpha) const {
    if (!m_scene.picture.transparent)
        return {displayed(color + transmittance * m_background, m_scene.space), alpha};
    // An associated colour is encoded as the colour it is the association of; a glow has none.
    const double association = alpha > 0.0 ? alpha : 1.0;
    return {association * displayed(color / association, m_scene.space), alpha};
}

glm::dvec4 Medium::opaque(const std::optional<glm::dvec3>& color) const {
    return color ? blended(*color, 0.0, 1.0) : blended(glm::dvec3(0.0), 1.0, 0.0);
}

/// Grey levels are what is shown, so the compositing space does not change them.
glm::dvec4 Medium::windowed(const std::optional<double>& value) const {
    if (!value) return blended(glm::dvec3(0.0), 1.0, 0.0);
    const Window& window = *m_scene.volumes.front().window;
    const double grey = std::clamp((*value - (window.level - window.width / 2.0)) / window.width, 0.0, 1.0);
    return {glm::dvec3(grey), 1.0};
}

}  // namespace pellucid::accuracy
