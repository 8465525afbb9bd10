// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/progress.h"
#include "scene/volume.h"

namespace pellucid::io {

/// How raw voxels lie in a file. From a JSON sidecar (FILE.json beside FILE) or from the command line.
struct RawLayout {
    glm::ivec3 size{0, 0, 0};
    std::string type = "uint8";  ///< int8 ... int64, uint8 ... uint64, float32, float64.
    int components = 1;
    bool bigEndian = false;
    glm::dvec3 spacingMm{1, 1, 1};
    std::uint64_t headerBytes = 0;
    double slope = 1.0;
    double intercept = 0.0;
    std::string unit;
};

/// A coarse copy has one voxel of so many along each axis.
inline constexpr int kCoarseEvery = 4;

struct LoadOptions {
    std::optional<RawLayout> raw;  ///< Read the file as raw voxels whatever its name.
    std::string seriesUid;         ///< Which series of a folder or DICOMDIR, when it holds several.
    std::uint64_t maxVoxelBytes = 16ull << 30;  ///< Refused above this, before anything is allocated.
    Progress progress;
    /// Of a DICOM series of 16 million voxels and more: one voxel of kCoarseEvery along each axis, as soon as
    /// these slices are there. Called on the loading thread, at most once; loading may still fail after it.
    std::function<void(VolumePtr coarse)> coarse{};
};

/// Reads one volume: a file in any known format, a folder or list of DICOM files, or a DICOMDIR.
/// Decided by content first (magic numbers), by name only where a format has none.
/// Errors: NotFound, Unreadable, Corrupt (what is wrong, where, expected and found numbers), Unsupported,
/// TooLarge, Inconsistent (missing slice: the two files and the gap in mm; several series: each with UID,
/// description and count, and how to choose), Cancelled. Never returns a volume that is not placed and valued
/// as the file says.
[[nodiscard]] Result<VolumePtr> loadVolume(const std::vector<std::filesystem::path>& paths,
                                           const LoadOptions& options = {});

}  // namespace pellucid::io
