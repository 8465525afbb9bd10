// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/synthetic_dicom.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>

namespace pellucid::test {
namespace {

constexpr std::uint32_t kPixelData = 0x7FE00010;

void appendNumber(std::string& out, std::uint64_t value, int bytes, bool big) {
    for (int i = 0; i < bytes; ++i) {
        const int shift = 8 * (big ? bytes - 1 - i : i);
        out.push_back(static_cast<char>(value >> shift & 0xFF));
    }
}

std::string swapped(std::string bytes, int width) {
    for (std::size_t at = 0; width > 1 && at + static_cast<std::size_t>(width) <= bytes.size();
         at += static_cast<std::size_t>(width)) {
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at) + width);
    }
    return bytes;
}

void appendElement(std::string& out, std::uint32_t tag, std::string_view vr, const std::string& bytes,
                   bool explicitVr, bool big) {
    appendNumber(out, tag >> 16, 2, big);
    appendNumber(out, tag & 0xFFFF, 2, big);
    if (!explicitVr) {
        appendNumber(out, bytes.size(), 4, big);
    } else if (vr == "OB" || vr == "OW" || vr == "SQ" || vr == "UN") {
        out += vr;
        out += std::string(2, '\0');
        appendNumber(out, bytes.size(), 4, big);
    } else {
        out += vr;
        appendNumber(out, bytes.size(), 2, big);
    }
    out += bytes;
}

std::string padded(std::string text, char pad) {
    if (text.size() % 2 == 1) text.push_back(pad);
    return text;
}

std::string_view transferSyntax(DicomEncoding encoding) {
    switch (encoding) {
        case DicomEncoding::ImplicitLittle:
            return "1.2.840.10008.1.2";
        case DicomEncoding::ExplicitBig:
            return "1.2.840.10008.1.2.2";
        case DicomEncoding::ExplicitLittle:
            break;
    }
    return "1.2.840.10008.1.2.1";
}

}  // namespace

void SyntheticFile::setText(std::uint32_t tag, std::string_view vr, std::string text) {
    m_elements[tag] = {std::string(vr), padded(std::move(text), vr == "UI" ? '\0' : ' '), 1};
}

void SyntheticFile::setShort(std::uint32_t tag, std::uint16_t value) {
    std::string bytes;
    appendNumber(bytes, value, 2, false);
    m_elements[tag] = {"US", bytes, 2};
}

void SyntheticFile::setSequence(std::uint32_t tag, std::string content) {
    m_elements[tag] = {"SQ", std::move(content), 1};
}

void SyntheticFile::setPixels(std::vector<std::uint8_t> littleEndian, int bytesPerPixel) {
    m_elements[kPixelData] = {bytesPerPixel == 1 ? "OB" : "OW",
                              padded(std::string(littleEndian.begin(), littleEndian.end()), '\0'),
                              bytesPerPixel};
}

std::string SyntheticFile::encoded(DicomEncoding encoding) const {
    std::string meta;
    if (const auto sopClass = m_elements.find(0x00080016); sopClass != m_elements.end()) {
        appendElement(meta, 0x00020002, "UI", sopClass->second.bytes, true, false);
    }
    appendElement(meta, 0x00020010, "UI", padded(std::string(transferSyntax(encoding)), '\0'), true, false);
    std::string length;
    appendNumber(length, meta.size(), 4, false);
    std::string file(128, '\0');
    file += "DICM";
    appendElement(file, 0x00020000, "UL", length, true, false);
    file += meta;
    const bool big = encoding == DicomEncoding::ExplicitBig;
    for (const auto& [tag, value] : m_elements) {
        appendElement(file, tag, value.vr, big ? swapped(value.bytes, value.wordBytes) : value.bytes,
                      encoding != DicomEncoding::ImplicitLittle, big);
    }
    return file;
}

void SyntheticFile::write(const std::filesystem::path& file, DicomEncoding encoding) const {
    const std::string bytes = encoded(encoding);
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string decimalText(std::initializer_list<double> values) {
    std::string text;
    for (const double value : values) {
        // DS holds at most 16 characters.
        std::string part = fmt::format("{:.12g}", value);
        if (part.size() > 16) part = fmt::format("{:.9g}", value);
        text += (text.empty() ? "" : "\\") + part;
    }
    return text;
}

SyntheticFile makeSlice(const SyntheticSeries& s, int k) {
    SyntheticFile file;
    file.setText(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
    file.setText(0x00080018, "UI", fmt::format("{}.{}", s.seriesUid, k + 1));
    file.setText(0x00080060, "CS", "CT");
    file.setText(0x0008103E, "LO", s.description);
    file.setText(0x00180050, "DS", "99");  // Nothing may take this for the distance between slices.
    file.setText(0x0020000D, "UI", "1.2.3.4");
    file.setText(0x0020000E, "UI", s.seriesUid);
    file.setText(0x00200013, "IS", std::to_string(s.slices - k));
    const glm::dvec3 p = s.originMm + static_cast<double>(k) * s.stepMm;
    const glm::dvec3& r = s.rowDirection;
    const glm::dvec3& c = s.columnDirection;
    file.setText(0x00200032, "DS", decimalText({p.x, p.y, p.z}));
    file.setText(0x00200037, "DS", decimalText({r.x, r.y, r.z, c.x, c.y, c.z}));
    file.setShort(0x00280002, 1);
    file.setText(0x00280004, "CS", "MONOCHROME2");
    file.setShort(0x00280010, static_cast<std::uint16_t>(s.size.y));
    file.setShort(0x00280011, static_cast<std::uint16_t>(s.size.x));
    file.setText(0x00280030, "DS", decimalText({s.spacingMm.y, s.spacingMm.x}));
    file.setShort(0x00280100, static_cast<std::uint16_t>(s.bitsAllocated));
    file.setShort(0x00280101, static_cast<std::uint16_t>(s.bitsStored));
    file.setShort(0x00280102, static_cast<std::uint16_t>(s.highBit));
    file.setShort(0x00280103, s.isSigned ? 1 : 0);
    file.setText(0x00281052, "DS", decimalText({s.intercept}));
    file.setText(0x00281053, "DS", decimalText({s.slope}));
    const int bytes = s.bitsAllocated / 8;
    std::string pixels;
    for (int j = 0; j < s.size.y; ++j) {
        for (int i = 0; i < s.size.x; ++i) {
            const std::uint64_t mask = (1ull << s.bitsStored) - 1;
            const auto bits = static_cast<std::uint64_t>(s.value(i, j, k)) & mask;
            appendNumber(pixels, bits << (s.highBit + 1 - s.bitsStored), bytes, false);
        }
    }
    file.setPixels({pixels.begin(), pixels.end()}, bytes);
    if (s.edit) s.edit(file, k);
    return file;
}

std::vector<std::filesystem::path> writeSeries(const SyntheticSeries& series,
                                               const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::vector<std::filesystem::path> files;
    for (int k = 0; k < series.slices; ++k) {
        files.push_back(
            folder / (series.fileName ? series.fileName(k) : fmt::format("im{:03}.dcm", series.slices - k)));
        makeSlice(series, k).write(files.back(), series.encoding);
    }
    return files;
}

TemporaryFolder::TemporaryFolder() {
    static std::atomic<int> counter{0};
    m_path = std::filesystem::temp_directory_path() / fmt::format("pellucid-{}-{}", ::getpid(), counter++);
    std::filesystem::create_directories(m_path);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

}  // namespace pellucid::test
