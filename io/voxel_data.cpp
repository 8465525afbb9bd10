// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/voxel_data.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <span>

#include "io/byte_order.h"
#include "io/text_scan.h"
#include "scene/utf8.h"

namespace pellucid::io {
namespace {

struct TypeRow {
    StoredType type;
    const char* name;
    std::size_t bytes;
};

constexpr std::array<TypeRow, 10> kTypes{{{StoredType::Int8, "int8", 1},
                                          {StoredType::UInt8, "uint8", 1},
                                          {StoredType::Int16, "int16", 2},
                                          {StoredType::UInt16, "uint16", 2},
                                          {StoredType::Int32, "int32", 4},
                                          {StoredType::UInt32, "uint32", 4},
                                          {StoredType::Int64, "int64", 8},
                                          {StoredType::UInt64, "uint64", 8},
                                          {StoredType::Float32, "float32", 4},
                                          {StoredType::Float64, "float64", 8}}};

std::string orientation(const Grid& grid) {
    const auto letters = [&](int axis) {
        return orientationLetters(glm::dvec3(grid.patientFromIndex[axis]));
    };
    return fmt::format("i to {}, j to {}, k to {}{}", letters(0), letters(1), letters(2),
                       isSheared(grid) ? " (sheared)" : "");
}

void addFacts(VolumeParts& parts) {
    const glm::dvec3 spacing = spacingMm(parts.grid);
    const glm::ivec3 size = parts.grid.size;
    auto& facts = parts.info.facts;
    facts.emplace_back("format", parts.format);
    facts.emplace_back("encoding", parts.encoding);
    facts.emplace_back("size", fmt::format("{} x {} x {}", size.x, size.y, size.z));
    facts.emplace_back("spacing",
                       fmt::format("{:.6g} x {:.6g} x {:.6g} mm", spacing.x, spacing.y, spacing.z));
    facts.emplace_back("type", parts.components == 1
                                   ? std::string(name(parts.type))
                                   : fmt::format("{} components of {}", parts.components, name(parts.type)));
    facts.emplace_back("orientation", orientation(parts.grid));
}

template <class Wide>
NarrowedIntegers narrowed(const std::vector<std::byte>& bytes) {
    std::vector<Wide> values(bytes.size() / sizeof(Wide));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Wide));
    return narrowIntegers(std::span<const Wide>(values));
}

VoxelType narrow(VolumeParts& parts) {
    NarrowedIntegers result = parts.type == StoredType::Int64 ? narrowed<std::int64_t>(parts.voxels)
                                                              : narrowed<std::uint64_t>(parts.voxels);
    parts.voxels = std::move(result.voxels);
    parts.info.warnings.push_back(
        {fmt::format("{} voxels are kept as {}; the worst error is {} stored units", name(parts.type),
                     pellucid::name(result.type), result.worstError)});
    return result.type;
}

}  // namespace

std::size_t bytesPerComponent(StoredType type) {
    return kTypes[static_cast<std::size_t>(type)].bytes;
}

const char* name(StoredType type) {
    return kTypes[static_cast<std::size_t>(type)].name;
}

std::optional<StoredType> storedTypeFromName(std::string_view wanted) {
    for (const TypeRow& row : kTypes) {
        if (wanted == row.name) return row.type;
    }
    return std::nullopt;
}

std::string arithmetic(glm::ivec3 size, int components, StoredType type) {
    return fmt::format("{}x{}x{} voxels x {} component{} x {} byte{} ({})", size.x, size.y, size.z,
                       components, components == 1 ? "" : "s", bytesPerComponent(type),
                       bytesPerComponent(type) == 1 ? "" : "s", name(type));
}

Result<std::uint64_t> voxelBytes(glm::ivec3 size, int components, StoredType type, std::uint64_t maxBytes) {
    if (size.x < 1 || size.y < 1 || size.z < 1 || components < 1) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("the size is {}x{}x{}; each must be at least 1", size.x, size.y, size.z));
    }
    std::uint64_t bytes = static_cast<std::uint64_t>(components) * bytesPerComponent(type);
    for (int axis = 0; axis < 3; ++axis) {
        if (__builtin_mul_overflow(bytes, static_cast<std::uint64_t>(size[axis]), &bytes) ||
            bytes > maxBytes) {
            return fail(ErrorCode::TooLarge,
                        fmt::format("{} are more than the {} bytes that are read at most",
                                    arithmetic(size, components, type), maxBytes));
        }
    }
    return bytes;
}

std::vector<std::byte> interleaved(std::span<const std::byte> planar, int components, std::size_t width) {
    std::vector<std::byte> result(planar.size());
    const std::size_t n = static_cast<std::size_t>(components);
    const std::size_t voxels = planar.size() / (n * width);
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t v = 0; v < voxels; ++v) {
            std::memcpy(result.data() + (v * n + c) * width, planar.data() + (c * voxels + v) * width, width);
        }
    }
    return result;
}

Result<VolumePtr> assemble(VolumeParts parts) {
    if (parts.components < 1 || parts.components > 4) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} components a voxel; 1 to 4 are drawn", parts.components));
    }
    if (const auto valid = validate(parts.grid); !valid) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("the placement in space is impossible: {}", valid.error().message));
    }
    if (!isUtf8(parts.mapping.unit)) parts.mapping.unit = shown(parts.mapping.unit);
    if (!isUtf8(parts.info.name)) parts.info.name = shown(parts.info.name, 255);
    if (parts.bigEndian != kNativeIsBig) swapBytes(parts.voxels, bytesPerComponent(parts.type));
    addFacts(parts);
    const bool wide = parts.type == StoredType::Int64 || parts.type == StoredType::UInt64;
    const VoxelType type = wide ? narrow(parts) : voxelTypeFromName(name(parts.type)).value();
    auto volume = Volume::make(parts.grid, type, parts.components, std::move(parts.voxels),
                               std::move(parts.mapping), std::move(parts.info));
    if (!volume) {
        // Whatever Volume refuses was stated by the file.
        Error error = volume.error();
        error.code = ErrorCode::Corrupt;
        return tl::unexpected(std::move(error));
    }
    return *volume;
}

}  // namespace pellucid::io
