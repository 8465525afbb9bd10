// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scene/image.h"
#include "scene/result.h"

namespace pellucid::io {

/// PNG, RGB or RGBA, 8 bits. Written under a temporary name and renamed, like every file this program writes.
[[nodiscard]] Result<void> writePng(const std::filesystem::path& file, const Image8& image);
[[nodiscard]] Result<Image8> readPng(const std::filesystem::path& file);

/// NumPy .npy, float32, shape (height, width, 4), row 0 at the top.
[[nodiscard]] Result<void> writeNpy(const std::filesystem::path& file, const ImageF& image);
[[nodiscard]] Result<ImageF> readNpy(const std::filesystem::path& file);

/// Portable float map ("PF", RGB, little endian, bottom row first as the format wants). A is not stored;
/// reads back as 1.
[[nodiscard]] Result<void> writePfm(const std::filesystem::path& file, const ImageF& image);
[[nodiscard]] Result<ImageF> readPfm(const std::filesystem::path& file);

/// Any of the three by content; PNG becomes value / 255.
[[nodiscard]] Result<ImageF> readImage(const std::filesystem::path& file);

}  // namespace pellucid::io
