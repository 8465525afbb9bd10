// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/dicom_structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "io/dicom_bytes.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

/// Far beyond what standard objects nest (structured reports: about 15), far below what DCMTK's stack holds.
/// A sequence and its item are one each.
constexpr std::size_t kMaxNesting = 2 * 64;
constexpr std::uint64_t kMaxInflatedBytes = 1ull << 30;
constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
constexpr std::uint32_t kPixelData = 0x7FE00010;
constexpr std::uint32_t kItem = 0xFFFEE000;
constexpr std::uint32_t kItemEnd = 0xFFFEE00D;
constexpr std::uint32_t kSequenceEnd = 0xFFFEE0DD;

struct Encoding {
    bool implicitVr = false;
    bool bigEndian = false;
    bool deflated = false;
};

/// An open sequence or item.
struct Level {
    bool isItem = false;
    bool undefinedLength = false;
    bool implicitVr = false;
    std::uint64_t end =
        0;  ///< Where this, or else what it lies in, ends; ByteSource::kUnknown when nothing says.
};

struct Element {
    std::uint32_t tag = 0;
    std::string vr;  ///< Empty when implicit.
    std::uint32_t length = 0;
    std::uint64_t at = 0;  ///< Of the tag.
};

std::string tagText(std::uint32_t tag) {
    return fmt::format("({:04X},{:04X})", tag >> 16, tag & 0xFFFF);
}

// PS3.5 section 7.1.2: these have a 32-bit length after two reserved bytes, the others a 16-bit length.
bool hasLongLength(std::string_view vr) {
    constexpr std::array<std::string_view, 13> kLong{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                     "UC", "UN", "UR", "UT", "SV", "UV"};
    return std::find(kLong.begin(), kLong.end(), vr) != kLong.end();
}
bool hasShortLength(std::string_view vr) {
    constexpr std::array<std::string_view, 21> kShort{"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                      "FL", "FD", "IS", "LO", "LT", "PN", "SH",
                                                      "SL", "SS", "ST", "TM", "UI", "UL", "US"};
    return std::find(kShort.begin(), kShort.end(), vr) != kShort.end();
}

/// Layout by transfer syntax (PS3.5 annex A); nothing for one that is not known.
std::optional<Encoding> encodingOf(std::string_view syntax) {
    constexpr std::string_view kRoot = "1.2.840.10008.1.2";
    if (syntax == kRoot) return Encoding{true, false, false};
    if (!syntax.starts_with(kRoot)) return std::nullopt;
    const std::string_view rest = syntax.substr(kRoot.size());
    if (rest == ".1" || rest == ".1.98" || rest == ".5" || rest == ".8.1" || rest.starts_with(".4.")) {
        return Encoding{false, false, false};
    }
    if (rest == ".1.99") return Encoding{false, false, true};
    if (rest == ".2") return Encoding{false, true, false};
    return std::nullopt;
}

/// For files that do not say: the first element tells by a small group number and by letters where a VR would
/// be.
Encoding guessEncoding(std::span<const std::uint8_t> first) {
    const bool letters = first[4] >= 'A' && first[4] <= 'Z' && first[5] >= 'A' && first[5] <= 'Z';
    const bool bigEndian = first[0] == 0 && first[1] != 0;
    return Encoding{!letters, bigEndian, false};
}

class Walker {
public:
    Walker(ByteSource& source, Encoding encoding, std::string name)
        : m_source(source), m_encoding(encoding), m_name(std::move(name)) {}

    /// Walks from where the source is to the pixel data or the end.
    Result<void> walk(DicomStructure& result) {
        while (true) {
            closeFinished();
            const auto element = readElement();
            if (!element) return tl::unexpected(element.error());
            if (!*element) return {};
            if (m_levels.empty() && (*element)->tag >= 0x7FE00008) return finish(**element, result);
            if (auto stepped = enterOrSkip(**element); !stepped) return stepped;
        }
    }

    /// One element of the file meta information; nothing at the first of another group.
    Result<std::optional<Element>> metaElement() { return readElement(); }

private:
    tl::unexpected<Error> corrupt(std::string what) const {
        return fail(ErrorCode::Corrupt, fmt::format("{}: {}", m_name, what));
    }

    [[nodiscard]] std::uint64_t end() const {
        return m_levels.empty() ? m_source.size() : m_levels.back().end;
    }
    [[nodiscard]] bool implicitVr() const {
        return m_levels.empty() ? m_encoding.implicitVr : m_levels.back().implicitVr;
    }

    std::uint32_t number(const std::uint8_t* bytes, int count) const {
        std::uint32_t value = 0;
        for (int i = 0; i < count; ++i) value = value << 8 | bytes[m_encoding.bigEndian ? i : count - 1 - i];
        return value;
    }

    void closeFinished() {
        while (!m_levels.empty() && !m_levels.back().undefinedLength &&
               m_source.position() >= m_levels.back().end) {
            m_levels.pop_back();
        }
    }

    Result<std::optional<Element>> readElement() {
        std::array<std::uint8_t, 12> raw{};
        Element element;
        element.at = m_source.position();
        const std::size_t got = m_source.read(std::span(raw).first(8));
        const bool zeros = std::all_of(raw.begin(), raw.begin() + 8, [](std::uint8_t b) { return b == 0; });
        if (m_levels.empty() && zeros)
            return std::optional<Element>{};  // The end, or zeros that pad the file.
        if (got < 8 || (end() != ByteSource::kUnknown && element.at + 8 > end())) {
            return corrupt(fmt::format("truncated: it ends at byte {} inside {}", element.at + got,
                                       m_levels.empty() ? "an element" : "a sequence"));
        }
        element.tag = number(raw.data(), 2) << 16 | number(raw.data() + 2, 2);
        const bool delimiter = element.tag >> 16 == 0xFFFE;
        if (implicitVr() || delimiter) {
            element.length = number(raw.data() + 4, 4);
            return element;
        }
        element.vr.assign(reinterpret_cast<const char*>(raw.data()) + 4, 2);
        if (hasShortLength(element.vr)) {
            element.length = number(raw.data() + 6, 2);
            return element;
        }
        if (!hasLongLength(element.vr)) {
            return corrupt(fmt::format("element {} at byte {} has the unknown value representation \"{}\"",
                                       tagText(element.tag), element.at, shown(element.vr)));
        }
        if (m_source.read(std::span(raw).subspan(8, 4)) < 4) {
            return corrupt(fmt::format("truncated: it ends at byte {} inside element {}", m_source.position(),
                                       tagText(element.tag)));
        }
        element.length = number(raw.data() + 8, 4);
        return element;
    }

    Result<void> enterOrSkip(const Element& element) {
        if (element.tag >> 16 == 0xFFFE) return delimiter(element);
        if (!m_levels.empty() && !m_levels.back().isItem) {
            return corrupt(fmt::format("element {} at byte {} lies in a sequence outside its items",
                                       tagText(element.tag), element.at));
        }
        if (element.length == kUndefined) {
            if (element.vr == "OB" || element.vr == "OW") {
                std::uint64_t ignored = 0;
                return fragments(ignored);
            }
            if (!element.vr.empty() && element.vr != "SQ" && element.vr != "UN") {
                return corrupt(
                    fmt::format("element {} at byte {} has no length", tagText(element.tag), element.at));
            }
            // An unknown element without a length is an implicit-VR sequence (PS3.5 section 6.2.2).
            return push(element, false, implicitVr() || element.vr == "UN");
        }
        if (element.vr == "SQ") return push(element, false, implicitVr());
        if (element.vr.empty() && element.length >= 8) return enterIfItems(element);
        return skipValue(element);
    }

    Result<void> delimiter(const Element& element) {
        const bool inItem = !m_levels.empty() && m_levels.back().isItem;
        const bool inSequence = !m_levels.empty() && !m_levels.back().isItem;
        if (element.tag == kItem && inSequence) return push(element, true, m_levels.back().implicitVr);
        const bool closes =
            (element.tag == kItemEnd && inItem) || (element.tag == kSequenceEnd && inSequence);
        if (!closes || !m_levels.back().undefinedLength) {
            return corrupt(
                fmt::format("delimiter {} at byte {} where none belongs", tagText(element.tag), element.at));
        }
        m_levels.pop_back();
        return {};
    }

    Result<void> push(const Element& element, bool isItem, bool implicit) {
        if (m_levels.size() >= kMaxNesting) {
            return corrupt(
                fmt::format("sequences nest deeper than {} at byte {}", kMaxNesting / 2, element.at));
        }
        if (element.length == kUndefined) {
            m_levels.push_back({isItem, true, implicit, end()});
            return {};
        }
        if (auto fits = checkFits(element); !fits) return fits;
        m_levels.push_back({isItem, false, implicit, m_source.position() + element.length});
        return {};
    }

    /// Without a VR only the content tells a sequence of known length: it begins with an item.
    Result<void> enterIfItems(const Element& element) {
        if (auto fits = checkFits(element); !fits) return fits;
        const std::uint64_t start = m_source.position();
        std::array<std::uint8_t, 8> raw{};
        if (m_source.read(raw) < raw.size()) return tooShort(element, m_source.position() - start);
        const bool items = (number(raw.data(), 2) << 16 | number(raw.data() + 2, 2)) == kItem;
        if (!items) {
            const std::uint64_t rest = element.length - raw.size();
            const std::uint64_t skipped = m_source.skip(rest);
            return skipped == rest ? Result<void>{} : Result<void>(tooShort(element, raw.size() + skipped));
        }
        if (m_levels.size() >= kMaxNesting) return push(element, false, true);
        m_levels.push_back({false, false, true, start + element.length});
        return push({kItem, {}, number(raw.data() + 4, 4), start}, true, true);
    }

    tl::unexpected<Error> tooShort(const Element& element, std::uint64_t found) const {
        return corrupt(fmt::format("truncated: element {} at byte {} is to have {} bytes, and {} are there",
                                   tagText(element.tag), element.at, element.length, found));
    }

    Result<void> checkFits(const Element& element) const {
        if (end() == ByteSource::kUnknown) {
            if (m_source.position() + element.length <= kMaxInflatedBytes) return {};
            return fail(ErrorCode::TooLarge,
                        fmt::format("{}: inflates to more than {} bytes", m_name, kMaxInflatedBytes));
        }
        const std::uint64_t left = end() - std::min(end(), m_source.position());
        if (element.length > left) return tooShort(element, left);
        return {};
    }

    Result<void> skipValue(const Element& element) {
        if (auto fits = checkFits(element); !fits) return fits;
        const std::uint64_t skipped = m_source.skip(element.length);
        if (skipped < element.length) return tooShort(element, skipped);
        return {};
    }

    /// Encapsulated pixel data: an offset table, then fragments, then the end of the sequence.
    Result<void> fragments(std::uint64_t& bytes) {
        for (std::uint64_t index = 0;; ++index) {
            const std::uint64_t at = m_source.position();
            std::array<std::uint8_t, 8> raw{};
            if (m_source.read(raw) < raw.size()) {
                return corrupt(fmt::format("truncated: the compressed pixel data has no end at byte {}", at));
            }
            const Element element{
                number(raw.data(), 2) << 16 | number(raw.data() + 2, 2), {}, number(raw.data() + 4, 4), at};
            if (element.tag == kSequenceEnd) return {};
            if (element.tag != kItem || element.length == kUndefined) {
                return corrupt(fmt::format("{} at byte {} in compressed pixel data where a fragment belongs",
                                           tagText(element.tag), at));
            }
            if (auto skipped = skipValue(element); !skipped) return skipped;
            if (index > 0) bytes += element.length;
        }
    }

    Result<void> finish(const Element& element, DicomStructure& result) {
        result.hasPixelData =
            element.tag == 0x7FE00008 || element.tag == 0x7FE00009 || element.tag == kPixelData;
        if (element.tag != kPixelData) return {};
        if (element.length == kUndefined) {
            auto walked = fragments(result.pixelBytes);
            result.pixelBytesStated = result.pixelBytes;
            return walked;
        }
        if (m_source.size() == ByteSource::kUnknown) {
            if (auto fits = checkFits(element); !fits) return fits;
        }
        result.pixelBytesStated = element.length;
        result.pixelBytes = m_source.skip(element.length);
        return {};
    }

    ByteSource& m_source;
    Encoding m_encoding;
    std::string m_name;
    std::vector<Level> m_levels;
};

/// Reads group 0002 (always explicit, little endian) and leaves the source at the data set.
Result<void> readMeta(FileSource& source, const std::string& name, DicomStructure& result) {
    Walker walker(source, Encoding{}, name);
    std::array<std::uint8_t, 2> group{};
    while (true) {
        const std::uint64_t at = source.position();
        const bool meta = source.read(group) == 2 && group[0] == 2 && group[1] == 0;
        source.seek(at);
        if (!meta) return {};
        const auto element = walker.metaElement();
        if (!element) return tl::unexpected(element.error());
        if (!*element) return {};
        const std::uint64_t left = source.size() - source.position();
        if ((*element)->length > left) {
            return fail(
                ErrorCode::Corrupt,
                fmt::format("{}: truncated: element {} at byte {} is to have {} bytes, and {} are there",
                            name, tagText((*element)->tag), at, (*element)->length, left));
        }
        if ((*element)->tag == 0x00020010 && (*element)->length <= 64) {
            std::array<std::uint8_t, 64> uid{};
            const std::size_t count = source.read(std::span(uid).first((*element)->length));
            result.transferSyntax = trimmed({reinterpret_cast<const char*>(uid.data()), count});
        } else {
            source.skip((*element)->length);
        }
    }
}

}  // namespace

Result<DicomStructure> inspectDicom(const std::filesystem::path& file) {
    auto opened = FileSource::open(file);
    if (!opened) return tl::unexpected(opened.error());
    FileSource& source = **opened;
    const std::string name = shown(file.filename().string());
    DicomStructure result;
    result.fileBytes = source.size();
    std::array<std::uint8_t, 132> preamble{};
    const bool marked =
        source.read(preamble) == preamble.size() && std::memcmp(&preamble[128], "DICM", 4) == 0;
    source.seek(marked ? preamble.size() : 0);
    if (auto meta = readMeta(source, name, result); !meta) return tl::unexpected(meta.error());

    std::array<std::uint8_t, 8> first{};
    const std::uint64_t start = source.position();
    source.read(first);
    source.seek(start);
    const auto encoding =
        result.transferSyntax.empty() ? guessEncoding(first) : encodingOf(result.transferSyntax);
    if (!encoding) {
        return fail(ErrorCode::Unsupported, fmt::format("{}: the transfer syntax \"{}\" is not known", name,
                                                        shown(result.transferSyntax)));
    }
    InflateSource inflated(source);
    ByteSource& bytes = encoding->deflated ? static_cast<ByteSource&>(inflated) : source;
    if (auto walked = Walker(bytes, *encoding, name).walk(result); !walked)
        return tl::unexpected(walked.error());
    // Whole pixel data is enough; before it, a damaged stream looks like an early end.
    if (encoding->deflated && !result.hasPixelData && inflated.isDamaged()) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: its deflated data is damaged or truncated at byte {} of {}", name,
                                source.position(), result.fileBytes));
    }
    return result;
}

}  // namespace pellucid::io
