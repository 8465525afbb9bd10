// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// MetaImage as ITK's MetaIO writes it: text "Key = value" up to ElementDataFile. The frame is LPS in mm; the
// numbers of TransformMatrix are the direction of the first axis, then of the second, then of the third
// (itkMetaImageIO.cxx).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "io/formats.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHeader = 1 << 20;

/// metaTypes.h. MET_LONG is 4 bytes in a file on every machine (MET_ValueTypeSize), whatever a C long is.
constexpr std::array<std::pair<std::string_view, StoredType>, 12> kTypes{
    {{"MET_CHAR", StoredType::Int8},
     {"MET_UCHAR", StoredType::UInt8},
     {"MET_SHORT", StoredType::Int16},
     {"MET_USHORT", StoredType::UInt16},
     {"MET_INT", StoredType::Int32},
     {"MET_UINT", StoredType::UInt32},
     {"MET_LONG", StoredType::Int32},
     {"MET_ULONG", StoredType::UInt32},
     {"MET_LONG_LONG", StoredType::Int64},
     {"MET_ULONG_LONG", StoredType::UInt64},
     {"MET_FLOAT", StoredType::Float32},
     {"MET_DOUBLE", StoredType::Float64}}};

struct MetaHeader {
    std::map<std::string, std::string, std::less<>> fields;
    std::uint64_t bytes = 0;  ///< Up to the line after ElementDataFile.

    /// The first of the spellings that is there, else empty.
    [[nodiscard]] std::string_view field(std::initializer_list<std::string_view> spellings) const {
        for (const std::string_view spelling : spellings) {
            if (const auto it = fields.find(spelling); it != fields.end()) return it->second;
        }
        return {};
    }
    [[nodiscard]] bool isTrue(std::initializer_list<std::string_view> spellings) const {
        const std::string value = lowered(field(spellings));
        return value == "true" || value == "t" || value == "1";
    }
};

Result<MetaHeader> parseHeader(std::string_view text) {
    MetaHeader header;
    std::size_t at = 0;
    for (int number = 1; at < text.size(); ++number) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos && text.size() == kMaxHeader) break;
        const std::string_view line = trimmed(text.substr(at, std::min(end, text.size()) - at));
        at = end == std::string_view::npos ? text.size() : end + 1;
        if (line.empty()) continue;
        const std::size_t equals = line.find_first_of("=:");
        if (equals == std::string_view::npos) {
            return fail(ErrorCode::Corrupt, fmt::format("header line {}: '{}' is not of the form Key = value",
                                                        number, shown(line)));
        }
        const std::string_view key = trimmed(line.substr(0, equals));
        header.fields.insert_or_assign(std::string(key), std::string(trimmed(line.substr(equals + 1))));
        if (key == "ElementDataFile") {
            header.bytes = at;
            return header;
        }
    }
    return fail(ErrorCode::Corrupt, "the header has no ElementDataFile: the file is cut off or no MetaImage");
}

/// As many numbers as asked, finite; empty when the field is not there.
Result<std::vector<double>> numbers(const MetaHeader& header,
                                    std::initializer_list<std::string_view> spellings, std::size_t count) {
    std::vector<double> values;
    const std::string_view text = header.field(spellings);
    for (const std::string_view word : words(text)) {
        const auto number = numberFrom<double>(word);
        if (!number || !std::isfinite(*number))
            return fail(ErrorCode::Corrupt,
                        fmt::format("{}: '{}' is not a finite number", *spellings.begin(), shown(word)));
        values.push_back(*number);
    }
    if (!text.empty() && values.size() != count) {
        return fail(ErrorCode::Corrupt, fmt::format("{} has {} numbers; {} are needed", *spellings.begin(),
                                                    values.size(), count));
    }
    return values;
}

Result<std::vector<int>> sizesOf(const MetaHeader& header) {
    const auto dims = numberFrom<int>(header.field({"NDims"}));
    if (!dims || *dims < 1 || *dims > 10)
        return fail(ErrorCode::Corrupt, fmt::format("NDims is '{}'", shown(header.field({"NDims"}))));
    std::vector<int> sizes;
    for (const std::string_view word : words(header.field({"DimSize"}))) {
        const auto size = numberFrom<int>(word);
        if (!size || *size < 1)
            return fail(ErrorCode::Corrupt,
                        fmt::format("DimSize: '{}' is not a positive integer", shown(word)));
        sizes.push_back(*size);
    }
    if (sizes.size() != static_cast<std::size_t>(*dims)) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("DimSize has {} numbers, NDims is {}", sizes.size(), *dims));
    }
    if (*dims == 1 ||
        (*dims > 3 && std::any_of(sizes.begin() + 3, sizes.end(), [](int s) { return s > 1; }))) {
        return fail(ErrorCode::Unsupported, fmt::format("{}D (DimSize {}): not yet; 2D and 3D are read",
                                                        *dims, shown(header.field({"DimSize"}))));
    }
    return sizes;
}

/// AnatomicalOrientation names the side each axis comes from ("RAI" is the identity in LPS); empty or "???"
/// says nothing.
void checkAnatomicalOrientation(const MetaHeader& header, const Grid& grid, std::vector<Warning>& warnings) {
    const std::string_view stated = header.field({"AnatomicalOrientation"});
    if (stated.size() != 3 || stated.find('?') != std::string_view::npos) return;
    constexpr std::string_view kTo = "LPSRAI";
    constexpr std::string_view kFrom = "RAILPS";
    for (int axis = 0; axis < 3; ++axis) {
        const std::string letters = orientationLetters(glm::dvec3(grid.patientFromIndex[axis]));
        const std::size_t from = kFrom.find(stated[static_cast<std::size_t>(axis)]);
        if (letters.empty() || from == std::string_view::npos || kTo[from] == letters[0]) continue;
        warnings.push_back(
            {fmt::format("AnatomicalOrientation is {}, but axis {} of the TransformMatrix points to {}; the "
                         "matrix is used",
                         shown(stated), axis, letters)});
        return;
    }
}

Result<Grid> gridOf(const MetaHeader& header, const std::vector<int>& sizes, std::vector<Warning>& warnings) {
    const std::size_t n = sizes.size();
    auto spacing = numbers(header, {"ElementSpacing", "ElementSize"}, n);
    if (!spacing) return tl::unexpected(spacing.error());
    auto offset = numbers(header, {"Offset", "Position", "Origin"}, n);
    if (!offset) return tl::unexpected(offset.error());
    auto matrix = numbers(header, {"TransformMatrix", "Rotation", "Orientation"}, n * n);
    if (!matrix) return tl::unexpected(matrix.error());
    if (spacing->empty()) {
        warnings.push_back({"the file states no ElementSpacing; taken as 1 mm"});
        spacing->assign(n, 1.0);
    }
    if (matrix->empty())
        warnings.push_back(
            {"the file states no TransformMatrix; its axes are taken as left, posterior and superior"});
    Grid grid;
    const std::size_t used = std::min<std::size_t>(n, 3);
    for (std::size_t a = 0; a < used; ++a) {
        const int i = static_cast<int>(a);
        grid.size[i] = sizes[a];
        glm::dvec4 column(0.0);
        column[i] = 1.0;
        for (std::size_t r = 0; r < used && !matrix->empty(); ++r)
            column[static_cast<int>(r)] = (*matrix)[a * n + r];
        grid.patientFromIndex[i] = column * (*spacing)[a];
        if (!offset->empty()) grid.patientFromIndex[3][i] = (*offset)[a];
    }
    checkAnatomicalOrientation(header, grid, warnings);
    return grid;
}

Result<VoxelSource> sourceOf(const fs::path& file, const MetaHeader& header) {
    VoxelSource source{file};
    const std::string_view dataFile = header.field({"ElementDataFile"});
    if (lowered(dataFile) == "local") {
        source.skip = header.bytes;
    } else if (dataFile.starts_with("LIST") || dataFile.find('%') != std::string_view::npos) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("ElementDataFile is '{}': voxels in several files are not read; one file is",
                                shown(dataFile)));
    } else {
        source.file = file.parent_path() / fs::path(dataFile);
    }
    source.deflated = header.isTrue({"CompressedData"});
    const std::string_view text = header.field({"HeaderSize"});
    if (text.empty()) return source;
    const auto skip = numberFrom<std::int64_t>(text);
    if (!skip || *skip < -1 || (*skip == -1 && source.deflated))
        return fail(ErrorCode::Corrupt, fmt::format("HeaderSize is '{}'", shown(text)));
    source.countsFromEnd = *skip == -1;
    if (*skip > 0) source.skip = static_cast<std::uint64_t>(*skip);
    return source;
}

Result<ValueMapping> mappingOf(const MetaHeader& header) {
    ValueMapping mapping;
    const auto slope = numbers(header, {"ElementToIntensityFunctionSlope"}, 1);
    if (!slope) return tl::unexpected(slope.error());
    const auto offset = numbers(header, {"ElementToIntensityFunctionOffset"}, 1);
    if (!offset) return tl::unexpected(offset.error());
    if (!slope->empty()) mapping.slope = slope->front();
    if (!offset->empty()) mapping.intercept = offset->front();
    return mapping;
}

/// "MET_MOD_CT" to "CT", where it is a DICOM modality.
std::string modalityOf(const MetaHeader& header) {
    const std::string_view stated = header.field({"Modality"});
    for (const std::string_view known : {"CT", "MR", "NM", "US"}) {
        if (stated == fmt::format("MET_MOD_{}", known)) return std::string(known);
    }
    return {};
}

/// Element type and channels. Errors: Unsupported, Corrupt.
Result<void> readElement(const MetaHeader& header, VolumeParts& parts) {
    std::string_view typeName = header.field({"ElementType"});
    if (typeName.ends_with("_ARRAY")) typeName.remove_suffix(6);
    const auto* row =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& r) { return r.first == typeName; });
    if (row == kTypes.end()) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("ElementType is '{}'; MET_CHAR to MET_DOUBLE are read", shown(typeName)));
    }
    parts.type = row->second;
    const std::string_view channels = header.field({"ElementNumberOfChannels"});
    if (!channels.empty()) {
        const auto count = numberFrom<int>(channels);
        if (!count || *count < 1)
            return fail(ErrorCode::Corrupt, fmt::format("ElementNumberOfChannels is '{}'", shown(channels)));
        if (*count > 4)
            return fail(ErrorCode::Unsupported,
                        fmt::format("{} components a voxel; 1 to 4 are drawn", *count));
        parts.components = *count;
    }
    parts.bigEndian = header.isTrue({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
    if (!header.field({"BinaryData"}).empty() && !header.isTrue({"BinaryData"})) {
        return fail(ErrorCode::Unsupported, "the voxels are text (BinaryData = False); binary ones are read");
    }
    return {};
}

}  // namespace

bool looksLikeMetaImage(std::string_view start) {
    const std::string_view key = trimmed(start.substr(0, start.find('=')));
    constexpr std::array<std::string_view, 9> kFirst{"ObjectType",    "NDims", "Comment", "ObjectSubType",
                                                     "TransformType", "Name",  "ID",      "BinaryData",
                                                     "DimSize"};
    return start.find('=') != std::string_view::npos &&
           std::find(kFirst.begin(), kFirst.end(), key) != kFirst.end();
}

Result<VolumePtr> loadMetaImage(const fs::path& file, const LoadOptions& options) {
    const auto header = parseHeader(firstBytes(file, kMaxHeader, false));
    if (!header) return tl::unexpected(header.error());
    const std::string_view object = header->field({"ObjectType"});
    if (!object.empty() && object != "Image") {
        return fail(ErrorCode::Unsupported,
                    fmt::format("the Meta file holds a {}; images are read", shown(object)));
    }
    const auto sizes = sizesOf(*header);
    if (!sizes) return tl::unexpected(sizes.error());
    VolumeParts parts;
    if (const auto element = readElement(*header, parts); !element) return tl::unexpected(element.error());
    const auto grid = gridOf(*header, *sizes, parts.info.warnings);
    if (!grid) return tl::unexpected(grid.error());
    parts.grid = *grid;
    const auto mapping = mappingOf(*header);
    if (!mapping) return tl::unexpected(mapping.error());
    parts.mapping = *mapping;
    const auto source = sourceOf(file, *header);
    if (!source) return tl::unexpected(source.error());
    const auto wanted = voxelBytes(grid->size, parts.components, parts.type, options.maxVoxelBytes);
    if (!wanted) return tl::unexpected(wanted.error());
    auto voxels =
        readVoxels(*source, *wanted, arithmetic(grid->size, parts.components, parts.type), options.progress);
    if (!voxels) return tl::unexpected(voxels.error());
    if (voxels->surplus > 0)
        parts.info.warnings.push_back(
            {fmt::format("{} bytes after the voxels are not used", voxels->surplus)});
    parts.voxels = std::move(voxels->bytes);
    parts.info.modality = modalityOf(*header);
    parts.info.name = file.filename().string();
    parts.format = source->file == file ? "MetaImage, one file" : "MetaImage, header and data";
    parts.encoding =
        fmt::format("{}{}", source->deflated ? "zlib" : "raw", parts.bigEndian ? ", big endian" : "");
    return assemble(std::move(parts));
}

}  // namespace pellucid::io
