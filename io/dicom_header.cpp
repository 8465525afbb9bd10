// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/dicom_dataset.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

std::string nameOf(const std::filesystem::path& file) {
    return shown(file.filename().string());
}

/// Objects whose values are pixel x slope + intercept and nothing else; others (dose, nuclear medicine, ...)
/// have scalings of their own. Some writers leave the class empty; then the modality decides.
bool isSliceClass(const DicomIdentity& identity) {
    if (identity.sopClass.empty()) {
        return identity.modality == "CT" || identity.modality == "MR" || identity.modality == "PT";
    }
    return identity.sopClass == UID_CTImageStorage || identity.sopClass == UID_MRImageStorage ||
           identity.sopClass == UID_PositronEmissionTomographyImageStorage ||
           identity.sopClass == UID_SecondaryCaptureImageStorage;
}

std::string classText(const DicomIdentity& identity) {
    return identity.sopClass.empty() ? "an object without SOP class" : sopClassName(identity.sopClass);
}

/// What a slice must have and a cut file lacks; empty when nothing.
std::string damageOf(DicomDataset& data, const DicomIdentity& identity) {
    if (!data.number(DCM_Rows) || !data.number(DCM_Columns)) {
        return classText(identity) + ": no image (it has no rows and columns)";
    }
    if (!data.structure().hasPixelData) return classText(identity) + ": no pixel data";
    return {};
}

/// Why no volume can be made of an object; empty when it can.
std::string refusalOf(DicomDataset& data, const DicomIdentity& identity) {
    const std::string what = classText(identity);
    const bool enhanced =
        data.has(DCM_SharedFunctionalGroupsSequence) || data.has(DCM_PerFrameFunctionalGroupsSequence);
    const auto frames = numberFrom<long long>(data.text(DCM_NumberOfFrames)).value_or(1);
    if (identity.sopClass == UID_SegmentationStorage) return what + ": a segmentation, not an image";
    const bool isSlice = isSliceClass(identity);
    if (!isSlice && (!data.number(DCM_Rows) || !data.number(DCM_Columns))) return what + ": no image";
    if (data.has(DCM_NumberOfFrames) && frames != 1) {
        return fmt::format("{}: {} frames in one file", what, frames);
    }
    if (enhanced) return what + ": an enhanced (multi-frame) object";
    if (data.number(DCM_SamplesPerPixel).value_or(1) != 1) return what + ": a colour image";
    const std::string photometric = data.text(DCM_PhotometricInterpretation);
    if (data.number(DCM_Rows) && photometric != "MONOCHROME1" && photometric != "MONOCHROME2") {
        return fmt::format("{}: photometric interpretation \"{}\", not a grey-scale image", what,
                           shown(photometric));
    }
    if (!isSlice) return what + ": not a slice of CT, MR or PET";
    return {};
}

DicomIdentity identityOf(DicomDataset& data, const std::filesystem::path& file) {
    DicomIdentity identity;
    identity.file = file;
    identity.sopClass = data.text(DCM_SOPClassUID);
    identity.studyUid = data.text(DCM_StudyInstanceUID);
    identity.seriesUid = data.text(DCM_SeriesInstanceUID);
    identity.description = data.localText(DCM_SeriesDescription);
    identity.modality = data.text(DCM_Modality);
    OFString mediaClass;
    data.meta().findAndGetOFString(DCM_MediaStorageSOPClassUID, mediaClass);
    // A cut file may have lost the one in its data set.
    if (identity.sopClass.empty()) identity.sopClass = trimmed({mediaClass.c_str(), mediaClass.length()});
    identity.isDirectory = identity.sopClass == UID_MediaStorageDirectoryStorage ||
                           data.dcmtk().tagExists(DCM_DirectoryRecordSequence);
    if (identity.isDirectory) return identity;
    identity.refusal = refusalOf(data, identity);
    if (identity.refusal.empty()) identity.damage = damageOf(data, identity);
    return identity;
}

/// The most bytes that a compressed image of this size can decode to: a bound for headers that promise a
/// huge image in a small file. RLE: two bytes give up to 128 (PS3.5 annex G). Lossless JPEG spends a bit or
/// more on each pixel, DCT-based JPEG two bits or more on 64 pixels of up to 2 bytes. JPEG-LS spends a bit or
/// more on a row.
std::uint64_t largestDecoded(const std::string& syntax, std::uint64_t packed, std::uint64_t rowBytes) {
    if (syntax == UID_RLELosslessTransferSyntax) return packed * 64;
    const bool jpegLs = syntax == UID_JPEGLSLosslessTransferSyntax || syntax == UID_JPEGLSLossyTransferSyntax;
    return packed * (jpegLs ? 8 * rowBytes : 512);
}

/// The transfer syntaxes DCMTK decodes here.
bool isDecodable(const std::string& syntax, bool& compressed) {
    static const std::vector<std::string> kPlain{
        UID_LittleEndianImplicitTransferSyntax, UID_LittleEndianExplicitTransferSyntax,
        UID_BigEndianExplicitTransferSyntax, UID_DeflatedExplicitVRLittleEndianTransferSyntax};
    static const std::vector<std::string> kCompressed{
        UID_RLELosslessTransferSyntax,      UID_JPEGProcess1TransferSyntax,
        UID_JPEGProcess2_4TransferSyntax,   UID_JPEGProcess6_8TransferSyntax,
        UID_JPEGProcess10_12TransferSyntax, UID_JPEGProcess14TransferSyntax,
        UID_JPEGProcess14SV1TransferSyntax, UID_JPEGLSLosslessTransferSyntax,
        UID_JPEGLSLossyTransferSyntax};
    compressed = std::find(kCompressed.begin(), kCompressed.end(), syntax) != kCompressed.end();
    return compressed || std::find(kPlain.begin(), kPlain.end(), syntax) != kPlain.end();
}

Result<void> readPixelFormat(DicomDataset& data, SliceHeader& slice) {
    const std::string& name = slice.placement.name;
    const int allocated = data.number(DCM_BitsAllocated).value_or(0);
    const int stored = data.number(DCM_BitsStored).value_or(static_cast<std::uint16_t>(allocated));
    const int high = data.number(DCM_HighBit).value_or(static_cast<std::uint16_t>(std::max(stored, 1) - 1));
    const auto representation = data.number(DCM_PixelRepresentation);
    if (allocated != 8 && allocated != 16 && allocated != 32) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}: {} bits per pixel; 8, 16 and 32 can be read", name, allocated));
    }
    if (stored < 1 || stored > allocated || high >= allocated || high + 1 < stored) {
        return fail(ErrorCode::Corrupt, fmt::format("{}: {} bits stored up to bit {} in {} bits cannot be",
                                                    name, stored, high, allocated));
    }
    if (!representation || *representation > 1) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format(
                "{}: PixelRepresentation is {}, so the sign of the pixels is not known (0 is unsigned, 1 "
                "is signed)",
                name, representation ? std::to_string(*representation) : "missing"));
    }
    if (slice.placement.size.x < 1 || slice.placement.size.y < 1) {
        return fail(ErrorCode::Corrupt, fmt::format("{}: {} x {} pixels are no image", name,
                                                    slice.placement.size.x, slice.placement.size.y));
    }
    slice.pixels = {allocated, stored, high, *representation == 1};
    return {};
}

Result<void> checkPixelBytes(DicomDataset& data, SliceHeader& slice) {
    const std::string& name = slice.placement.name;
    const std::string syntax = data.transferSyntax();
    slice.transferSyntax = transferSyntaxName(syntax);
    bool compressed = false;
    if (!isDecodable(syntax, compressed)) {
        return fail(ErrorCode::Unsupported, fmt::format("{}: compressed as {} ({}), which cannot be decoded "
                                                        "here; convert it to a lossless JPEG or an "
                                                        "uncompressed transfer syntax first",
                                                        name, slice.transferSyntax, shown(syntax)));
    }
    const auto columns = static_cast<std::uint64_t>(slice.placement.size.x);
    const auto rows = static_cast<std::uint64_t>(slice.placement.size.y);
    const std::uint64_t rowBytes = columns * static_cast<std::uint64_t>(slice.pixels.bitsAllocated / 8);
    slice.expectedPixelBytes = rowBytes * rows;
    slice.pixelBytes = data.structure().pixelBytes;
    const std::uint64_t possible =
        compressed ? largestDecoded(syntax, slice.pixelBytes, rowBytes) : slice.pixelBytes;
    const std::uint64_t stated = data.structure().pixelBytesStated;
    if (stated > slice.pixelBytes && possible >= slice.expectedPixelBytes) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: truncated: its pixel data is to have {} bytes, and {} are there", name,
                                stated, slice.pixelBytes));
    }
    if (possible >= slice.expectedPixelBytes) return {};
    if (compressed) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: {} x {} pixels need {} bytes; {} compressed bytes cannot hold them",
                                name, columns, rows, slice.expectedPixelBytes, slice.pixelBytes));
    }
    return fail(ErrorCode::Corrupt,
                fmt::format("{}: truncated: {} x {} pixels need {} bytes of pixel data, and {} are there{}",
                            name, columns, rows, slice.expectedPixelBytes, slice.pixelBytes,
                            stated > slice.pixelBytes
                                ? fmt::format(" (the file ends at byte {})", data.structure().fileBytes)
                                : ""));
}

Result<void> readPlacement(DicomDataset& data, SliceHeader& slice) {
    SlicePlacement& placement = slice.placement;
    const auto position = data.decimals(DCM_ImagePositionPatient);
    const auto orientation = data.decimals(DCM_ImageOrientationPatient);
    const auto spacing = data.decimals(DCM_PixelSpacing);
    for (const auto* values : {&position, &orientation, &spacing}) {
        if (!*values) return tl::unexpected(values->error());
    }
    if (position->size() != 3 || orientation->size() != 6 || spacing->size() != 2) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format(
                "{}: no geometry: ImagePositionPatient has {} of 3 values, ImageOrientationPatient {} of "
                "6, PixelSpacing {} of 2; the place of the image in the patient is not guessed",
                placement.name, position->size(), orientation->size(), spacing->size()));
    }
    const auto& p = *position;
    const auto& o = *orientation;
    placement.positionMm = {p[0], p[1], p[2]};
    placement.rowDirection = {o[0], o[1], o[2]};
    placement.columnDirection = {o[3], o[4], o[5]};
    placement.spacingMm = {(*spacing)[1], (*spacing)[0]};
    const auto step = data.decimal(DCM_SpacingBetweenSlices);
    const auto thickness = data.decimal(DCM_SliceThickness);
    const auto tilt = data.decimal(DCM_GantryDetectorTilt);
    // These are never used to place slices, so an unreadable one is as good as none.
    placement.statedStepMm = step.value_or(std::nullopt);
    placement.thicknessMm = thickness.value_or(std::nullopt);
    placement.tiltDeg = tilt.value_or(std::nullopt);
    return {};
}

Result<void> readRescale(DicomDataset& data, SliceHeader& slice) {
    if (data.has(DCM_ModalityLUTSequence)) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}: its values go through a modality look-up table, which is not supported",
                                slice.placement.name));
    }
    const auto slope = data.decimal(DCM_RescaleSlope);
    const auto intercept = data.decimal(DCM_RescaleIntercept);
    if (!slope) return tl::unexpected(slope.error());
    if (!intercept) return tl::unexpected(intercept.error());
    slice.hasRescale = slope->has_value() || intercept->has_value();
    slice.slope = slope->value_or(1.0);
    slice.intercept = intercept->value_or(0.0);
    slice.rescaleType = shown(data.text(DCM_RescaleType));
    if (slice.slope != 0.0 && std::isfinite(slice.slope) && std::isfinite(slice.intercept)) return {};
    return fail(ErrorCode::Corrupt,
                fmt::format("{}: a rescale slope of {} and intercept of {} give no values",
                            slice.placement.name, slice.slope, slice.intercept));
}

/// Window centre and width as given (PS3.3 section C.11.2.1.2); the half value by which its LINEAR function
/// differs from LINEAR_EXACT is below what a window is set to.
void readWindows(DicomDataset& data, SliceHeader& slice) {
    const auto centres = data.decimals(DCM_WindowCenter);
    const auto widths = data.decimals(DCM_WindowWidth);
    if (!centres || !widths) return;  // A recommendation; the volume is right without it.
    const auto names = data.texts(DCM_WindowCenterWidthExplanation);
    for (std::size_t i = 0; i < std::min(centres->size(), widths->size()); ++i) {
        const Window window{(*centres)[i], (*widths)[i]};
        const bool usable = std::isfinite(window.level) && std::isfinite(window.width) && window.width > 0.0;
        const bool known = std::any_of(slice.windows.begin(), slice.windows.end(),
                                       [&](const NamedWindow& w) { return w.window == window; });
        if (!usable || known) continue;
        const bool named = i < names.size() && !names[i].empty();
        slice.windows.push_back(
            {named ? shown(names[i]) : fmt::format("File {}", slice.windows.size() + 1), window});
    }
}

}  // namespace

Result<DicomIdentity> identifyDicom(const std::filesystem::path& file) {
    auto data = DicomDataset::open(file, DicomDataset::Part::Header);
    if (!data) return tl::unexpected(data.error());
    return identityOf(*data, file);
}

Result<SliceHeader> readSliceHeader(const std::filesystem::path& file) {
    auto data = DicomDataset::open(file, DicomDataset::Part::Header);
    if (!data) return tl::unexpected(data.error());
    const DicomIdentity identity = identityOf(*data, file);
    if (identity.isDirectory || !identity.refusal.empty()) {
        return fail(
            ErrorCode::Unsupported,
            fmt::format("{}: {}", nameOf(file), identity.isDirectory ? "a DICOMDIR" : identity.refusal));
    }
    if (!identity.damage.empty()) {
        return fail(ErrorCode::Corrupt, fmt::format("{}: {}", nameOf(file), identity.damage));
    }
    SliceHeader slice;
    slice.file = file;
    slice.modality = identity.modality;
    slice.description = identity.description;
    slice.placement.name = nameOf(file);
    slice.placement.size = {data->number(DCM_Columns).value_or(0), data->number(DCM_Rows).value_or(0)};
    slice.photometric = data->text(DCM_PhotometricInterpretation);
    slice.paddingValue = shown(data->text(DCM_PixelPaddingValue));
    for (auto* read : {&readPixelFormat, &checkPixelBytes, &readPlacement, &readRescale}) {
        if (auto done = (*read)(*data, slice); !done) return tl::unexpected(done.error());
    }
    readWindows(*data, slice);
    return slice;
}

}  // namespace pellucid::io
