// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/formats.h"
#include "io/nrrd_header.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHeader = 1 << 20;

/// Section 5, "type".
constexpr std::array<std::pair<std::string_view, StoredType>, 38> kTypes{
    {{"signed char", StoredType::Int8},
     {"int8", StoredType::Int8},
     {"int8_t", StoredType::Int8},
     {"uchar", StoredType::UInt8},
     {"unsigned char", StoredType::UInt8},
     {"uint8", StoredType::UInt8},
     {"uint8_t", StoredType::UInt8},
     {"short", StoredType::Int16},
     {"short int", StoredType::Int16},
     {"signed short", StoredType::Int16},
     {"signed short int", StoredType::Int16},
     {"int16", StoredType::Int16},
     {"int16_t", StoredType::Int16},
     {"ushort", StoredType::UInt16},
     {"unsigned short", StoredType::UInt16},
     {"unsigned short int", StoredType::UInt16},
     {"uint16", StoredType::UInt16},
     {"uint16_t", StoredType::UInt16},
     {"int", StoredType::Int32},
     {"signed int", StoredType::Int32},
     {"int32", StoredType::Int32},
     {"int32_t", StoredType::Int32},
     {"uint", StoredType::UInt32},
     {"unsigned int", StoredType::UInt32},
     {"uint32", StoredType::UInt32},
     {"uint32_t", StoredType::UInt32},
     {"longlong", StoredType::Int64},
     {"long long", StoredType::Int64},
     {"long long int", StoredType::Int64},
     {"int64", StoredType::Int64},
     {"int64_t", StoredType::Int64},
     {"ulonglong", StoredType::UInt64},
     {"unsigned long long", StoredType::UInt64},
     {"unsigned long long int", StoredType::UInt64},
     {"uint64", StoredType::UInt64},
     {"uint64_t", StoredType::UInt64},
     {"float", StoredType::Float32},
     {"double", StoredType::Float64}}};

Result<StoredType> typeOf(const NrrdHeader& header) {
    const std::string wanted = lowered(header.field("type"));
    const auto* row =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& r) { return r.first == wanted; });
    if (row != kTypes.end()) return row->second;
    if (wanted == "signed long long" || wanted == "signed long long int") return StoredType::Int64;
    return fail(
        ErrorCode::Unsupported,
        fmt::format("the voxel type is '{}'; integers and floating point numbers are read", shown(wanted)));
}

Result<bool> isBigEndian(const NrrdHeader& header, StoredType type) {
    const std::string endian = lowered(header.field("endian"));
    if (bytesPerComponent(type) == 1) return false;
    if (endian == "little" || endian == "big") return endian == "big";
    return fail(ErrorCode::Corrupt,
                fmt::format("'endian' is '{}'; little or big must be stated for {} voxels", shown(endian),
                            name(type)));
}

/// Bytes of the first `lines` lines from `start` on.
Result<std::uint64_t> skipLines(const fs::path& file, std::uint64_t start, std::int64_t lines) {
    const std::string text = firstBytes(file, kMaxHeader, false);
    std::size_t at = std::min<std::size_t>(start, text.size());
    for (std::int64_t i = 0; i < lines; ++i) {
        at = text.find('\n', at);
        if (at == std::string::npos) {
            return fail(ErrorCode::Corrupt,
                        fmt::format("'line skip' is {}; {} has only {} lines in its first megabyte", lines,
                                    shownPath(file), i));
        }
        ++at;
    }
    return at;
}

Result<std::int64_t> skipCount(const NrrdHeader& header, const std::string& field, std::int64_t least) {
    const std::string_view text = header.field(field);
    if (text.empty()) return std::int64_t{0};
    const auto number = numberFrom<std::int64_t>(text);
    if (number && *number >= least) return *number;
    return fail(ErrorCode::Corrupt,
                fmt::format("'{}' is '{}'; an integer from {} on is allowed", field, shown(text), least));
}

Result<VoxelSource> sourceOf(const fs::path& file, const NrrdHeader& header) {
    VoxelSource source{file};
    const std::string encoding = lowered(header.field("encoding"));
    source.deflated = encoding == "gzip" || encoding == "gz";
    if (encoding != "raw" && !source.deflated) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("the encoding is '{}'; raw and gzip are read", shown(encoding)));
    }
    const std::string_view dataFile = header.field("data file");
    if (dataFile.empty()) {
        if (!header.endsWithBlankLine) {
            return fail(ErrorCode::Corrupt,
                        "the header has no end (a blank line) and names no data file: the file is cut off");
        }
        source.skip = header.bytes;
    } else {
        if (dataFile.starts_with("LIST") || dataFile.find('%') != std::string_view::npos) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("'data file' is '{}': voxels in several files are not read; one file is",
                                    shown(dataFile)));
        }
        source.file = file.parent_path() / fs::path(dataFile);
    }
    const auto lines = skipCount(header, "line skip", 0);
    if (!lines) return tl::unexpected(lines.error());
    const auto bytes = skipCount(header, "byte skip", -1);
    if (!bytes) return tl::unexpected(bytes.error());
    if (*lines > 0) {
        const auto skip = skipLines(source.file, source.skip, *lines);
        if (!skip) return tl::unexpected(skip.error());
        source.skip = *skip;
    }
    if (*bytes == -1) {
        if (source.deflated)
            return fail(ErrorCode::Corrupt, "'byte skip' is -1, which is allowed for raw encoding only");
        source.countsFromEnd = true;
    } else {
        // For gzip the skipped bytes are those of the decompressed stream (section 5, "byte skip").
        source.skipDecoded = static_cast<std::uint64_t>(*bytes);
    }
    return source;
}

}  // namespace

Result<VolumePtr> loadNrrd(const fs::path& file, const LoadOptions& options) {
    const auto header = parseNrrdHeader(firstBytes(file, kMaxHeader, false));
    if (!header) return tl::unexpected(header.error());
    const auto type = typeOf(*header);
    if (!type) return tl::unexpected(type.error());
    const auto bigEndian = isBigEndian(*header, *type);
    if (!bigEndian) return tl::unexpected(bigEndian.error());
    const auto axes = nrrdAxes(*header);
    if (!axes) return tl::unexpected(axes.error());
    VolumeParts parts;
    parts.type = *type;
    parts.components = axes->components;
    parts.bigEndian = *bigEndian;
    const auto grid = nrrdGrid(*header, *axes, parts.info.warnings);
    if (!grid) return tl::unexpected(grid.error());
    parts.grid = *grid;
    if (!header->field("old min").empty() || !header->field("old max").empty()) {
        parts.info.warnings.push_back({fmt::format(
            "the voxels were quantised from {} .. {} ('old min', 'old max'); shown as they are stored",
            shown(header->field("old min")), shown(header->field("old max")))});
    }
    const auto source = sourceOf(file, *header);
    if (!source) return tl::unexpected(source.error());
    const auto wanted = voxelBytes(grid->size, axes->components, *type, options.maxVoxelBytes);
    if (!wanted) return tl::unexpected(wanted.error());
    auto voxels =
        readVoxels(*source, *wanted, arithmetic(grid->size, axes->components, *type), options.progress);
    if (!voxels) return tl::unexpected(voxels.error());
    if (voxels->surplus > 0) {
        parts.info.warnings.push_back(
            {fmt::format("{} bytes after the voxels are not used", voxels->surplus)});
    }
    parts.voxels = std::move(voxels->bytes);
    if (axes->componentAxis > 0)
        parts.voxels = interleaved(parts.voxels, axes->components, bytesPerComponent(*type));
    parts.mapping.unit = header->field("sample units");
    parts.format = fmt::format("NRRD {}, {}", header->version,
                               header->field("data file").empty() ? "attached" : "detached");
    parts.encoding = fmt::format("{}{}", source->deflated ? "gzip" : "raw", *bigEndian ? ", big endian" : "");
    parts.info.name = file.filename().string();
    return assemble(std::move(parts));
}

}  // namespace pellucid::io
