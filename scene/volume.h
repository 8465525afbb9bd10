// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/check.h"
#include "scene/grid.h"
#include "scene/result.h"

namespace pellucid {

/// How voxels are stored. 64-bit integers do not occur: they are narrowed on load (narrowIntegers), with the
/// worst error said.
enum class VoxelType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

[[nodiscard]] std::size_t bytesPerComponent(VoxelType type);
/// "int8" ... "float64".
[[nodiscard]] const char* name(VoxelType type);
[[nodiscard]] std::optional<VoxelType> voxelTypeFromName(std::string_view name);

/// physical = stored * slope + intercept, in `unit` ("HU", "SUV", "" for none).
struct ValueMapping {
    double slope = 1.0;
    double intercept = 0.0;
    std::string unit;

    [[nodiscard]] double physical(double stored) const { return stored * slope + intercept; }
    [[nodiscard]] double stored(double physicalValue) const { return (physicalValue - intercept) / slope; }
    bool operator==(const ValueMapping&) const = default;
};

/// A display window as clinicians set it: physical values from level - width / 2 (black) to level + width / 2
/// (white).
struct Window {
    double level = 0.0;
    double width = 1.0;  ///< > 0.
    bool operator==(const Window&) const = default;
};

struct NamedWindow {
    std::string name;
    Window window;
    bool operator==(const NamedWindow&) const = default;
};

/// A closed interval; empty when lo > hi.
struct ValueRange {
    double lo = 0.0;
    double hi = 0.0;
    bool operator==(const ValueRange&) const = default;
};

/// What else is known of a volume; nothing here changes how voxels are placed or valued.
struct VolumeInfo {
    std::string name;                  ///< For people: a file or series name; never patient data.
    std::string modality;              ///< DICOM modality ("CT", "MR") or empty.
    std::vector<NamedWindow> windows;  ///< Windows the file recommends, the first is the default.
    std::vector<Warning> warnings;
    std::vector<std::pair<std::string, std::string>> facts;  ///< Label and text for `pellucid info`.
};

/// Typed voxels on an oriented grid. Immutable once made and shared by pointer.
/// Layout: i fastest, then j, then k; components of one voxel lie together; native byte order.
class Volume {
public:
    /// Checks that the voxels fill the grid exactly and computes the value range.
    /// Errors: InvalidArgument (grid, components outside 1..4, slope zero or not finite), Corrupt (byte
    /// count).
    static Result<std::shared_ptr<const Volume>> make(Grid grid, VoxelType type, int components,
                                                      std::vector<std::byte> voxels,
                                                      ValueMapping mapping = {}, VolumeInfo info = {});

    [[nodiscard]] const Grid& grid() const { return m_grid; }
    [[nodiscard]] VoxelType type() const { return m_type; }
    [[nodiscard]] int components() const { return m_components; }
    [[nodiscard]] const ValueMapping& mapping() const { return m_mapping; }
    [[nodiscard]] const VolumeInfo& info() const { return m_info; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return m_voxels; }
    [[nodiscard]] std::uint64_t voxelCount() const {
        return m_voxels.size() / (bytesPerComponent(m_type) * m_components);
    }

    /// Smallest and largest finite stored value over all voxels of one component; {0, 0} when none is finite.
    [[nodiscard]] ValueRange storedRange(int component = 0) const {
        return m_storedRange[static_cast<std::size_t>(component)];
    }
    /// The same as physical values, lo <= hi also when the slope is negative.
    [[nodiscard]] ValueRange physicalRange(int component = 0) const;
    /// Voxel components that are NaN or infinite. The renderer and the reference draw them as the smallest
    /// finite stored value.
    [[nodiscard]] std::uint64_t nonFiniteCount() const { return m_nonFinite; }
    /// False when no voxel has a finite number there; the ranges are those of a 0 then.
    [[nodiscard]] bool hasValues(int component = 0) const {
        return m_hasValues[static_cast<std::size_t>(component)];
    }

    /// Stored value as it is in the file (possibly NaN). Precondition: the index lies in the grid.
    [[nodiscard]] double stored(glm::ivec3 index, int component = 0) const;
    [[nodiscard]] double physical(glm::ivec3 index, int component = 0) const {
        return m_mapping.physical(stored(index, component));
    }

private:
    Volume() = default;
    Grid m_grid;
    VoxelType m_type = VoxelType::UInt8;
    int m_components = 1;
    std::vector<std::byte> m_voxels;
    ValueMapping m_mapping;
    VolumeInfo m_info;
    std::vector<ValueRange> m_storedRange;
    std::vector<bool> m_hasValues;
    std::uint64_t m_nonFinite = 0;
};

using VolumePtr = std::shared_ptr<const Volume>;

/// Calls f with a typed span (std::span<const T>) over all components of all voxels.
template <class F>
decltype(auto) visitVoxels(const Volume& volume, F&& f) {
    const auto typed = [&]<class T>(T) {
        return std::span<const T>(reinterpret_cast<const T*>(volume.bytes().data()),
                                  volume.bytes().size() / sizeof(T));
    };
    switch (volume.type()) {
        case VoxelType::Int8:
            return f(typed(std::int8_t{}));
        case VoxelType::UInt8:
            return f(typed(std::uint8_t{}));
        case VoxelType::Int16:
            return f(typed(std::int16_t{}));
        case VoxelType::UInt16:
            return f(typed(std::uint16_t{}));
        case VoxelType::Int32:
            return f(typed(std::int32_t{}));
        case VoxelType::UInt32:
            return f(typed(std::uint32_t{}));
        case VoxelType::Float32:
            return f(typed(float{}));
        case VoxelType::Float64:
            break;
    }
    return f(typed(double{}));
}

/// Physical values of one component, i fastest; what is not finite counts as the smallest finite stored
/// value.
template <class Real>
[[nodiscard]] std::vector<Real> physicalValues(const Volume& volume, int component) {
    std::vector<Real> values(static_cast<std::size_t>(volume.voxelCount()));
    const double replacement = volume.storedRange(component).lo;
    const auto stride = static_cast<std::size_t>(volume.components());
    visitVoxels(volume, [&](auto voxels) {
        for (std::size_t n = 0; n < values.size(); ++n) {
            const auto stored = static_cast<double>(voxels[n * stride + static_cast<std::size_t>(component)]);
            values[n] =
                static_cast<Real>(volume.mapping().physical(std::isfinite(stored) ? stored : replacement));
        }
    });
    return values;
}

/// The result of narrowing 64-bit integers: int32 or uint32 when every value fits (exact), else float64 with
/// the largest rounding error in stored units.
struct NarrowedIntegers {
    VoxelType type = VoxelType::Int32;
    std::vector<std::byte> voxels;
    double worstError = 0.0;
};
[[nodiscard]] NarrowedIntegers narrowIntegers(std::span<const std::int64_t> values);
[[nodiscard]] NarrowedIntegers narrowIntegers(std::span<const std::uint64_t> values);

}  // namespace pellucid
