// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace pellucid::renderer {

/// The structure of a scene: everything that selects shader text, and nothing that is a mere number.
/// Two scenes with equal features use the same program.
struct Features {
    Mode mode = Mode::Composite;
    Filter filter = Filter::Trilinear;
    Projection projection = Projection::Perspective;
    bool lit = false;
    int lights = 0;  ///< Count of lights; 0 unless lit.
    bool earlyTermination = false;
    XRayDisplay xray = XRayDisplay::Opacity;
    CompositingSpace space = CompositingSpace::Display;
    bool operator==(const Features&) const = default;
};

/// Pure; drops what cannot matter (no lights in a mode that does not shade, no termination where nothing
/// saturates). Precondition: the scene is completed().
[[nodiscard]] Features featuresOf(const Scene& scene);

}  // namespace pellucid::renderer
