// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/synthetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace pellucid::accuracy {
namespace {

template <class T>
T storedAs(double value) {
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(value);
    } else {
        const double lo = static_cast<double>(std::numeric_limits<T>::min());
        const double hi = static_cast<double>(std::numeric_limits<T>::max());
        return static_cast<T>(std::clamp(std::round(value), lo, hi));
    }
}

template <class T>
std::vector<std::byte> voxelsOf(glm::ivec3 size, const std::function<double(glm::ivec3)>& value) {
    std::vector<std::byte> bytes(sizeof(T) * static_cast<std::size_t>(size.x) * size.y * size.z);
    std::size_t at = 0;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i, at += sizeof(T)) {
                const T stored = storedAs<T>(value({i, j, k}));
                std::memcpy(bytes.data() + at, &stored, sizeof(T));
            }
        }
    }
    return bytes;
}

std::vector<std::byte> voxelsOf(VoxelType type, glm::ivec3 size,
                                const std::function<double(glm::ivec3)>& value) {
    switch (type) {
        case VoxelType::Int8:
            return voxelsOf<std::int8_t>(size, value);
        case VoxelType::UInt8:
            return voxelsOf<std::uint8_t>(size, value);
        case VoxelType::Int16:
            return voxelsOf<std::int16_t>(size, value);
        case VoxelType::UInt16:
            return voxelsOf<std::uint16_t>(size, value);
        case VoxelType::Int32:
            return voxelsOf<std::int32_t>(size, value);
        case VoxelType::UInt32:
            return voxelsOf<std::uint32_t>(size, value);
        case VoxelType::Float32:
            return voxelsOf<float>(size, value);
        case VoxelType::Float64:
            break;
    }
    return voxelsOf<double>(size, value);
}

double smoothStep(double edge, double width, double x) {
    return 1.0 / (1.0 + std::exp((x - edge) / width));
}

}  // namespace

VolumePtr sampledVolume(const Grid& grid, VoxelType type, const std::function<double(glm::ivec3)>& value,
                        ValueMapping mapping) {
    auto volume = Volume::make(grid, type, 1, voxelsOf(type, grid.size, value), std::move(mapping));
    if (!volume) contractBroken(__FILE__, __LINE__, volume.error().text());
    return *volume;
}

VolumePtr marschnerLobb(int n) {
    constexpr double kFrequency = 6.0;
    constexpr double kAlpha = 0.25;
    constexpr double kSteps = 65535.0;
    constexpr double kPi = std::numbers::pi;
    const auto value = [n](glm::ivec3 index) {
        const glm::dvec3 p = 2.0 * glm::dvec3(index) / (n - 1.0) - 1.0;
        const double r = std::hypot(p.x, p.y);
        const double radial = std::cos(2.0 * kPi * kFrequency * std::cos(kPi * r / 2.0));
        return kSteps * (1.0 - std::sin(kPi * p.z / 2.0) + kAlpha * (1.0 + radial)) / (2.0 * (1.0 + kAlpha));
    };
    return sampledVolume(axisAlignedGrid({n, n, n}, glm::dvec3(100.0 / (n - 1.0))), VoxelType::UInt16, value,
                         {1.0 / kSteps, 0.0, ""});
}

namespace {

/// `edge`: width of the shells' edges, of the unit ball.
VolumePtr shells(const Grid& grid, double edge) {
    struct Shell {
        double radius;  ///< Outer, of the unit ball.
        double hu;
    };
    constexpr std::array<Shell, 5> kShells{
        {{0.92, 40.0}, {0.88, -90.0}, {0.78, 55.0}, {0.55, 1100.0}, {0.45, 250.0}}};
    const auto value = [&](glm::ivec3 index) {
        const glm::dvec3 p = (2.0 * glm::dvec3(index) + 1.0) / glm::dvec3(grid.size) - 1.0;
        const double r = glm::length(p * glm::dvec3(1.0, 1.15, 1.05));
        double hu = -1000.0;
        double outside = -1000.0;
        for (const Shell& shell : kShells) {
            hu += (shell.hu - outside) * smoothStep(shell.radius, edge, r);
            outside = shell.hu;
        }
        return hu + 8.0 * std::sin(37.0 * p.x) * std::sin(41.0 * p.y) * std::sin(43.0 * p.z);
    };
    return sampledVolume(grid, VoxelType::Int16, value, {1.0, 0.0, "HU"});
}

}  // namespace

VolumePtr ctLikeShells(int n) {
    return shells(axisAlignedGrid({n, n, n}, glm::dvec3(200.0 / n)), 1.0 / n);
}

VolumePtr ctLikeShells(glm::ivec3 size) {
    return shells(axisAlignedGrid(size, {384.0 / size.x, 384.0 / size.y, 1.25}),
                  2.0 / std::max(size.x, size.z));
}

VolumePtr randomVolume(const Grid& grid, std::uint64_t seed) {
    // SplitMix64 (Steele, Lea, Flood 2014): the standard's distributions differ between libraries.
    std::uint64_t state = seed;
    const auto value = [&](glm::ivec3) {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<double>((z ^ (z >> 31)) >> 40) / 16777215.0;
    };
    return sampledVolume(grid, VoxelType::Float32, value);
}

}  // namespace pellucid::accuracy
