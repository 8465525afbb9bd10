// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "scene/utf8.h"

namespace pellucid::io {

/// Without white space (and NUL) at both ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace(" \t\r\n\v\f\0", 7);
    const std::size_t first = text.find_first_not_of(kSpace);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// ASCII lower case, whatever the locale.
[[nodiscard]] inline std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// The words between white space.
[[nodiscard]] inline std::vector<std::string_view> words(std::string_view text) {
    constexpr std::string_view kSpace(" \t\r\n\v\f\0", 7);
    std::vector<std::string_view> result;
    std::size_t at = 0;
    while ((at = text.find_first_not_of(kSpace, at)) != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(kSpace, at), text.size());
        result.push_back(text.substr(at, end - at));
        at = end;
    }
    return result;
}

/// The whole text as one number, whatever the locale; nothing when anything else is there or it overflows.
template <class Number>
[[nodiscard]] std::optional<Number> numberFrom(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
    return value;
}

/// At most `most` characters for an error message; bytes that are not printable ASCII become '?'.
[[nodiscard]] inline std::string shown(std::string_view text, std::size_t most = 60) {
    std::string result(text.substr(0, most));
    for (char& c : result) {
        if (c < 0x20 || c > 0x7e) c = '?';
    }
    if (text.size() > most) result += "...";
    return result;
}

/// A path for an error message: as it is where that is printable UTF-8, else with '?' for the bytes that are
/// not.
[[nodiscard]] inline std::string shownPath(const std::filesystem::path& path) {
    const std::string& text = path.native();
    const bool printable = isUtf8(text) && std::none_of(text.begin(), text.end(), [](char c) {
                               return (c >= 0 && c < 0x20) || c == 0x7f;
                           });
    return printable ? text : shown(text, 4096);
}

}  // namespace pellucid::io
