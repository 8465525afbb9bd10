// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "accuracy/field.h"
#include "accuracy/optics.h"
#include "accuracy/ray_clip.h"
#include "accuracy/ray_walk.h"

namespace pellucid::accuracy {

/// The ray through a point of the picture plane; t in mm from `originMm`.
struct ViewRay {
    IndexRay index;
    glm::dvec3 originMm{0.0};  ///< Relative to the volume's centre.
    glm::dvec3 direction{0.0};
    double startMm = 0.0;             ///< t at the near plane.
    double sliceMm = 0.0;             ///< t at the plane through the target.
    std::optional<Interval> inside;   ///< The volume.
    std::vector<Interval> visible{};  ///< What a clip leaves of it; ascending.

    [[nodiscard]] double visibleMm() const;
};

/// A scene's volume as a continuous medium in double: rays, values, colours, extinction, light, and how what
/// a ray has met is shown. Knows nothing of steps.
class Medium {
public:
    /// `insetVoxels`: the volume ends this far inside the box that its voxels fill. `clip` may be empty.
    /// Precondition: the scene is completed() and valid, with one volume.
    Medium(const Scene& scene, const Volume& volume, double insetVoxels = 0.0, RayClip clip = {});

    /// u and v in [-1, 1] (v up).
    [[nodiscard]] ViewRay rayAt(double u, double v) const;

    [[nodiscard]] const Scene& scene() const { return m_scene; }
    [[nodiscard]] const Field& field() const { return m_field; }
    [[nodiscard]] const Optics& optics() const { return m_optics; }
    /// Ascending; colours in the compositing space.
    [[nodiscard]] const std::vector<SurfaceLayer>& surfaces() const { return m_surfaces; }
    [[nodiscard]] bool lit() const { return m_lit; }
    [[nodiscard]] bool preClassified() const { return m_preClassified.has_value(); }

    [[nodiscard]] glm::ivec3 cellAt(const ViewRay& ray, double t) const;
    [[nodiscard]] double valueAt(const ViewRay& ray, glm::ivec3 cell, double t) const;
    /// `piece`: of optics(), the linear piece of the transfer function that the value lies on.
    [[nodiscard]] LocalOptics opticsAt(const ViewRay& ray, glm::ivec3 cell, int piece, double t) const;
    [[nodiscard]] glm::dvec3 shaded(const ViewRay& ray, glm::ivec3 cell, double t, glm::dvec3 color) const;

    /// The picture's RGBA, as ImageF has it: of an associated colour, an opaque one, a value in the window.
    [[nodiscard]] glm::dvec4 blended(const glm::dvec3& color, double transmittance, double alpha) const;
    [[nodiscard]] glm::dvec4 opaque(const std::optional<glm::dvec3>& color) const;
    [[nodiscard]] glm::dvec4 windowed(const std::optional<double>& value) const;

private:
    /// Fields of extinction times colour, and of extinction: the transfer function applied to voxels.
    struct PreClassifiedFields {
        Field red, green, blue, extinction;
    };
    [[nodiscard]] PreClassifiedFields preClassifiedFields() const;
    [[nodiscard]] std::vector<Interval> visibleParts(const ViewRay& ray) const;

    Scene m_scene;
    Field m_field;
    Optics m_optics;
    std::optional<PreClassifiedFields> m_preClassified;
    std::vector<SurfaceLayer> m_surfaces;
    RayFrame m_frame;
    double m_inset;
    RayClip m_clip;
    glm::dvec3 m_centreMm;
    glm::dmat3 m_indexFromPatient;     ///< For vectors.
    glm::dmat3 m_gradientFromIndex;    ///< Its transpose: index gradients to patient gradients.
    double m_vanishingGradient = 0.0;  ///< Per voxel step.
    glm::dvec3 m_background;           ///< In the compositing space.
    bool m_lit = false;
};

}  // namespace pellucid::accuracy
