// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// VTK file formats, "Simple Legacy Formats". vtkStructuredPointsReader (VTK 9.1) returns a truncated binary
// file with zeros for the missing voxels and reports nothing, so where the voxels begin and how many bytes
// they need is found out first.
#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsReader.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "io/atomic_file.h"
#include "io/formats.h"
#include "io/text_scan.h"
#include "io/vtk_reading.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::size_t>, 13> kTypes{{{"unsigned_char", 1},
                                                                           {"char", 1},
                                                                           {"signed_char", 1},
                                                                           {"unsigned_short", 2},
                                                                           {"short", 2},
                                                                           {"unsigned_int", 4},
                                                                           {"int", 4},
                                                                           {"unsigned_long", sizeof(long)},
                                                                           {"long", sizeof(long)},
                                                                           {"vtktypeint64", 8},
                                                                           {"vtktypeuint64", 8},
                                                                           {"float", 4},
                                                                           {"double", 8}}};

/// Walks over the text parts of a file that may hold binary data in between.
struct Cursor {
    std::string_view text;
    std::size_t at = 0;

    /// The next line's words; empty at the end. Lines of white space are passed over.
    std::vector<std::string_view> line() {
        while (at < text.size()) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            const auto result = words(text.substr(at, std::min<std::size_t>(end - at, 4096)));
            at = std::min(end + 1, text.size());
            if (!result.empty()) return result;
        }
        return {};
    }
};

/// The first array of the file: how much data it must have, and from where on.
struct LegacyOutline {
    bool binary = false;
    glm::ivec3 size{0, 0, 0};
    std::uint64_t values = 0;
    std::size_t bytesPerValue = 1;
    std::size_t dataOffset = 0;
};

Result<std::size_t> bytesOf(std::string_view type) {
    const std::string low = lowered(type);
    const auto* row =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& r) { return r.first == low; });
    if (row == kTypes.end())
        return fail(ErrorCode::Unsupported,
                    fmt::format("the voxel type is '{}'; numbers of 8 bits and more are read", shown(type)));
    return row->second;
}

Result<void> setArray(LegacyOutline& outline, std::uint64_t tuples, std::uint64_t components,
                      std::string_view type) {
    const auto bytes = bytesOf(type);
    if (!bytes) return tl::unexpected(bytes.error());
    if (components < 1 || components > 4)
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} components a voxel; 1 to 4 are drawn", components));
    outline.values = tuples * components;
    outline.bytesPerValue = *bytes;
    return {};
}

/// The line after POINT_DATA or CELL_DATA, e.g. "SCALARS name short 1", and those that belong to it.
Result<void> readAttribute(Cursor& cursor, std::uint64_t tuples, LegacyOutline& outline) {
    const auto word = cursor.line();
    const std::string kind = word.empty() ? std::string{} : lowered(word[0]);
    Result<void> result;
    if (kind == "scalars" && word.size() >= 3) {
        const auto components = word.size() > 3 ? numberFrom<std::uint64_t>(word[3]).value_or(0) : 1;
        result = setArray(outline, tuples, components, word[2]);
        Cursor next = cursor;
        const auto table = next.line();
        if (!table.empty() && lowered(table[0]) == "lookup_table") cursor = next;
    } else if (kind == "color_scalars" && word.size() >= 3) {
        // Bytes in a binary file, numbers from 0 to 1 in a text.
        result = setArray(outline, tuples, numberFrom<std::uint64_t>(word[2]).value_or(0), "unsigned_char");
    } else if ((kind == "vectors" || kind == "normals") && word.size() >= 3) {
        result = setArray(outline, tuples, 3, word[2]);
    } else if (kind == "field" && word.size() >= 3) {
        const auto array = cursor.line();
        if (array.size() < 4 || numberFrom<std::uint64_t>(array[2]) != tuples) {
            return fail(ErrorCode::Corrupt,
                        fmt::format("the first array of the field does not have {} values", tuples));
        }
        result = setArray(outline, tuples, numberFrom<std::uint64_t>(array[1]).value_or(0), array[3]);
    } else {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("the data begins with '{}'; SCALARS, COLOR_SCALARS, VECTORS and FIELD are read",
                        shown(kind)));
    }
    outline.dataOffset = cursor.at;
    return result;
}

Result<std::uint64_t> tuplesFor(const LegacyOutline& outline, bool cells, std::string_view stated,
                                std::uint64_t maxBytes) {
    glm::ivec3 size = outline.size;
    if (cells) size = glm::ivec3(std::max(size.x - 1, 1), std::max(size.y - 1, 1), std::max(size.z - 1, 1));
    const auto count = voxelBytes(size, 1, StoredType::UInt8, maxBytes);
    if (!count) return tl::unexpected(count.error());
    if (numberFrom<std::uint64_t>(stated) != *count) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("the data states {} values, DIMENSIONS make {}x{}x{} = {}", shown(stated),
                                size.x, size.y, size.z, *count));
    }
    return *count;
}

Result<LegacyOutline> outlineOf(std::string_view text, std::uint64_t maxBytes) {
    Cursor cursor{text};
    cursor.line();
    // The title may be empty, so it is passed over as it stands.
    cursor.at = std::min(text.find('\n', cursor.at), text.size() - 1) + 1;
    LegacyOutline outline;
    const auto format = cursor.line();
    outline.binary = !format.empty() && lowered(format[0]) == "binary";
    if (format.empty() || (!outline.binary && lowered(format[0]) != "ascii"))
        return fail(ErrorCode::Corrupt, "the third line is neither ASCII nor BINARY");
    const auto dataset = cursor.line();
    if (dataset.size() < 2 || lowered(dataset[0]) != "dataset")
        return fail(ErrorCode::Corrupt, "DATASET is missing after the title");
    if (lowered(dataset[1]) != "structured_points") {
        return fail(ErrorCode::Unsupported,
                    fmt::format("a VTK file of {}; STRUCTURED_POINTS are read", shown(dataset[1])));
    }
    for (std::vector<std::string_view> word; !(word = cursor.line()).empty();) {
        const std::string keyword = lowered(word[0]);
        if (keyword == "dimensions" && word.size() >= 4) {
            for (int axis = 0; axis < 3; ++axis)
                outline.size[axis] = numberFrom<int>(word[static_cast<std::size_t>(axis) + 1]).value_or(0);
        } else if ((keyword == "point_data" || keyword == "cell_data") && word.size() >= 2) {
            const auto tuples = tuplesFor(outline, keyword == "cell_data", word[1], maxBytes);
            if (!tuples) return tl::unexpected(tuples.error());
            if (const auto read = readAttribute(cursor, *tuples, outline); !read)
                return tl::unexpected(read.error());
            return outline;
        } else if (keyword != "origin" && keyword != "spacing" && keyword != "aspect_ratio") {
            return fail(ErrorCode::Unsupported,
                        fmt::format("'{}' before the voxels is not read", shown(word[0])));
        }
    }
    return fail(ErrorCode::Corrupt, "the file ends before POINT_DATA: it is cut off");
}

/// Numbers in a text from `at` on, at most `wanted`.
std::uint64_t countNumbers(std::string_view text, std::size_t at, std::uint64_t wanted) {
    std::uint64_t count = 0;
    while (count < wanted) {
        at = text.find_first_not_of(" \t\r\n", at);
        if (at == std::string_view::npos) break;
        const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
        if (!numberFrom<double>(text.substr(at, end - at))) break;
        ++count;
        at = end;
    }
    return count;
}

Result<void> checkSize(const LegacyOutline& outline, std::string_view text, std::uint64_t maxBytes) {
    const std::uint64_t wanted = outline.values * outline.bytesPerValue;
    if (wanted > maxBytes)
        return fail(ErrorCode::TooLarge,
                    fmt::format("{} bytes of voxels; at most {} are read", wanted, maxBytes));
    const std::uint64_t found = text.size() - outline.dataOffset;
    if (outline.binary && found < wanted) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("expected {}x{}x{}: {} values x {} bytes = {} bytes of voxels, found {} bytes",
                        outline.size.x, outline.size.y, outline.size.z, outline.values, outline.bytesPerValue,
                        wanted, found));
    }
    if (outline.binary) return {};
    const std::uint64_t numbers = countNumbers(text, outline.dataOffset, outline.values);
    if (numbers < outline.values) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("expected {} numbers, found {} before the end or something else",
                                outline.values, numbers));
    }
    return {};
}

}  // namespace

Result<VolumePtr> loadLegacyVtk(const fs::path& file, const LoadOptions& options) {
    const auto bytes = readFile(file, options.maxVoxelBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    const auto outline = outlineOf(text, options.maxVoxelBytes);
    if (!outline) return tl::unexpected(outline.error());
    if (const auto fits = checkSize(*outline, text, options.maxVoxelBytes); !fits)
        return tl::unexpected(fits.error());
    if (!goOn(options.progress, 0.0, "reading voxels"))
        return fail(ErrorCode::Cancelled, "reading was cancelled");

    silenceVtk();
    vtkNew<vtkStructuredPointsReader> reader;
    vtkNew<VtkErrors> errors;
    reader->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->AddObserver(vtkCommand::WarningEvent, errors);
    reader->SetFileName(file.c_str());
    try {
        reader->Update();
    } catch (const std::exception& error) {
        return fail(ErrorCode::Corrupt, fmt::format("VTK's reader gave up: {}", error.what()));
    }
    if (errors->any())
        return fail(ErrorCode::Corrupt, fmt::format("the file of {} bytes is damaged or cut off: {}",
                                                    bytes->size(), errors->first()));
    VolumeParts parts;
    parts.format = "VTK legacy structured points";
    parts.encoding = outline->binary ? "raw, big endian" : "text";
    parts.info.name = file.filename().string();
    return volumeFromVtk(*reader->GetOutput(), std::move(parts));
}

}  // namespace pellucid::io
