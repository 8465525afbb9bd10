// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/load.h"

namespace pellucid::io {

/// One series found in a scan of files; nothing is decoded yet.
struct DicomSeries {
    std::string uid;
    std::string description;     ///< Series description; free of patient names as far as the scanner kept to the standard.
    std::string modality;
    std::vector<std::filesystem::path> files;
};

/// What a scan saw: series, and files it left out with the reason.
struct DicomScan {
    std::vector<DicomSeries> series;
    std::vector<Warning> leftOut;
};

/// True for DICOM by content ("DICM" at byte 128, or a plausible data set without preamble).
[[nodiscard]] bool looksLikeDicom(const std::filesystem::path& file);

/// Groups DICOM image files by series: a folder (recursively), a list of files, or a DICOMDIR with the files it names.
[[nodiscard]] Result<DicomScan> scanDicom(const std::vector<std::filesystem::path>& paths, const Progress& progress = {});

/// Decodes one single-frame CT or MR series to a volume in HU or rescaled units, slices ordered along the normal
/// of ImageOrientationPatient, spacing from positions.
[[nodiscard]] Result<VolumePtr> loadDicomSeries(const DicomSeries& series, const LoadOptions& options = {});

}  // namespace pellucid::io
