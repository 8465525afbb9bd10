// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

namespace pellucid::io {

inline constexpr bool kNativeIsBig = std::endian::native == std::endian::big;

/// Turns the bytes of each `width`-byte item round in place. Precondition: bytes.size() is a multiple of
/// width.
inline void swapBytes(std::span<std::byte> bytes, std::size_t width) {
    if (width < 2) return;
    for (std::size_t at = 0; at < bytes.size(); at += width) {
        std::reverse(bytes.data() + at, bytes.data() + at + width);
    }
}

/// A number of type T at a byte offset. Precondition: offset + sizeof(T) <= bytes.size().
template <class T>
[[nodiscard]] T valueAt(std::span<const std::byte> bytes, std::size_t offset, bool bigEndian) {
    std::byte raw[sizeof(T)];
    std::memcpy(raw, bytes.data() + offset, sizeof(T));
    if (bigEndian != kNativeIsBig) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
}

}  // namespace pellucid::io
