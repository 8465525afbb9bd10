// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/image_file.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string_view>

#include "io/text_scan.h"

namespace pellucid::io {

Result<ImageF> readImage(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return fail(ErrorCode::NotFound, fmt::format("{} could not be opened", shownPath(file)));
    std::array<char, 8> first{};
    stream.read(first.data(), first.size());
    const std::string_view start(first.data(), static_cast<std::size_t>(stream.gcount()));
    stream.close();

    if (start.starts_with("\x93NUMPY")) return readNpy(file);
    if (start.starts_with("PF") || start.starts_with("Pf")) return readPfm(file);
    if (!start.starts_with("\x89PNG")) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("{} is no picture that can be read: PNG, .npy and PFM are", shownPath(file)));
    }
    const auto png = readPng(file);
    if (!png) return tl::unexpected(png.error());
    ImageF image{png->size, {}};
    const std::size_t channels = static_cast<std::size_t>(png->channels);
    image.pixels.reserve(png->bytes.size() / channels);
    for (std::size_t at = 0; at < png->bytes.size(); at += channels) {
        const auto value = [&](std::size_t c) { return static_cast<float>(png->bytes[at + c]) / 255.0f; };
        image.pixels.emplace_back(value(0), value(1), value(2), channels == 4 ? value(3) : 1.0f);
    }
    return image;
}

}  // namespace pellucid::io
