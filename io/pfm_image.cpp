// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Portable float map (P. Debevec): "PF" colour or "Pf" grey, width, height, scale; the sign of the scale is
// the byte order.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <string_view>

#include "io/atomic_file.h"
#include "io/byte_order.h"
#include "io/image_file.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

constexpr int kMaxSide = 1 << 20;

struct PfmHeader {
    glm::ivec2 size{0, 0};
    int channels = 3;
    bool bigEndian = false;
    std::size_t dataOffset = 0;
};

Result<PfmHeader> parseHeader(std::string_view text, const std::string& name) {
    // Four words, then exactly one white-space byte, then data that may itself look like white space.
    std::string_view word[4];
    std::size_t at = 0;
    for (std::string_view& w : word) {
        at = text.find_first_not_of(" \t\r\n", at);
        if (at == std::string_view::npos)
            return fail(ErrorCode::Corrupt, fmt::format("{}: the PFM header is cut off", name));
        const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
        w = text.substr(at, std::min<std::size_t>(end - at, 64));
        at = end;
    }
    PfmHeader header;
    header.channels = word[0] == "PF" ? 3 : 1;
    header.dataOffset = std::min(at + 1, text.size());
    if (word[0] != "PF" && word[0] != "Pf")
        return fail(ErrorCode::Corrupt, fmt::format("{} is not a PFM file", name));
    const auto width = numberFrom<int>(word[1]);
    const auto height = numberFrom<int>(word[2]);
    const auto scale = numberFrom<double>(word[3]);
    if (!width || !height || *width < 1 || *height < 1 || *width > kMaxSide || *height > kMaxSide) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{}: the size is '{} {}'; two positive integers are allowed", name,
                                shown(word[1]), shown(word[2])));
    }
    if (!scale || std::abs(*scale) != 1.0) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{}: the scale is '{}'; 1 and -1 are read", name, shown(word[3])));
    }
    header.size = {*width, *height};
    header.bigEndian = *scale > 0.0;
    return header;
}

}  // namespace

Result<void> writePfm(const std::filesystem::path& file, const ImageF& image) {
    const std::string start = fmt::format("PF\n{} {}\n-1.0\n", image.size.x, image.size.y);
    const std::size_t count = image.pixels.size() * 3;
    std::vector<std::byte> bytes(start.size() + count * sizeof(float));
    std::memcpy(bytes.data(), start.data(), start.size());
    std::byte* out = bytes.data() + start.size();
    for (int y = image.size.y - 1; y >= 0; --y) {
        for (int x = 0; x < image.size.x; ++x, out += 3 * sizeof(float))
            std::memcpy(out, &image.at(x, y), 3 * sizeof(float));
    }
    if (kNativeIsBig) swapBytes(std::span(bytes).subspan(start.size()), sizeof(float));
    return writeFile(file, bytes);
}

Result<ImageF> readPfm(const std::filesystem::path& file) {
    const auto bytes = readFile(file, 16ull << 30);
    if (!bytes) return tl::unexpected(bytes.error());
    const auto header =
        parseHeader({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, shownPath(file));
    if (!header) return tl::unexpected(header.error());
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(header->size.x) * static_cast<std::uint64_t>(header->size.y);
    const std::uint64_t wanted = pixels * static_cast<std::uint64_t>(header->channels) * sizeof(float);
    const std::uint64_t found = bytes->size() - header->dataOffset;
    if (found != wanted) {
        return fail(
            ErrorCode::Corrupt,
            fmt::format("{}: expected {}x{}x{} float32 = {} bytes after the header, found {}",
                        shownPath(file), header->size.x, header->size.y, header->channels, wanted, found));
    }
    ImageF image{header->size, std::vector<glm::vec4>(pixels, glm::vec4(1.0f))};
    std::size_t at = header->dataOffset;
    for (int y = image.size.y - 1; y >= 0; --y) {
        for (int x = 0; x < image.size.x; ++x) {
            glm::vec4& pixel = image.at(x, y);
            for (int c = 0; c < header->channels; ++c, at += sizeof(float))
                pixel[c] = valueAt<float>(*bytes, at, header->bigEndian);
            if (header->channels == 1) pixel = {pixel.x, pixel.x, pixel.x, 1.0f};
        }
    }
    return image;
}

}  // namespace pellucid::io
