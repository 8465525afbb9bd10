// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The only header that shows DCMTK; included by the dicom_*.cpp files alone.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/dicom_structure.h"
#include "scene/result.h"

namespace pellucid::io {

/// Silences DCMTK's logger and registers its decoders (RLE, JPEG, JPEG-LS), once per process; thread-safe.
/// Errors: Unreadable when DCMTK's data dictionary is not installed.
Result<void> prepareDcmtk();

/// "JPEG 2000 Image Compression (Lossless Only)" for people, or the UID itself.
[[nodiscard]] std::string transferSyntaxName(const std::string& uid);
/// "CT Image Storage" for people, or one that quotes the UID.
[[nodiscard]] std::string sopClassName(const std::string& uid);

/// A parsed DICOM file with typed access to its top level. Values that are absent or empty give nothing;
/// values that are there and cannot be read are errors.
class DicomDataset {
public:
    enum class Part { Header, All };

    /// Inspects, then parses. `Header` stops before the pixel data. Errors: those of inspectDicom; Corrupt or
    /// Unreadable with DCMTK's reason.
    static Result<DicomDataset> open(const std::filesystem::path& file, Part part);

    [[nodiscard]] const DicomStructure& structure() const { return m_structure; }
    [[nodiscard]] DcmDataset& dcmtk() { return *m_file->getDataset(); }
    [[nodiscard]] DcmMetaInfo& meta() { return *m_file->getMetaInfo(); }
    [[nodiscard]] std::string transferSyntax();

    [[nodiscard]] bool has(const DcmTagKey& tag);
    /// First value without padding; "" when absent.
    [[nodiscard]] std::string text(const DcmTagKey& tag);
    /// First value as UTF-8 after the file's character set, control characters removed.
    [[nodiscard]] std::string localText(const DcmTagKey& tag);
    /// All values of a text element.
    [[nodiscard]] std::vector<std::string> texts(const DcmTagKey& tag);
    /// Errors: Corrupt when one of them is no decimal number.
    [[nodiscard]] Result<std::vector<double>> decimals(const DcmTagKey& tag);
    /// The first value. Errors as decimals.
    [[nodiscard]] Result<std::optional<double>> decimal(const DcmTagKey& tag);
    [[nodiscard]] std::optional<std::uint16_t> number(const DcmTagKey& tag);

private:
    std::string m_name;
    DicomStructure m_structure;
    std::unique_ptr<DcmFileFormat> m_file;
};

}  // namespace pellucid::io
