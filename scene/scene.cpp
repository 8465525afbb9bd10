// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene.h"

#include "scene/check.h"
#include "scene/presets.h"

namespace pellucid {

Scene completed(const Scene& scene, const std::vector<VolumePtr>& volumes) {
    Scene full = scene;
    if (full.volumes.empty() && !volumes.empty()) {
        VolumeItem item;
        item.name = volumes.front()->info().name;
        full.volumes.push_back(item);
    } else {
        PELLUCID_CHECK_EQ(full.volumes.size(), volumes.size());
    }
    for (std::size_t i = 0; i < full.volumes.size(); ++i) {
        VolumeItem& item = full.volumes[i];
        const Volume& volume = *volumes[i];
        if (item.component < 0 || item.component >= volume.components()) continue;
        if (!item.transferFunction) item.transferFunction = defaultTransferFunction(volume, item.component);
        if (!item.window) item.window = defaultWindow(volume, item.component);
        if (!item.isovalue) item.isovalue = defaultIsovalue(volume, item.component);
    }
    if (!full.lights) {
        full.lights.emplace();
        if (usesLights(full.mode)) full.lights->push_back(Light{});
    }
    if (!full.unitLengthMm && !volumes.empty()) full.unitLengthMm = meanSpacingMm(volumes.front()->grid());
    return full;
}

bool keepsTolerance(Integrator integrator) {
    return integrator == Integrator::Adaptive || integrator == Integrator::Importance;
}

double toleranceGreyLevels(const Quality& quality) {
    return quality.toleranceGreyLevels.value_or(1.0);
}

double stepMm(const Quality& quality, const Grid& grid) {
    return quality.stepMm ? *quality.stepMm : quality.stepVoxels * smallestSpacingMm(grid);
}

Filter fieldOf(Filter filter) {
    switch (filter) {
        case Filter::TrilinearExact:
            return Filter::Trilinear;
        case Filter::TricubicBSplineDeBoor:
        case Filter::TricubicBSplineLut:
            return Filter::TricubicBSpline;
        default:
            return filter;
    }
}

bool boundsBends(Filter filter) {
    return fieldOf(filter) == Filter::Trilinear || fieldOf(filter) == Filter::TricubicBSpline;
}

bool usesTransferFunction(Mode mode) {
    return mode == Mode::Composite || mode == Mode::XRay || mode == Mode::Emission ||
           mode == Mode::FirstHit || mode == Mode::Isosurface;
}

bool usesIntegrator(Mode mode) {
    return mode == Mode::Composite || mode == Mode::XRay;
}

bool usesLights(Mode mode) {
    return mode == Mode::Composite || mode == Mode::FirstHit || mode == Mode::Isosurface;
}

bool usesWindow(Mode mode) {
    return mode == Mode::Mip || mode == Mode::MinIp || mode == Mode::Average || mode == Mode::Slice;
}

}  // namespace pellucid
