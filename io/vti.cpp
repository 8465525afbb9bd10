// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <vtkDataArraySelection.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>

#include <exception>

#include "io/atomic_file.h"
#include "io/formats.h"
#include "io/text_scan.h"
#include "io/vtk_reading.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// The value of an attribute in "<Tag a="1" b="2">", empty when it is not there.
std::string_view attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = 0; (at = tag.find(name, at)) != std::string_view::npos; at += name.size()) {
        const std::string_view rest = trimmed(tag.substr(at + name.size()));
        if (at == 0 || tag[at - 1] > ' ' || !rest.starts_with('=')) continue;
        const std::string_view value = trimmed(rest.substr(1));
        if (value.empty() || (value[0] != '"' && value[0] != '\'')) return {};
        return value.substr(1, value.find(value[0], 1) - 1);
    }
    return {};
}

/// "<Tag ...>" from `at` on; `at` moves behind it.
std::string_view nextTag(std::string_view text, std::string_view tag, std::size_t& at) {
    const std::size_t begin = text.find(tag, at);
    if (begin == std::string_view::npos) return {};
    const std::size_t end = text.find('>', begin);
    at = std::min(end, text.size() - 1) + 1;
    return text.substr(begin, at - begin);
}

/// What a look at the XML says before VTK allocates anything.
struct VtiOutline {
    std::string_view type;
    glm::ivec3 points{0, 0, 0};
    std::vector<std::string> arrays;
    std::string chosen;            ///< The array that is drawn.
    std::uint64_t leastBytes = 0;  ///< What all arrays need in memory.
    bool compressed = false;
    bool ascii = false;
};

std::size_t typeBytes(std::string_view type) {
    const auto bits = numberFrom<int>(type.substr(std::min(type.find_first_of("0123456789"), type.size())));
    return bits && *bits >= 8 ? static_cast<std::size_t>(*bits) / 8 : 1;
}

Result<glm::ivec3> pointsOf(std::string_view extent) {
    const std::vector<std::string_view> word = words(extent);
    glm::ivec3 points(0);
    for (int axis = 0; axis < 3 && word.size() == 6; ++axis) {
        const auto lo = numberFrom<std::int32_t>(word[static_cast<std::size_t>(2 * axis)]);
        const auto hi = numberFrom<std::int32_t>(word[static_cast<std::size_t>(2 * axis) + 1]);
        if (!lo || !hi || *hi < *lo || static_cast<std::int64_t>(*hi) - *lo >= INT32_MAX) break;
        points[axis] = *hi - *lo + 1;
    }
    if (points.x < 1 || points.y < 1 || points.z < 1) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("WholeExtent is '{}'; six integers, each first no larger than its second, are needed",
                        shown(extent)));
    }
    return points;
}

Result<VtiOutline> outlineOf(std::string_view text) {
    VtiOutline outline;
    const std::string_view xml = text.substr(0, text.find("<AppendedData"));
    std::size_t at = 0;
    const std::string_view root = nextTag(xml, "<VTKFile", at);
    outline.type = attribute(root, "type");
    if (outline.type != "ImageData") {
        return fail(ErrorCode::Unsupported,
                    fmt::format("a VTK file of type {}; ImageData (.vti) is read", shown(outline.type)));
    }
    outline.compressed = !attribute(root, "compressor").empty();
    const auto points = pointsOf(attribute(nextTag(xml, "<ImageData", at), "WholeExtent"));
    if (!points) return tl::unexpected(points.error());
    outline.points = *points;
    std::size_t pointData = at;
    const std::string_view scalars = attribute(nextTag(xml, "<PointData", pointData), "Scalars");
    for (std::string_view tag; !(tag = nextTag(xml, "<DataArray", at)).empty();) {
        const auto components = numberFrom<int>(attribute(tag, "NumberOfComponents")).value_or(1);
        // Arrays of a few values (field data) count for more than they have; a bound from above would be
        // wrong for them.
        if (attribute(tag, "NumberOfTuples").empty()) {
            outline.leastBytes =
                std::max(outline.leastBytes, static_cast<std::uint64_t>(std::max(components, 1)) *
                                                 typeBytes(attribute(tag, "type")));
            outline.arrays.emplace_back(attribute(tag, "Name"));
        }
        outline.ascii = outline.ascii || attribute(tag, "format") == "ascii";
    }
    if (outline.arrays.empty())
        return fail(ErrorCode::Corrupt, "the file has no DataArray: it holds no voxels or is cut off");
    outline.chosen = scalars.empty() ? outline.arrays.front() : std::string(scalars);
    return outline;
}

/// Cells are one fewer along each axis; the smaller count bounds both kinds of data.
Result<void> checkSize(VtiOutline& outline, std::uint64_t fileBytes, std::uint64_t maxBytes) {
    std::uint64_t bytes = outline.leastBytes;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cells = static_cast<std::uint64_t>(std::max(outline.points[axis] - 1, 1));
        if (__builtin_mul_overflow(bytes, cells, &bytes) || bytes > maxBytes) {
            return fail(ErrorCode::TooLarge,
                        fmt::format("{}x{}x{} voxels are more than the {} bytes that are read at most",
                                    outline.points.x, outline.points.y, outline.points.z, maxBytes));
        }
    }
    // Deflate expands at most 1032 times; LZMA more, yet such files of nothing but one value do not occur.
    // Text needs at least two bytes ("0 ") for a value of up to eight.
    const std::uint64_t factor = outline.compressed ? 1032 : (outline.ascii ? 4 : 1);
    if (bytes / factor > fileBytes) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("expected {}x{}x{} voxels, at least {} bytes; the file of {} bytes cannot hold them",
                        outline.points.x, outline.points.y, outline.points.z, bytes, fileBytes));
    }
    return {};
}

}  // namespace

Result<VolumePtr> loadVti(const fs::path& file, const LoadOptions& options) {
    const auto bytes = readFile(file, options.maxVoxelBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    auto outline = outlineOf({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (!outline) return tl::unexpected(outline.error());
    if (const auto fits = checkSize(*outline, bytes->size(), options.maxVoxelBytes); !fits)
        return tl::unexpected(fits.error());
    if (!goOn(options.progress, 0.0, "reading voxels"))
        return fail(ErrorCode::Cancelled, "reading was cancelled");

    silenceVtk();
    vtkNew<vtkXMLImageDataReader> reader;
    vtkNew<VtkErrors> errors;
    reader->AddObserver(vtkCommand::ErrorEvent, errors);
    reader->SetReaderErrorObserver(errors);
    reader->SetParserErrorObserver(errors);
    reader->SetFileName(file.c_str());
    try {
        reader->UpdateInformation();
        vtkDataArraySelection* selection = reader->GetPointDataArraySelection();
        if (selection->ArrayExists(outline->chosen.c_str()) != 0) {
            selection->DisableAllArrays();
            selection->EnableArray(outline->chosen.c_str());
            reader->GetCellDataArraySelection()->DisableAllArrays();
        }
        reader->Update();
    } catch (const std::exception& error) {
        return fail(ErrorCode::Corrupt, fmt::format("VTK's reader gave up: {}", error.what()));
    }
    if (errors->any())
        return fail(ErrorCode::Corrupt, fmt::format("the file of {} bytes is damaged or cut off: {}",
                                                    bytes->size(), errors->first()));
    VolumeParts parts;
    if (outline->arrays.size() > 1) {
        parts.info.warnings.push_back({fmt::format(
            "the file holds {} arrays ({}); '{}' is shown", outline->arrays.size(),
            shown(fmt::format("{}", fmt::join(outline->arrays, ", ")), 200), shown(outline->chosen))});
    }
    parts.format = "VTK XML image data";
    parts.encoding = outline->ascii ? "text" : (outline->compressed ? "compressed" : "raw");
    parts.info.name = file.filename().string();
    return volumeFromVtk(*reader->GetOutput(), std::move(parts));
}

}  // namespace pellucid::io
