// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/features.h"

namespace pellucid::renderer {

Features featuresOf(const Scene& scene) {
    Features features;
    features.mode = scene.mode;
    features.filter = scene.volumes.empty() ? Filter::Trilinear : scene.volumes.front().filter;
    features.projection = scene.camera.projection;
    features.lit = usesLights(scene.mode) && scene.lights && !scene.lights->empty();
    features.lights = features.lit ? static_cast<int>(scene.lights->size()) : 0;
    features.earlyTermination = scene.mode == Mode::Composite && scene.quality.earlyTermination > 0.0;
    if (scene.mode == Mode::XRay) features.xray = scene.xray;
    const bool showsColours = usesTransferFunction(scene.mode) && scene.mode != Mode::XRay;
    if (showsColours) features.space = scene.space;
    return features;
}

}  // namespace pellucid::renderer
