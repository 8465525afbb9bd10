// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Teem, "Definition of NRRD File Format", sections 3 to 5.
#include "io/nrrd_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/text_scan.h"

namespace pellucid::io {
namespace {

/// Section 5: every field, with the spellings of older files.
constexpr std::array<std::pair<std::string_view, std::string_view>, 42> kFields{
    {{"dimension", "dimension"},
     {"type", "type"},
     {"block size", "block size"},
     {"blocksize", "block size"},
     {"encoding", "encoding"},
     {"endian", "endian"},
     {"content", "content"},
     {"min", "min"},
     {"max", "max"},
     {"old min", "old min"},
     {"oldmin", "old min"},
     {"old max", "old max"},
     {"oldmax", "old max"},
     {"data file", "data file"},
     {"datafile", "data file"},
     {"line skip", "line skip"},
     {"lineskip", "line skip"},
     {"byte skip", "byte skip"},
     {"byteskip", "byte skip"},
     {"number", "number"},
     {"sample units", "sample units"},
     {"sampleunits", "sample units"},
     {"space", "space"},
     {"space dimension", "space dimension"},
     {"space units", "space units"},
     {"space origin", "space origin"},
     {"space directions", "space directions"},
     {"measurement frame", "measurement frame"},
     {"sizes", "sizes"},
     {"spacings", "spacings"},
     {"thicknesses", "thicknesses"},
     {"axis mins", "axis mins"},
     {"axismins", "axis mins"},
     {"axis maxs", "axis maxs"},
     {"axismaxs", "axis maxs"},
     {"centerings", "centerings"},
     {"centers", "centerings"},
     {"labels", "labels"},
     {"units", "units"},
     {"kinds", "kinds"},
     {"index", "index"},
     {"dimensions", "dimension"}}};

std::string_view canonicalField(std::string_view name) {
    const std::string low = lowered(name);
    const auto* row =
        std::find_if(kFields.begin(), kFields.end(), [&](const auto& r) { return r.first == low; });
    return row == kFields.end() ? std::string_view{} : row->second;
}

Result<void> addLine(NrrdHeader& header, std::string_view line, int number) {
    if (line.starts_with('#')) return {};
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
        return fail(ErrorCode::Corrupt, fmt::format("header line {}: '{}' is neither a field nor a comment",
                                                    number, shown(line)));
    }
    if (line.substr(colon).starts_with(":="))
        return {};  // key/value pairs say nothing about placement or values
    const std::string_view name = canonicalField(trimmed(line.substr(0, colon)));
    if (name.empty()) {
        return fail(ErrorCode::Corrupt, fmt::format("header line {}: '{}' is no NRRD field", number,
                                                    shown(line.substr(0, colon))));
    }
    if (!header.fields.emplace(name, trimmed(line.substr(colon + 1))).second) {
        return fail(ErrorCode::Corrupt, fmt::format("header line {}: '{}' stands twice", number, name));
    }
    return {};
}

}  // namespace

std::string_view NrrdHeader::field(const std::string& name) const {
    const auto it = fields.find(name);
    return it == fields.end() ? std::string_view{} : std::string_view(it->second);
}

Result<NrrdHeader> parseNrrdHeader(std::string_view text) {
    NrrdHeader header;
    if (text.size() < 9 || !text.starts_with("NRRD000") || text[7] < '1' || text[7] > '5') {
        return fail(ErrorCode::Unsupported,
                    fmt::format("the file begins with '{}'; NRRD0001 to NRRD0005 are read",
                                shown(text.substr(0, 8))));
    }
    header.version = text[7] - '0';
    std::size_t at = 0;
    for (int number = 1; at < text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        at = std::min(end + 1, text.size());
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty()) {
            header.endsWithBlankLine = true;
            break;
        }
        if (number == 1) continue;
        if (const auto added = addLine(header, line, number); !added) return tl::unexpected(added.error());
        // "data file: LIST" is followed by file names up to the end of the file.
        if (header.field("data file").starts_with("LIST")) break;
    }
    header.bytes = at;
    return header;
}

}  // namespace pellucid::io
