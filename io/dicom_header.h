// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/dicom_geometry.h"
#include "scene/volume.h"

namespace pellucid::io {

/// Which object a file is; enough to sort files into series.
struct DicomIdentity {
    std::filesystem::path file;
    std::string sopClass;
    std::string studyUid;
    std::string seriesUid;
    std::string description;
    std::string modality;
    bool isDirectory = false;  ///< A DICOMDIR.
    /// Why no volume can be made of it (not an image, colour, several frames); else empty.
    std::string refusal;
    /// What it lacks although its class is that of a slice (rows and columns, pixel data); else empty.
    std::string damage;
};

/// How pixels are stored (PS3.3 section C.7.6.3).
struct PixelFormat {
    int bitsAllocated = 0;  ///< 8, 16 or 32.
    int bitsStored = 0;
    int highBit = 0;
    bool isSigned = false;
    bool operator==(const PixelFormat&) const = default;
};

/// All of one single-frame monochrome image except its pixels.
struct SliceHeader {
    std::filesystem::path file;
    std::string modality;
    std::string description;
    std::string transferSyntax;
    std::string photometric;
    SlicePlacement placement;
    PixelFormat pixels;
    bool hasRescale = false;
    double slope = 1.0;
    double intercept = 0.0;
    std::string rescaleType;
    std::vector<NamedWindow> windows;
    std::string paddingValue;
    std::uint64_t pixelBytes = 0;
    std::uint64_t expectedPixelBytes = 0;  ///< Decoded.
};

/// Errors: those of DicomDataset::open.
[[nodiscard]] Result<DicomIdentity> identifyDicom(const std::filesystem::path& file);

/// Errors: those of DicomDataset::open; Unsupported with the refusal of identifyDicom, for a compression that
/// cannot be decoded, a modality look-up table, an image without position, orientation or pixel spacing;
/// Corrupt for numbers that cannot be (names the file and the element) and for pixel data shorter than the
/// size asks for.
[[nodiscard]] Result<SliceHeader> readSliceHeader(const std::filesystem::path& file);

}  // namespace pellucid::io
