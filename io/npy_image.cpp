// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The .npy format: numpy.lib.format, version 1.0 to 3.0 (NEP 1). Only float32 pictures, shape (height, width,
// 3 or 4).
#include <fmt/format.h>

#include <cstring>
#include <string_view>

#include "io/atomic_file.h"
#include "io/byte_order.h"
#include "io/image_file.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr int kMaxSide = 1 << 20;

struct NpyHeader {
    bool bigEndian = false;
    glm::ivec2 size{0, 0};
    int channels = 4;
    std::size_t dataOffset = 0;
};

/// The value of 'key' in the header's dictionary literal, up to the next comma outside parentheses.
std::string_view member(std::string_view dictionary, std::string_view key) {
    const std::size_t at = dictionary.find(fmt::format("'{}':", key));
    if (at == std::string_view::npos) return {};
    const std::string_view rest = dictionary.substr(at + key.size() + 3);
    int depth = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        if (rest[i] == '(') ++depth;
        if (rest[i] == ')') --depth;
        if (depth == 0 && (rest[i] == ',' || rest[i] == '}')) return trimmed(rest.substr(0, i));
    }
    return {};
}

/// "(480, 640, 4)" as numbers; empty when it is not a tuple of positive integers.
std::vector<int> shapeFrom(std::string_view text) {
    if (text.size() < 2 || text.front() != '(' || text.back() != ')') return {};
    text = text.substr(1, text.size() - 2);
    std::vector<int> shape;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto number = numberFrom<int>(trimmed(text.substr(0, comma)));
        if (!number || *number < 1 || *number > kMaxSide) return {};
        shape.push_back(*number);
        text = comma < text.size() ? trimmed(text.substr(comma + 1)) : std::string_view{};
    }
    return shape;
}

Result<NpyHeader> parseHeader(std::span<const std::byte> bytes, const std::string& name) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with(kMagic) || bytes.size() < 12) {
        return fail(ErrorCode::Corrupt, fmt::format("{} is not a .npy file", name));
    }
    const int version = std::to_integer<int>(bytes[6]);
    if (version < 1 || version > 3) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} is .npy version {}; 1 to 3 are read", name, version));
    }
    const std::size_t start = version == 1 ? 10 : 12;
    const std::size_t length =
        version == 1 ? valueAt<std::uint16_t>(bytes, 8, false) : valueAt<std::uint32_t>(bytes, 8, false);
    if (length > bytes.size() - start) {
        return fail(ErrorCode::Corrupt, fmt::format("{}: the header states {} bytes, the file has {} left",
                                                    name, length, bytes.size() - start));
    }
    const std::string_view dictionary = text.substr(start, length);
    const std::string_view type = member(dictionary, "descr");
    const std::vector<int> shape = shapeFrom(member(dictionary, "shape"));
    NpyHeader header;
    header.dataOffset = start + length;
    header.bigEndian = type == "'>f4'";
    if (type != "'<f4'" && type != "'>f4'") {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}: element type {}; float32 ('<f4') is read", name, shown(type)));
    }
    if (member(dictionary, "fortran_order") != "False") {
        return fail(ErrorCode::Unsupported, fmt::format("{}: Fortran order; C order is read", name));
    }
    if (shape.size() != 3 || (shape[2] != 3 && shape[2] != 4)) {
        return fail(ErrorCode::Unsupported, fmt::format("{}: shape {}; (height, width, 3 or 4) is read", name,
                                                        shown(member(dictionary, "shape"))));
    }
    header.size = {shape[1], shape[0]};
    header.channels = shape[2];
    return header;
}

}  // namespace

Result<void> writeNpy(const std::filesystem::path& file, const ImageF& image) {
    std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, 4), }}",
                                     image.size.y, image.size.x);
    // Data starts at a multiple of 64 bytes, and the header ends with a line feed (NEP 1).
    header.append(63 - (kMagic.size() + 4 + header.size()) % 64, ' ');
    header += '\n';
    std::string start(kMagic);
    start += {1, 0, static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
    start += header;
    std::vector<std::byte> bytes(start.size() + image.pixels.size() * sizeof(glm::vec4));
    std::memcpy(bytes.data(), start.data(), start.size());
    std::memcpy(bytes.data() + start.size(), image.pixels.data(), image.pixels.size() * sizeof(glm::vec4));
    if (kNativeIsBig) swapBytes(std::span(bytes).subspan(start.size()), sizeof(float));
    return writeFile(file, bytes);
}

Result<ImageF> readNpy(const std::filesystem::path& file) {
    const auto bytes = readFile(file, 16ull << 30);
    if (!bytes) return tl::unexpected(bytes.error());
    const auto header = parseHeader(*bytes, shownPath(file));
    if (!header) return tl::unexpected(header.error());
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(header->size.x) * static_cast<std::uint64_t>(header->size.y);
    const std::uint64_t wanted = pixels * static_cast<std::uint64_t>(header->channels) * sizeof(float);
    const std::uint64_t found = bytes->size() - header->dataOffset;
    if (found != wanted) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("{}: expected {}x{}x{} float32 = {} bytes after the header, found {}",
                        shownPath(file), header->size.y, header->size.x, header->channels, wanted, found));
    }
    ImageF image{header->size, std::vector<glm::vec4>(pixels, glm::vec4(1.0f))};
    std::size_t at = header->dataOffset;
    for (glm::vec4& pixel : image.pixels) {
        for (int c = 0; c < header->channels; ++c, at += sizeof(float))
            pixel[c] = valueAt<float>(*bytes, at, header->bigEndian);
    }
    return image;
}

}  // namespace pellucid::io
