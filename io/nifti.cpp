// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "io/formats.h"
#include "io/nifti_header.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// nifti1.h, DT_ codes. RGB24 and RGBA32 keep the components of a voxel together.
struct NiftiType {
    int code;
    StoredType type;
    int components;
};
constexpr std::array<NiftiType, 12> kTypes{{{2, StoredType::UInt8, 1},
                                            {4, StoredType::Int16, 1},
                                            {8, StoredType::Int32, 1},
                                            {16, StoredType::Float32, 1},
                                            {64, StoredType::Float64, 1},
                                            {128, StoredType::UInt8, 3},
                                            {256, StoredType::Int8, 1},
                                            {512, StoredType::UInt16, 1},
                                            {768, StoredType::UInt32, 1},
                                            {1024, StoredType::Int64, 1},
                                            {1280, StoredType::UInt64, 1},
                                            {2304, StoredType::UInt8, 4}}};

Result<NiftiType> typeOf(const NiftiHeader& header) {
    const auto* row = std::find_if(kTypes.begin(), kTypes.end(),
                                   [&](const NiftiType& t) { return t.code == header.datatype; });
    if (row == kTypes.end()) {
        const bool complex = header.datatype == 32 || header.datatype == 1792 || header.datatype == 2048;
        return fail(
            ErrorCode::Unsupported,
            complex ? fmt::format("complex numbers (datatype {}) are not drawn; save their magnitude",
                                  header.datatype)
                    : fmt::format("datatype {} is not read; integers, float32, float64, RGB24 and RGBA32 are",
                                  header.datatype));
    }
    const auto bits = static_cast<int>(bytesPerComponent(row->type) * 8) * row->components;
    if (header.bitpix != bits) {
        return fail(ErrorCode::Corrupt, fmt::format("bitpix is {}, but datatype {} has {} bits",
                                                    header.bitpix, header.datatype, bits));
    }
    return *row;
}

/// Components in planes one after the other: dim[5], or dim[4] where the intent says that it holds a vector.
Result<int> planarComponents(const NiftiHeader& header) {
    constexpr std::array<int, 5> kVectorIntents{1006, 1007, 2003, 2004,
                                                1008};  // DISPVECT, VECTOR, RGB, RGBA, POINTSET
    const bool vector =
        std::find(kVectorIntents.begin(), kVectorIntents.end(), header.intent) != kVectorIntents.end();
    const auto& dim = header.dim;
    if (dim[6] > 1 || dim[7] > 1 || (dim[4] > 1 && dim[5] > 1)) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}D (dim {}x{}x{}x{}x{}x{}x{}): not yet; 3D is read", header.dim[0], dim[1],
                                dim[2], dim[3], dim[4], dim[5], dim[6], dim[7]));
    }
    if (dim[4] > 1 && !vector) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("4D, {} time steps of {}x{}x{}: not yet; save one of them as a volume",
                                dim[4], dim[1], dim[2], dim[3]));
    }
    const std::int64_t components = std::max(dim[4], dim[5]);
    if (components > 4)
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} components a voxel; 1 to 4 are drawn", components));
    return static_cast<int>(components);
}

/// The .img or .img.gz beside a .hdr or .hdr.gz.
Result<fs::path> imageOf(const fs::path& header) {
    fs::path base = header;
    if (lowered(base.extension().string()) == ".gz") base.replace_extension();
    base.replace_extension();
    for (const char* ending : {".img", ".img.gz", ".IMG"}) {
        fs::path candidate = base;
        candidate += ending;
        std::error_code error;
        if (fs::is_regular_file(candidate, error)) return candidate;
    }
    return fail(ErrorCode::NotFound, fmt::format("the voxels, {}.img or {}.img.gz, are not there",
                                                 shownPath(base), shownPath(base.filename())));
}

ValueMapping mappingOf(const NiftiHeader& header, std::vector<Warning>& warnings) {
    ValueMapping mapping;
    // nifti1.h: a slope of 0 means no scaling, and RGB is never scaled.
    if (!std::isfinite(header.slope) || header.slope == 0.0 || header.datatype == 128 ||
        header.datatype == 2304)
        return mapping;
    mapping.slope = header.slope;
    if (std::isfinite(header.inter)) {
        mapping.intercept = header.inter;
    } else {
        warnings.push_back({"scl_inter is not a number; taken as 0"});
    }
    return mapping;
}

Result<VoxelSource> sourceOf(const fs::path& file, const NiftiHeader& header) {
    VoxelSource source{file};
    if (header.pair) {
        const auto image = imageOf(file);
        if (!image) return tl::unexpected(image.error());
        source.file = *image;
    }
    source.deflated = isGzip(firstBytes(source.file, 2, false));
    const std::int64_t least = header.pair ? 0 : (header.version == 1 ? 348 : 540);
    if (header.voxOffset < least) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("vox_offset is {}; at least {} is needed", header.voxOffset, least));
    }
    source.skipDecoded = static_cast<std::uint64_t>(header.voxOffset);
    return source;
}

}  // namespace

bool looksLikeNifti(std::string_view start) {
    constexpr std::string_view kSizes[] = {
        std::string_view("\x5c\x01\0\0", 4), std::string_view("\0\0\x01\x5c", 4),
        std::string_view("\x1c\x02\0\0", 4), std::string_view("\0\0\x02\x1c", 4)};
    return std::any_of(std::begin(kSizes), std::end(kSizes),
                       [&](std::string_view size) { return start.starts_with(size); });
}

Result<VolumePtr> loadNifti(const fs::path& file, const LoadOptions& options) {
    const auto header = parseNiftiHeader(firstBytes(file, 544, true));
    if (!header) return tl::unexpected(header.error());
    const auto type = typeOf(*header);
    if (!type) return tl::unexpected(type.error());
    const auto planes = planarComponents(*header);
    if (!planes) return tl::unexpected(planes.error());
    if (*planes > 1 && type->components > 1)
        return fail(ErrorCode::Unsupported, "a vector of colours a voxel; 1 to 4 numbers are drawn");
    VolumeParts parts;
    parts.type = type->type;
    parts.components = type->components * *planes;
    parts.bigEndian = header->bigEndian;
    parts.grid = niftiGrid(*header, parts.info.warnings);
    const auto source = sourceOf(file, *header);
    if (!source) return tl::unexpected(source.error());
    const auto wanted = voxelBytes(parts.grid.size, parts.components, parts.type, options.maxVoxelBytes);
    if (!wanted) return tl::unexpected(wanted.error());
    auto voxels = readVoxels(*source, *wanted, arithmetic(parts.grid.size, parts.components, parts.type),
                             options.progress);
    if (!voxels) return tl::unexpected(voxels.error());
    if (voxels->surplus > 0)
        parts.info.warnings.push_back(
            {fmt::format("{} bytes after the voxels are not used", voxels->surplus)});
    parts.voxels = std::move(voxels->bytes);
    if (*planes > 1) parts.voxels = interleaved(parts.voxels, *planes, bytesPerComponent(parts.type));
    parts.mapping = mappingOf(*header, parts.info.warnings);
    if (std::isfinite(header->calMin) && std::isfinite(header->calMax) && header->calMax > header->calMin) {
        parts.info.windows.push_back(
            {"file", {0.5 * (header->calMin + header->calMax), header->calMax - header->calMin}});
    }
    parts.info.name = file.filename().string();
    parts.format = fmt::format("NIfTI-{}{}", header->version, header->pair ? ", header and image" : "");
    parts.encoding =
        fmt::format("{}{}", source->deflated ? "gzip" : "raw", header->bigEndian ? ", big endian" : "");
    return assemble(std::move(parts));
}

}  // namespace pellucid::io
