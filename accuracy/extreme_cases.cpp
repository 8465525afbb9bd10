// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/extreme_scenes.h"

namespace pellucid::accuracy {

std::vector<ExtremeCase> extremeCases() {
    extreme::Cases cases;
    extreme::addOpticalDepths(cases);
    extreme::addFunctions(cases);
    extreme::addVolumes(cases);
    extreme::addGrids(cases);
    extreme::addValues(cases);
    extreme::addCameras(cases);
    extreme::addLights(cases);
    return cases;
}

}  // namespace pellucid::accuracy
