// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/load.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/dicom_series.h"
#include "io/formats.h"
#include "io/scene_file.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

namespace fs = std::filesystem;

/// Enough for the magic numbers and the first key of every text header.
constexpr std::size_t kStart = 4096;

using Loader = Result<VolumePtr> (*)(const fs::path&, const LoadOptions&);

/// By magic number or first words; gzip is looked into. Null: none of the formats that say what they are.
Loader loaderByContent(const fs::path& file, std::string_view start) {
    if (start.starts_with("NRRD000")) return &loadNrrd;
    if (start.starts_with("# vtk DataFile")) return &loadLegacyVtk;
    const std::string_view text = trimmed(start);
    if (text.starts_with("<VTKFile") ||
        (text.starts_with("<?xml") && start.find("<VTKFile") != std::string_view::npos))
        return &loadVti;
    if (looksLikeMetaImage(start)) return &loadMetaImage;
    const std::string unpacked = isGzip(start) ? firstBytes(file, 4, true) : std::string(start.substr(0, 4));
    if (looksLikeNifti(unpacked)) return &loadNifti;
    return nullptr;
}

/// Formats that are known and not read, by their first bytes.
std::string_view knownButUnread(std::string_view start) {
    if (start.starts_with("\x89PNG") || start.starts_with("\xff\xd8\xff") || start.starts_with("GIF8") ||
        start.starts_with("BM"))
        return "a picture";
    if (start.starts_with("II*") || start.starts_with("MM\0*")) return "a TIFF picture";
    if (start.starts_with("\x89HDF")) return "an HDF5 file (perhaps MINC 2)";
    if (start.starts_with("CDF")) return "a NetCDF file (perhaps MINC 1)";
    if (start.starts_with("PK\x03\x04")) return "a ZIP archive: unpack it first";
    return {};
}

/// A header of another file that may describe this one.
std::string headerBeside(const fs::path& file) {
    for (const char* extension : {".nhdr", ".mhd", ".hdr"}) {
        fs::path candidate = file;
        candidate.replace_extension(extension);
        std::error_code error;
        if (candidate != file && fs::is_regular_file(candidate, error)) return candidate.filename().string();
    }
    return {};
}

Result<VolumePtr> loadUnknown(const fs::path& file, std::string_view start) {
    if (start.empty()) return fail(ErrorCode::Corrupt, "the file is empty");
    if (looksLikeScene(file))
        return fail(ErrorCode::Unsupported, "a scene and not a volume: open it as a scene");
    if (const std::string_view known = knownButUnread(start); !known.empty()) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("{}; DICOM, NRRD, MetaImage, NIfTI, VTI, VTK and raw voxels are read", known));
    }
    if (const std::string header = headerBeside(file); !header.empty()) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("voxels without a header; open {} instead", shown(header)));
    }
    return fail(ErrorCode::Unsupported,
                fmt::format("no format that is known. For raw voxels put {}.json beside it, like {{\"size\": "
                            "[64, 64, 93], \"type\": \"int16\"}}, "
                            "or give the layout as options",
                            shownPath(file.filename())));
}

Result<VolumePtr> loadOneFile(const fs::path& file, const LoadOptions& options) {
    // A folder of DICOM; a device or a pipe might never end and is refused.
    std::error_code error;
    if (fs::is_directory(file, error)) return loadDicom({file}, options);
    if (const auto size = regularFileSize(file); !size) return tl::unexpected(size.error());
    if (options.raw) return loadRaw(file, *options.raw, options);
    const std::string start = firstBytes(file, kStart, false);
    if (const Loader loader = loaderByContent(file, start)) return loader(file, options);
    const bool dicm = start.size() >= 132 && start.compare(128, 4, "DICM") == 0;
    // What somebody wrote down about a file goes before what its bytes look like by chance.
    const auto sidecar = dicm ? std::nullopt : rawSidecar(file);
    if (sidecar && !looksLikeScene(*sidecar)) {
        const auto layout = readRawSidecar(*sidecar);
        if (!layout) return fail(layout.error(), sidecar->string());
        return loadRaw(file, *layout, options);
    }
    if (looksLikeDicom(file)) return loadDicom({file}, options);
    return loadUnknown(file, start);
}

/// With the file's name, unless the message gives it already.
Result<VolumePtr> named(Result<VolumePtr> result, const fs::path& file) {
    if (result || result.error().message.find(shownPath(file)) != std::string::npos) return result;
    return fail(std::move(result.error()), shownPath(file));
}

}  // namespace

Result<VolumePtr> loadVolume(const std::vector<fs::path>& paths, const LoadOptions& options) {
    if (paths.empty()) return fail(ErrorCode::InvalidArgument, "no file was given");
    for (const fs::path& path : paths) {
        std::error_code error;
        if (!fs::exists(path, error))
            return fail(ErrorCode::NotFound, fmt::format("{} does not exist", shownPath(path)));
    }
    try {
        if (paths.size() == 1) return named(loadOneFile(paths.front(), options), paths.front());
        // Several files are one volume only as the slices of a DICOM series.
        for (const fs::path& path : paths) {
            std::error_code error;
            if (fs::is_directory(path, error) || looksLikeDicom(path)) continue;
            return fail(ErrorCode::Unsupported, fmt::format("{} is not DICOM; of other formats one file at a "
                                                            "time is read, or several named in a scene",
                                                            shownPath(path)));
        }
        return loadDicom(paths, options);
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::TooLarge,
                    fmt::format("{} needs more memory than there is", shownPath(paths.front())));
    } catch (const fs::filesystem_error& error) {
        return fail(ErrorCode::Unreadable,
                    fmt::format("{}: {}", shownPath(paths.front()), error.code().message()));
    }
}

}  // namespace pellucid::io
