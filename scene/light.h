// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/vec3.hpp>

namespace pellucid {

enum class LightKind {
    Headlight,    ///< Travels with the camera, shines along the view direction.
    Directional,  ///< Parallel light along `directionMm` in the patient frame.
    Point         ///< From `positionMm` in the patient frame, no falloff with distance.
};

struct Light {
    LightKind kind = LightKind::Headlight;
    glm::dvec3 color{1.0, 1.0, 1.0};        ///< RGB >= 0, in the compositing space.
    double intensity = 1.0;                 ///< >= 0.
    glm::dvec3 directionMm{0.0, 1.0, 0.0};  ///< Directional: where the light travels to; any length but 0.
    glm::dvec3 positionMm{0.0, 0.0, 0.0};   ///< Point.
    bool operator==(const Light&) const = default;
};

/// Blinn-Phong reflection (Blinn 1977; Engel et al. 2006, section 5.4): shown = ambient * c
///   + sum over lights of I * L * (diffuse * c * max(n.l, 0) + specular * max(n.h, 0)^shininess),
/// with n turned towards the viewer (two-sided) and, where the gradient vanishes, the unlit colour c.
/// Ambient counts once and only while there is a light.
struct Material {
    double ambient = 0.1;
    double diffuse = 0.9;
    double specular = 0.2;
    double shininess = 10.0;  ///< > 0.
    bool operator==(const Material&) const = default;
};

}  // namespace pellucid
