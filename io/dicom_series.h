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
    std::string description;  ///< Series description; free of patient names as far as the scanner kept to the
                              ///< standard.
    std::string modality;
    std::vector<std::filesystem::path> files;
    std::vector<Warning> warnings;  ///< What the scan left out, for the volume's warnings.
};

/// What a scan saw: series, and files it left out with the reason.
struct DicomScan {
    std::vector<DicomSeries> series;
    std::vector<Warning> leftOut;
};

/// True for DICOM by content ("DICM" at byte 128, or a plausible data set without preamble).
[[nodiscard]] bool looksLikeDicom(const std::filesystem::path& file);

/// Groups DICOM image files by series: a folder (recursively), a list of files, or a DICOMDIR with the files
/// it names. Only what a volume can be made of gets into a series: one monochrome frame with pixels; the rest
/// is left out with the reason. Errors: NotFound, Unreadable, Cancelled; Unsupported or Corrupt when not one
/// file is left.
[[nodiscard]] Result<DicomScan> scanDicom(const std::vector<std::filesystem::path>& paths,
                                          const Progress& progress = {});

/// The series with this UID, or the only one when `uid` is empty. Errors: Inconsistent when there are
/// several (names UID, description and file count of each and how to choose), NotFound for a UID not there.
[[nodiscard]] Result<DicomSeries> chooseSeries(const DicomScan& scan, const std::string& uid);

/// Decodes one single-frame CT or MR series to a volume in HU or rescaled units, slices ordered along the
/// normal of ImageOrientationPatient, spacing from positions.
[[nodiscard]] Result<VolumePtr> loadDicomSeries(const DicomSeries& series, const LoadOptions& options = {});

/// Scans, chooses options.seriesUid or the only series, and decodes: what loadVolume does with DICOM paths.
[[nodiscard]] Result<VolumePtr> loadDicom(const std::vector<std::filesystem::path>& paths,
                                          const LoadOptions& options = {});

}  // namespace pellucid::io
