// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "scene/volume.h"

namespace pellucid::test {

/// The VoxelType that holds a T.
template <class T>
constexpr VoxelType voxelTypeOf() {
    if constexpr (std::is_same_v<T, std::int8_t>) return VoxelType::Int8;
    if constexpr (std::is_same_v<T, std::uint8_t>) return VoxelType::UInt8;
    if constexpr (std::is_same_v<T, std::int16_t>) return VoxelType::Int16;
    if constexpr (std::is_same_v<T, std::uint16_t>) return VoxelType::UInt16;
    if constexpr (std::is_same_v<T, std::int32_t>) return VoxelType::Int32;
    if constexpr (std::is_same_v<T, std::uint32_t>) return VoxelType::UInt32;
    if constexpr (std::is_same_v<T, float>) return VoxelType::Float32;
    return VoxelType::Float64;
}

template <class T>
std::vector<std::byte> bytesOf(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <class T>
Result<VolumePtr> tryVolume(glm::ivec3 size, const std::vector<T>& values, ValueMapping mapping = {},
                            int components = 1, VolumeInfo info = {}) {
    return Volume::make(axisAlignedGrid(size), voxelTypeOf<T>(), components, bytesOf(values),
                        std::move(mapping), std::move(info));
}

/// A volume on an axis-aligned grid of 1 mm; aborts where Volume::make refuses.
template <class T>
VolumePtr makeVolume(glm::ivec3 size, const std::vector<T>& values, ValueMapping mapping = {},
                     int components = 1, VolumeInfo info = {}) {
    auto volume = tryVolume(size, values, std::move(mapping), components, std::move(info));
    PELLUCID_CHECK(volume.has_value());
    return *volume;
}

}  // namespace pellucid::test
