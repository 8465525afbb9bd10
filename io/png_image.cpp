// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <png.h>

#include <cstring>

#include "io/atomic_file.h"
#include "io/image_file.h"
#include "io/text_scan.h"

namespace pellucid::io {
namespace {

/// Deflate expands at most 1032 times (zlib's technical notes), and a PNG row costs nothing else.
constexpr std::uint64_t kDeflateMax = 1032;

/// Frees what libpng's simplified API holds on every way out.
struct PngImage {
    png_image image{};
    PngImage() { image.version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(&image); }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

Result<void> writePng(const std::filesystem::path& file, const Image8& image) {
    const std::uint64_t wanted = static_cast<std::uint64_t>(std::max(image.size.x, 0)) *
                                 static_cast<std::uint64_t>(std::max(image.size.y, 0)) *
                                 static_cast<std::uint64_t>(std::max(image.channels, 0));
    if (image.size.x < 1 || image.size.y < 1 || (image.channels != 3 && image.channels != 4) ||
        image.bytes.size() != wanted) {
        return fail(ErrorCode::InvalidArgument,
                    fmt::format("a picture of {}x{} pixels with {} channels and {} bytes cannot be a PNG",
                                image.size.x, image.size.y, image.channels, image.bytes.size()));
    }
    PngImage png;
    png.image.width = static_cast<png_uint_32>(image.size.x);
    png.image.height = static_cast<png_uint_32>(image.size.y);
    png.image.format = image.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.image);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&png.image, bytes.data(), &size, 0, image.bytes.data(), 0, nullptr) == 0) {
        return fail(ErrorCode::WriteFailed,
                    fmt::format("{} could not be encoded as PNG: {}", shownPath(file), png.image.message));
    }
    bytes.resize(size);
    return writeFile(file, bytes);
}

Result<Image8> readPng(const std::filesystem::path& file) {
    const auto bytes = readFile(file);
    if (!bytes) return tl::unexpected(bytes.error());
    PngImage png;
    if (png_image_begin_read_from_memory(&png.image, bytes->data(), bytes->size()) == 0) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{} is not a PNG that can be read: {}", shownPath(file), png.image.message));
    }
    const bool alpha = (png.image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    png.image.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    Image8 image;
    image.channels = alpha ? 4 : 3;
    // One bit a pixel is the least a PNG stores.
    const std::uint64_t pixels = static_cast<std::uint64_t>(png.image.width) * png.image.height;
    if (pixels / 8 > bytes->size() * kDeflateMax) {
        return fail(ErrorCode::Corrupt,
                    fmt::format("{} states {}x{} pixels, more than its {} bytes can hold", shownPath(file),
                                png.image.width, png.image.height, bytes->size()));
    }
    image.size = {static_cast<int>(png.image.width), static_cast<int>(png.image.height)};
    image.bytes.resize(pixels * static_cast<std::uint64_t>(image.channels));
    if (png_image_finish_read(&png.image, nullptr, image.bytes.data(), 0, nullptr) == 0) {
        return fail(ErrorCode::Corrupt, fmt::format("{} is damaged: {}", shownPath(file), png.image.message));
    }
    return image;
}

}  // namespace pellucid::io
