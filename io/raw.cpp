// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "io/formats.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view kTypeNames =
    "int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64";
constexpr std::array<std::string_view, 9> kMembers{
    "size", "type", "components", "endianness", "spacingMm", "headerBytes", "slope", "intercept", "unit"};

tl::unexpected<Error> notAllowed(std::string_view member, const json& found, std::string_view allowed) {
    return fail(ErrorCode::InvalidArgument,
                fmt::format("/{}: found {}, allowed is {}", member,
                            shown(found.dump(-1, ' ', true, json::error_handler_t::replace)), allowed));
}

Result<void> readSize(const json& value, glm::ivec3& size) {
    const bool valid =
        value.is_array() && value.size() == 3 && std::all_of(value.begin(), value.end(), [](const json& n) {
            return n.is_number_integer() && n >= 1 && n <= INT32_MAX;
        });
    if (!valid) return notAllowed("size", value, "three positive integers");
    for (int axis = 0; axis < 3; ++axis) size[axis] = value[static_cast<std::size_t>(axis)].get<int>();
    return {};
}

Result<void> readSpacing(const json& value, glm::dvec3& spacing) {
    const bool valid =
        value.is_array() && value.size() == 3 &&
        std::all_of(value.begin(), value.end(), [](const json& n) { return n.is_number() && n > 0; });
    if (!valid) return notAllowed("spacingMm", value, "three positive numbers in mm");
    for (int axis = 0; axis < 3; ++axis) spacing[axis] = value[static_cast<std::size_t>(axis)].get<double>();
    return {};
}

Result<void> readMember(const std::string& key, const json& value, RawLayout& layout) {
    if (key == "size") return readSize(value, layout.size);
    if (key == "spacingMm") return readSpacing(value, layout.spacingMm);
    if (key == "type") {
        if (!value.is_string() || !storedTypeFromName(value.get_ref<const std::string&>()))
            return notAllowed(key, value, kTypeNames);
        layout.type = value.get<std::string>();
    } else if (key == "components") {
        if (!value.is_number_integer() || value < 1 || value > 4)
            return notAllowed(key, value, "an integer from 1 to 4");
        layout.components = value.get<int>();
    } else if (key == "endianness") {
        if (value != "little" && value != "big") return notAllowed(key, value, "\"little\" or \"big\"");
        layout.bigEndian = value == "big";
    } else if (key == "headerBytes") {
        if (!value.is_number_integer() || value < 0 || value > INT64_MAX)
            return notAllowed(key, value, "an integer from 0 on");
        layout.headerBytes = value.get<std::uint64_t>();
    } else if (key == "slope") {
        if (!value.is_number() || value == 0) return notAllowed(key, value, "a number other than 0");
        layout.slope = value.get<double>();
    } else if (key == "intercept") {
        if (!value.is_number()) return notAllowed(key, value, "a number");
        layout.intercept = value.get<double>();
    } else if (key == "unit") {
        if (!value.is_string()) return notAllowed(key, value, "a text");
        layout.unit = value.get<std::string>();
    } else {
        return fail(ErrorCode::InvalidArgument, fmt::format("/{}: not a known member; allowed are {}",
                                                            shown(key), fmt::join(kMembers, ", ")));
    }
    return {};
}

/// For layouts made in code. Errors: InvalidArgument.
Result<StoredType> checkLayout(const RawLayout& layout) {
    const auto type = storedTypeFromName(layout.type);
    if (!type)
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("the voxel type is '{}'; allowed are {}", shown(layout.type), kTypeNames));
    if (layout.size.x < 1 || layout.size.y < 1 || layout.size.z < 1) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("the size is {}x{}x{}; three positive integers are needed", layout.size.x,
                                layout.size.y, layout.size.z));
    }
    if (layout.components < 1 || layout.components > 4) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{} components a voxel; 1 to 4 are allowed", layout.components));
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (!(layout.spacingMm[axis] > 0.0) || !std::isfinite(layout.spacingMm[axis])) {
            return fail(ErrorCode::InvalidArgument,
                        fmt::format("spacing {} mm along axis {}; it must be positive",
                                    layout.spacingMm[axis], axis));
        }
    }
    if (layout.slope == 0.0 || !std::isfinite(layout.slope) || !std::isfinite(layout.intercept)) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("slope {} and intercept {}; both must be finite, the slope not 0",
                                layout.slope, layout.intercept));
    }
    return *type;
}

tl::unexpected<Error> wrongSize(const RawLayout& layout, StoredType type, std::uint64_t voxels,
                                std::uint64_t found, bool deflated) {
    return fail(ErrorCode::Corrupt,
                fmt::format("expected {} header bytes + {} = {} bytes{}, found {}", layout.headerBytes,
                            arithmetic(layout.size, layout.components, type), layout.headerBytes + voxels,
                            deflated ? " after decompression" : "", found));
}

}  // namespace

std::optional<fs::path> rawSidecar(const fs::path& file) {
    fs::path appended = file;
    appended += ".json";
    fs::path replaced = file;
    replaced.replace_extension(".json");
    std::error_code error;
    for (const fs::path& candidate : {appended, replaced}) {
        if (candidate != file && fs::is_regular_file(candidate, error)) return candidate;
    }
    return std::nullopt;
}

Result<RawLayout> readRawSidecar(const fs::path& sidecar) {
    const auto bytes = readFile(sidecar, 1 << 20);
    if (!bytes) return tl::unexpected(bytes.error());
    json value;
    try {
        const char* text = reinterpret_cast<const char*>(bytes->data());
        value = json::parse(text, text + bytes->size());
    } catch (const json::exception& error) {
        return fail(ErrorCode::Corrupt, fmt::format("not JSON: {}", shown(error.what(), 300)));
    }
    if (!value.is_object())
        return fail(ErrorCode::InvalidArgument,
                    "found no object; allowed is {\"size\": [x, y, z], \"type\": \"uint8\", ...}");
    RawLayout layout;
    for (const auto& [key, member] : value.items()) {
        if (const auto read = readMember(key, member, layout); !read) return tl::unexpected(read.error());
    }
    for (const char* needed : {"size", "type"}) {
        if (!value.contains(needed))
            return fail(ErrorCode::InvalidArgument, fmt::format("/{}: missing; it must be given", needed));
    }
    return layout;
}

Result<VolumePtr> loadRaw(const fs::path& file, const RawLayout& layout, const LoadOptions& options) {
    const auto type = checkLayout(layout);
    if (!type) return tl::unexpected(type.error());
    const auto wanted = voxelBytes(layout.size, layout.components, *type, options.maxVoxelBytes);
    if (!wanted) return tl::unexpected(wanted.error());
    const auto fileSize = regularFileSize(file);
    if (!fileSize) return tl::unexpected(fileSize.error());
    if (layout.headerBytes > INT64_MAX - *wanted) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("{} header bytes are more than a file can have", layout.headerBytes));
    }
    VoxelSource source{file};
    // Raw voxels may begin with gzip's two bytes by chance; the name has to say it too.
    source.deflated = lowered(file.extension().string()) == ".gz" && isGzip(firstBytes(file, 2, false));
    source.skipDecoded = layout.headerBytes;
    if (!source.deflated && *fileSize != layout.headerBytes + *wanted)
        return wrongSize(layout, *type, *wanted, *fileSize, false);
    auto voxels =
        readVoxels(source, *wanted, arithmetic(layout.size, layout.components, *type), options.progress);
    if (!voxels) return tl::unexpected(voxels.error());
    if (voxels->surplus > 0)
        return wrongSize(layout, *type, *wanted, layout.headerBytes + *wanted + voxels->surplus, true);
    VolumeParts parts;
    parts.format = "raw voxels";
    parts.encoding =
        fmt::format("{}{}", source.deflated ? "gzip" : "raw", layout.bigEndian ? ", big endian" : "");
    parts.grid = axisAlignedGrid(layout.size, layout.spacingMm);
    parts.type = *type;
    parts.components = layout.components;
    parts.bigEndian = layout.bigEndian;
    parts.voxels = std::move(voxels->bytes);
    parts.mapping = {layout.slope, layout.intercept, layout.unit};
    parts.info.name = file.filename().string();
    parts.info.warnings.push_back(
        {"raw voxels state no orientation; the axes are taken as left, posterior and superior"});
    return assemble(std::move(parts));
}

}  // namespace pellucid::io
