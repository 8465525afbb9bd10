// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/features.h"

namespace pellucid::renderer {

bool integratesSegments(Integrator integrator) {
    return integrator != Integrator::Riemann && integrator != Integrator::Exponential;
}

bool usesPreintegration(Integrator integrator) {
    return integrator == Integrator::Preintegrated2D || integrator == Integrator::Preintegrated3D ||
           integrator == Integrator::Importance;
}

bool usesRunningIntegrals(Integrator integrator) {
    return integrator == Integrator::IntegralFunctions || integrator == Integrator::Adaptive;
}

bool followsVoxels(const Features& features) {
    return features.integrator == Integrator::Adaptive && features.filter == Filter::Nearest;
}

Features featuresOf(const Scene& scene) {
    Features features;
    features.mode = scene.mode;
    features.filter = scene.volumes.empty() ? Filter::Trilinear : scene.volumes.front().filter;
    features.projection = scene.camera.projection;
    features.lit = usesLights(scene.mode) && scene.lights && !scene.lights->empty();
    features.lights = features.lit ? static_cast<int>(scene.lights->size()) : 0;
    features.earlyTermination = scene.mode == Mode::Composite && scene.quality.earlyTermination > 0.0;
    if (scene.mode == Mode::XRay) features.xray = scene.xray;
    const bool sumsSamples =
        scene.mode == Mode::Composite || scene.mode == Mode::XRay || scene.mode == Mode::Emission;
    // One voxel is the same before and after.
    if (sumsSamples && !scene.volumes.empty() && features.filter != Filter::Nearest)
        features.classification = scene.volumes.front().classification;
    if (scene.mode == Mode::Isosurface && !scene.volumes.empty())
        features.surfaces = static_cast<int>(scene.volumes.front().isosurfaces.size());
    if (usesIntegrator(scene.mode)) features.integrator = scene.quality.integrator;
    // The two one-sample rules differ in emission only.
    if (scene.mode == Mode::XRay && features.integrator == Integrator::Riemann)
        features.integrator = Integrator::Exponential;
    if (scene.mode == Mode::Composite) features.accumulation = scene.quality.accumulation;
    const bool marches =
        scene.mode != Mode::Slice && scene.mode != Mode::FirstHit && scene.mode != Mode::Isosurface;
    features.jitter = scene.quality.jitter && marches && features.integrator != Integrator::Adaptive;
    const bool showsColours = usesTransferFunction(scene.mode) && scene.mode != Mode::XRay;
    if (showsColours) features.space = scene.space;
    return features;
}

}  // namespace pellucid::renderer
