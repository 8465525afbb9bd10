// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "scene/result.h"

namespace pellucid::io {

/// Writes the bytes to a temporary name beside `file`, flushes, and renames: the file is whole or untouched.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Reads a whole file. Errors: NotFound, Unreadable, TooLarge when it has more than `maxBytes`.
[[nodiscard]] Result<std::vector<std::byte>> readFile(const std::filesystem::path& file,
                                                      std::uint64_t maxBytes = 1ull << 30);

}  // namespace pellucid::io
