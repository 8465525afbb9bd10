// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <type_traits>

#include "scene/parallel.h"

namespace pellucid {

namespace {

struct TypeFact {
    const char* name;
    std::size_t bytes;
};

/// In the order of VoxelType.
constexpr std::array<TypeFact, 8> kTypeFacts{{{"int8", 1},
                                              {"uint8", 1},
                                              {"int16", 2},
                                              {"uint16", 2},
                                              {"int32", 4},
                                              {"uint32", 4},
                                              {"float32", 4},
                                              {"float64", 8}}};

struct ComponentRanges {
    std::array<ValueRange, 4> range;
    std::uint64_t nonFinite = 0;
};

constexpr ValueRange kEmptyRange{std::numeric_limits<double>::infinity(),
                                 -std::numeric_limits<double>::infinity()};

template <class T>
ComponentRanges rangesOf(std::span<const T> voxels, int components) {
    ComponentRanges result;
    std::array<T, 4> lo{}, hi{};
    lo.fill(std::is_floating_point_v<T> ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::max());
    hi.fill(std::is_floating_point_v<T> ? -std::numeric_limits<T>::infinity()
                                        : std::numeric_limits<T>::lowest());
    std::array<bool, 4> any{};
    const auto step = static_cast<std::size_t>(components);
    for (std::size_t component = 0; component < step; ++component) {
        for (std::size_t i = component; i < voxels.size(); i += step) {
            const T value = voxels[i];
            if constexpr (std::is_floating_point_v<T>) {
                if (!std::isfinite(value)) {
                    ++result.nonFinite;
                    continue;
                }
            }
            any[component] = true;
            lo[component] = std::min(lo[component], value);
            hi[component] = std::max(hi[component], value);
        }
    }
    for (std::size_t component = 0; component < step; ++component) {
        result.range[component] = any[component] ? ValueRange{static_cast<double>(lo[component]),
                                                              static_cast<double>(hi[component])}
                                                 : kEmptyRange;
    }
    return result;
}

ComponentRanges parallelRanges(const Volume& volume) {
    ComponentRanges total;
    total.range.fill(kEmptyRange);
    std::mutex mutex;
    visitVoxels(volume, [&]<class T>(std::span<const T> voxels) {
        const auto components = static_cast<std::uint64_t>(volume.components());
        constexpr std::uint64_t kChunkVoxels = 1u << 20;
        forEachChunk(volume.voxelCount(), kChunkVoxels, [&](std::uint64_t begin, std::uint64_t end) {
            const ComponentRanges part =
                rangesOf(voxels.subspan(begin * components, (end - begin) * components), volume.components());
            const std::lock_guard lock(mutex);
            total.nonFinite += part.nonFinite;
            for (std::size_t i = 0; i < components; ++i) {
                total.range[i].lo = std::min(total.range[i].lo, part.range[i].lo);
                total.range[i].hi = std::max(total.range[i].hi, part.range[i].hi);
            }
        });
    });
    return total;
}

/// Bytes the voxels of a grid must have. Errors: TooLarge when the number does not fit into 64 bits.
Result<std::uint64_t> expectedBytes(const Grid& grid, VoxelType type, int components) {
    const Result<std::uint64_t> voxels = checkedVoxelCount(grid.size);
    if (!voxels) return tl::unexpected(voxels.error());
    std::uint64_t bytes = 0;
    if (__builtin_mul_overflow(*voxels, bytesPerComponent(type) * static_cast<std::uint64_t>(components),
                               &bytes))
        return fail(ErrorCode::TooLarge, fmt::format("{} voxels of {} x {} need more than 2^64 bytes",
                                                     *voxels, components, name(type)));
    return bytes;
}

Result<void> validateMapping(const ValueMapping& mapping) {
    if (!std::isfinite(mapping.slope) || mapping.slope == 0.0)
        return fail(
            ErrorCode::InvalidArgument,
            fmt::format("the slope of the value mapping is {}, allowed is a finite number other than 0",
                        mapping.slope));
    if (!std::isfinite(mapping.intercept))
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("the intercept of the value mapping is {}, allowed is a finite number",
                                mapping.intercept));
    return {};
}

template <class From>
std::uint64_t roundingErrorOf(From value) {
    // Rounding to double is symmetric, so magnitudes suffice; 2^64 itself does not fit back into 64 bits.
    const std::uint64_t magnitude =
        value < 0 ? std::uint64_t{0} - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    const double rounded = static_cast<double>(magnitude);
    if (rounded >= 18446744073709551616.0) return std::uint64_t{0} - magnitude;
    const auto back = static_cast<std::uint64_t>(rounded);
    return back > magnitude ? back - magnitude : magnitude - back;
}

template <class To, class From>
void convertInto(std::span<const From> values, std::vector<std::byte>& bytes) {
    bytes.resize(values.size() * sizeof(To));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const To value = static_cast<To>(values[i]);
        std::memcpy(bytes.data() + i * sizeof(To), &value, sizeof(To));
    }
}

template <class From>
NarrowedIntegers narrow(std::span<const From> values) {
    NarrowedIntegers result;
    From lo = 0, hi = 0;  // Both ranges below hold 0, so starting there changes no decision.
    for (const From value : values) {
        lo = std::min(lo, value);
        hi = std::max(hi, value);
    }
    if (std::in_range<std::int32_t>(lo) && std::in_range<std::int32_t>(hi)) {
        convertInto<std::int32_t>(values, result.voxels);
    } else if (std::in_range<std::uint32_t>(lo) && std::in_range<std::uint32_t>(hi)) {
        result.type = VoxelType::UInt32;
        convertInto<std::uint32_t>(values, result.voxels);
    } else {
        result.type = VoxelType::Float64;
        convertInto<double>(values, result.voxels);
        std::uint64_t worst = 0;
        for (const From value : values) worst = std::max(worst, roundingErrorOf(value));
        result.worstError = static_cast<double>(worst);
    }
    return result;
}

}  // namespace

std::size_t bytesPerComponent(VoxelType type) {
    return kTypeFacts[static_cast<std::size_t>(type)].bytes;
}

const char* name(VoxelType type) {
    return kTypeFacts[static_cast<std::size_t>(type)].name;
}

std::optional<VoxelType> voxelTypeFromName(std::string_view name) {
    for (std::size_t i = 0; i < kTypeFacts.size(); ++i)
        if (name == kTypeFacts[i].name) return static_cast<VoxelType>(i);
    return std::nullopt;
}

Result<std::shared_ptr<const Volume>> Volume::make(Grid grid, VoxelType type, int components,
                                                   std::vector<std::byte> voxels, ValueMapping mapping,
                                                   VolumeInfo info) {
    if (auto valid = validate(grid); !valid) return tl::unexpected(std::move(valid.error()));
    if (components < 1 || components > 4)
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{} components in a voxel, allowed are 1 to 4", components));
    if (auto valid = validateMapping(mapping); !valid) return tl::unexpected(std::move(valid.error()));
    const auto bytes = expectedBytes(grid, type, components);
    if (!bytes) return tl::unexpected(bytes.error());
    if (*bytes != voxels.size())
        return fail(ErrorCode::Corrupt, fmt::format("{} x {} x {} voxels of {} x {} need {} bytes, found {}",
                                                    grid.size.x, grid.size.y, grid.size.z, components,
                                                    pellucid::name(type), *bytes, voxels.size()));

    const std::shared_ptr<Volume> volume(new Volume);
    volume->m_grid = grid;
    volume->m_type = type;
    volume->m_components = components;
    volume->m_voxels = std::move(voxels);
    volume->m_mapping = std::move(mapping);
    volume->m_info = std::move(info);
    const ComponentRanges ranges = parallelRanges(*volume);
    volume->m_nonFinite = ranges.nonFinite;
    for (int i = 0; i < components; ++i) {
        const ValueRange range = ranges.range[static_cast<std::size_t>(i)];
        volume->m_hasValues.push_back(range.lo <= range.hi);
        volume->m_storedRange.push_back(volume->m_hasValues.back() ? range : ValueRange{0.0, 0.0});
        const ValueRange physical = volume->physicalRange(i);
        if (!std::isfinite(physical.lo) || !std::isfinite(physical.hi))
            return fail(
                ErrorCode::InvalidArgument,
                fmt::format(
                    "slope {} and intercept {} take stored values {} to {} beyond the range of numbers",
                    volume->m_mapping.slope, volume->m_mapping.intercept, range.lo, range.hi));
    }
    return volume;
}

ValueRange Volume::physicalRange(int component) const {
    const ValueRange range = storedRange(component);
    const double a = m_mapping.physical(range.lo);
    const double b = m_mapping.physical(range.hi);
    return {std::min(a, b), std::max(a, b)};
}

double Volume::stored(glm::ivec3 index, int component) const {
    PELLUCID_CHECK(glm::all(glm::greaterThanEqual(index, glm::ivec3(0))) &&
                   glm::all(glm::lessThan(index, m_grid.size)));
    PELLUCID_CHECK(component >= 0 && component < m_components);
    const glm::u64vec3 size(m_grid.size), at(index);
    const std::uint64_t voxel = at.x + size.x * (at.y + size.y * at.z);
    const std::uint64_t offset =
        voxel * static_cast<std::uint64_t>(m_components) + static_cast<std::uint64_t>(component);
    return visitVoxels(*this, [&](auto voxels) { return static_cast<double>(voxels[offset]); });
}

NarrowedIntegers narrowIntegers(std::span<const std::int64_t> values) {
    return narrow(values);
}
NarrowedIntegers narrowIntegers(std::span<const std::uint64_t> values) {
    return narrow(values);
}

}  // namespace pellucid
