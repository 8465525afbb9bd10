// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scene/result.h"

namespace pellucid {

/// Parses hostile text. Errors: Corrupt with line and column for what is not JSON (RFC 8259; so also NaN,
/// 1e999 and bytes that are not UTF-8), InvalidArgument with the JSON pointer for a member given twice or
/// nesting deeper than 64.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text);

/// `pointer` with one more token, escaped (RFC 6901); tokens of more than 60 bytes are cut, so that errors
/// stay readable.
[[nodiscard]] std::string jsonPointer(std::string_view pointer, std::string_view token);

}  // namespace pellucid
