// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/utf8.h"

#include <cstddef>

namespace pellucid {

namespace {

/// Bytes of the well-formed sequence at the start of `text`; 0 when there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
    const unsigned lead = byte(0);
    if (lead < 0x80u) return 1;
    if (lead >= 0xC2u && lead <= 0xDFu) return continues(1) ? 2 : 0;
    if (lead >= 0xE0u && lead <= 0xEFu) {
        if (!continues(1) || !continues(2)) return 0;
        if (lead == 0xE0u && byte(1) < 0xA0u) return 0;  // Overlong.
        if (lead == 0xEDu && byte(1) > 0x9Fu) return 0;  // Surrogate.
        return 3;
    }
    if (lead >= 0xF0u && lead <= 0xF4u) {
        if (!continues(1) || !continues(2) || !continues(3)) return 0;
        if (lead == 0xF0u && byte(1) < 0x90u) return 0;  // Overlong.
        if (lead == 0xF4u && byte(1) > 0x8Fu) return 0;  // Beyond U+10FFFF.
        return 4;
    }
    return 0;
}

}  // namespace

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

}  // namespace pellucid
