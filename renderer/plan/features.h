// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace pellucid::renderer {

/// What is done about samples that cannot show. The picture is the same.
enum class Skipping {
    None,
    Box,   ///< Rays are cut to the box around all blocks that can show.
    Leaps  ///< And pass over empty blocks within it.
};

/// Where the gradient of a lit sample comes from.
enum class GradientSource {
    OnTheFly,  ///< Six more values around it.
    Texture    ///< One fetch, with the value.
};

/// The structure of a scene: everything that selects shader text, and nothing that is a mere number.
/// Two scenes with equal features use the same program.
struct Features {
    Mode mode = Mode::Composite;
    Filter filter = Filter::Trilinear;
    Projection projection = Projection::Perspective;
    bool lit = false;
    int lights = 0;  ///< Count of lights; 0 unless lit.
    bool earlyTermination = false;
    Integrator integrator = Integrator::Exponential;       ///< Composite and XRay only.
    Accumulation accumulation = Accumulation::Float32;     ///< Composite only.
    bool jitter = false;                                   ///< Where rays have steps of one length.
    Classification classification = Classification::Post;  ///< Composite, XRay and Emission only.
    int surfaces = 0;  ///< Count of the volume's isosurfaces; Isosurface only.
    XRayDisplay xray = XRayDisplay::Opacity;
    CompositingSpace space = CompositingSpace::Display;
    // Set by makePlan, since they depend on the data or the device too.
    Skipping skipping = Skipping::None;
    GradientSource gradients = GradientSource::OnTheFly;
    bool slabs = false;  ///< Rays are drawn in parts.
    bool operator==(const Features&) const = default;
};

/// Integrators that look at both ends of a segment; the others take one sample in its middle.
[[nodiscard]] bool integratesSegments(Integrator integrator);

/// Integrators that look segments up in a table over the values at both ends.
[[nodiscard]] bool usesPreintegration(Integrator integrator);
/// Integrators that make segments from running integrals of the transfer function.
[[nodiscard]] bool usesRunningIntegrals(Integrator integrator);

/// True where segments end at the borders of voxels, whatever the step.
[[nodiscard]] bool followsVoxels(const Features& features);

/// Pure; drops what cannot matter (no lights in a mode that does not shade, no termination where nothing
/// saturates). Precondition: the scene is completed().
[[nodiscard]] Features featuresOf(const Scene& scene);

}  // namespace pellucid::renderer
