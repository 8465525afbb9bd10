// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "scene/scene.h"

namespace pellucid::test {

/// A cube of int16 with a value from a function of the index; index spacing in mm.
template <class F>
VolumePtr makeVolume(glm::ivec3 size, F&& value, glm::dvec3 spacingMm = {1, 1, 1},
                     ValueMapping mapping = {}) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                                 static_cast<std::size_t>(size.z) * 2);
    auto* voxel = reinterpret_cast<std::int16_t*>(bytes.data());
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) *voxel++ = static_cast<std::int16_t>(value(i, j, k));
    return Volume::make(axisAlignedGrid(size, spacingMm), VoxelType::Int16, 1, std::move(bytes), mapping)
        .value();
}

/// A ball of 1000 in 0, soft at the rim.
inline VolumePtr ballVolume(int n = 24) {
    return makeVolume({n, n, n}, [n](int i, int j, int k) {
        const double c = 0.5 * (n - 1);
        const double r = std::sqrt((i - c) * (i - c) + (j - c) * (j - c) + (k - c) * (k - c));
        return 1000.0 / (1.0 + std::exp(r - 0.3 * n));
    });
}

/// Unlit composite of a volume with a ramp from 200 to 800.
inline Scene rampScene(Mode mode = Mode::Composite) {
    Scene scene;
    VolumeItem item;
    item.transferFunction =
        TransferFunction1D{"ramp", "", {{200, {0.2, 0.4, 1.0}, 0.0}, {800, {1.0, 0.6, 0.2}, 0.5}}};
    item.window = Window{500, 1000};
    item.isovalue = 500.0;
    scene.volumes = {item};
    scene.lights.emplace();
    scene.mode = mode;
    scene.hitOpacity = 0.1;
    scene.unitLengthMm = 1.0;
    scene.picture.size = {48, 40};
    return scene;
}

inline constexpr Mode kAllModes[] = {Mode::Composite, Mode::Mip,        Mode::MinIp,
                                     Mode::Average,   Mode::XRay,       Mode::Emission,
                                     Mode::FirstHit,  Mode::Isosurface, Mode::Slice};
inline constexpr Filter kAllFilters[] = {
    Filter::Nearest,  Filter::Trilinear,      Filter::TricubicBSpline,       Filter::CatmullRom,
    Filter::Lanczos3, Filter::TrilinearExact, Filter::TricubicBSplineDeBoor, Filter::TricubicBSplineLut};

}  // namespace pellucid::test
