// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/report_reference.h"

#include <glm/common.hpp>

#include "accuracy/report_plan.h"

namespace pellucid::accuracy {

ReferenceKind referenceOf(const ReportSetting& setting, const Scene& scene) {
    const bool lit = usesLights(scene.mode) && !scene.lights->empty();
    return {fieldOf(setting.filter), isPeer(setting), setting.renderer == "vtk-gpu" && lit};
}

std::string referenceName(const ReferenceKind& kind) {
    std::string text = name(kind.filter);
    if (kind.peers) text += ", VTK's box";
    if (kind.lightAtEye) text += ", light at the eye";
    return text;
}

std::string referenceStem(const ReferenceKind& kind) {
    return std::string("reference-") + name(kind.filter) + (kind.peers ? "-peers" : "") +
           (kind.lightAtEye ? "-lit" : "");
}

Result<Reference> drawReference(const Scene& scene, const VolumePtr& volume, const ReferenceKind& kind,
                                glm::ivec2 size, ReferenceOptions options) {
    ReportSetting setting;
    setting.filter = kind.filter;
    Scene drawn = sceneWith(scene, setting, size);
    if (kind.lightAtEye)
        for (Light& light : *drawn.lights) {
            light.kind = LightKind::Point;
            light.positionMm = rayFrame(drawn.camera, volume->grid(), size).eye;
        }
    options.insetVoxels = kind.peers ? 0.5 : 0.0;
    auto reference = referencePicture(drawn, {volume}, options);
    if (reference && kind.peers)
        for (glm::vec4& pixel : reference->image.pixels) pixel = glm::clamp(pixel, 0.0F, 1.0F);
    return reference;
}

}  // namespace pellucid::accuracy
