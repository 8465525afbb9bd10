// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/volume_format.h"

namespace pellucid::renderer {

bool isStoredIn16Bits(VoxelType type) {
    return type == VoxelType::Int8 || type == VoxelType::UInt8 || type == VoxelType::Int16 ||
           type == VoxelType::UInt16;
}

const char* textureFormatName(VoxelType type) {
    return isStoredIn16Bits(type) ? "R16" : "R32F";
}

std::uint64_t textureBytes(const VolumeFacts& facts) {
    const auto size = glm::dvec3(facts.grid.size);
    return static_cast<std::uint64_t>(size.x * size.y * size.z) * (isStoredIn16Bits(facts.type) ? 2u : 4u);
}

StoredFromTexel storedFromTexel(VoxelType type, ValueRange storedRange) {
    switch (type) {
        case VoxelType::UInt8:
            return {255.0, 0.0};
        case VoxelType::Int8:
            return {255.0, -128.0};
        case VoxelType::UInt16:
            return {65535.0, 0.0};
        case VoxelType::Int16:
            return {65535.0, -32768.0};
        default:
            break;
    }
    const double extent = storedRange.hi - storedRange.lo;
    return {extent > 0.0 ? extent : 1.0, storedRange.lo};
}

}  // namespace pellucid::renderer
