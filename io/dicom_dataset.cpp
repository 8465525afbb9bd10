// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_dataset.h"

#include <dcmtk/dcmdata/dccodec.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/oflog.h>
#include <fmt/format.h>

#include <mutex>

#include "io/text_scan.h"

namespace pellucid::io {
namespace {

/// Values beyond this stay in the file until asked for; nothing asks for them but the decoder.
constexpr Uint32 kMaxValueBytes = 4096;

}  // namespace

Result<void> prepareDcmtk() {
    static std::once_flag once;
    std::call_once(once, [] {
        OFLog::configure(OFLogger::OFF_LOG_LEVEL);
        DcmRLEDecoderRegistration::registerCodecs();
        DJDecoderRegistration::registerCodecs();
        DJLSDecoderRegistration::registerCodecs();
    });
    if (dcmDataDict.isDictionaryLoaded()) return {};
    return fail(
        ErrorCode::Unreadable,
        "the DICOM data dictionary of DCMTK is not found (package libdcmtk17, or the variable DCMDICTPATH)");
}

std::string transferSyntaxName(const std::string& uid) {
    const DcmXfer syntax(uid.c_str());
    return syntax.getXfer() == EXS_Unknown ? shown(uid) : std::string(syntax.getXferName());
}

std::string sopClassName(const std::string& uid) {
    const char* name = dcmFindNameOfUID(uid.c_str());
    std::string text = name != nullptr ? name : fmt::format("SOP class \"{}\"", shown(uid));
    // DCMTK's keywords: "EnhancedCTImageStorage" reads better with spaces.
    for (std::size_t i = 1; name != nullptr && i < text.size(); ++i) {
        const bool startsWord = text[i] >= 'A' && text[i] <= 'Z';
        const bool afterSmall = text[i - 1] >= 'a' && text[i - 1] <= 'z';
        const bool beforeSmall = i + 1 < text.size() && text[i + 1] >= 'a' && text[i + 1] <= 'z';
        const bool afterSpace = text[i - 1] == ' ';
        if (startsWord && !afterSpace && (afterSmall || beforeSmall)) text.insert(i++, 1, ' ');
    }
    return text;
}

Result<DicomDataset> DicomDataset::open(const std::filesystem::path& file, Part part) {
    if (auto prepared = prepareDcmtk(); !prepared) return tl::unexpected(prepared.error());
    auto structure = inspectDicom(file);
    if (!structure) return tl::unexpected(structure.error());
    DicomDataset result;
    result.m_name = shown(file.filename().string());
    result.m_structure = *structure;
    result.m_file = std::make_unique<DcmFileFormat>();
    // inspectDicom looked no further than the pixel data either.
    const DcmTagKey stop = part == Part::Header ? DcmTagKey(0x7FE0, 0x0008) : DcmTagKey(0x7FE0, 0x0011);
    try {
        const OFCondition status = result.m_file->loadFileUntilTag(file.c_str(), EXS_Unknown, EGL_noChange,
                                                                   kMaxValueBytes, ERM_autoDetect, stop);
        if (status.good()) return result;
        return fail(ErrorCode::Corrupt, fmt::format("{}: not a readable DICOM file: {}", result.m_name,
                                                    shown(status.text(), 200)));
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, fmt::format("{}: {}", result.m_name, error.what()));
    }
}

std::string DicomDataset::transferSyntax() {
    if (!m_structure.transferSyntax.empty()) return m_structure.transferSyntax;
    return DcmXfer(dcmtk().getOriginalXfer()).getXferID();
}

bool DicomDataset::has(const DcmTagKey& tag) {
    return dcmtk().tagExistsWithValue(tag);
}

std::string DicomDataset::text(const DcmTagKey& tag) {
    OFString value;
    if (dcmtk().findAndGetOFString(tag, value).bad()) return {};
    return std::string(trimmed({value.c_str(), value.length()}));
}

std::string DicomDataset::localText(const DcmTagKey& tag) {
    std::string value = text(tag);
    OFString converted;
    DcmSpecificCharacterSet characters;
    OFString charset;
    dcmtk().findAndGetOFStringArray(DCM_SpecificCharacterSet, charset);
    if (characters.selectCharacterSet(charset).good() &&
        characters.convertString(OFString(value.c_str(), value.size()), converted).good()) {
        value.assign(converted.c_str(), converted.length());
    } else {
        value = shown(value);
    }
    std::erase_if(value, [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; });
    return value;
}

std::vector<std::string> DicomDataset::texts(const DcmTagKey& tag) {
    OFString all;
    if (dcmtk().findAndGetOFStringArray(tag, all).bad()) return {};
    std::vector<std::string> result;
    std::string_view rest(all.c_str(), all.length());
    while (!trimmed(rest).empty()) {
        const std::size_t end = rest.find('\\');
        result.emplace_back(trimmed(rest.substr(0, end)));
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    return result;
}

Result<std::vector<double>> DicomDataset::decimals(const DcmTagKey& tag) {
    std::vector<double> result;
    for (const std::string& value : texts(tag)) {
        const auto parsed = numberFrom<double>(value);
        if (!parsed) {
            return fail(ErrorCode::Corrupt, fmt::format("{}: {} holds \"{}\", which is no number", m_name,
                                                        DcmTag(tag).getTagName(), shown(value)));
        }
        result.push_back(*parsed);
    }
    return result;
}

Result<std::optional<double>> DicomDataset::decimal(const DcmTagKey& tag) {
    const auto values = decimals(tag);
    if (!values) return tl::unexpected(values.error());
    return values->empty() ? std::nullopt : std::optional(values->front());
}

std::optional<std::uint16_t> DicomDataset::number(const DcmTagKey& tag) {
    Uint16 value = 0;
    if (dcmtk().findAndGetUint16(tag, value).bad()) return std::nullopt;
    return value;
}

}  // namespace pellucid::io
