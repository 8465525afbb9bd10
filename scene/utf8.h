// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace pellucid {

/// True for well-formed UTF-8 (Unicode 15, table 3-7: no overlong forms, no surrogates, nothing above
/// U+10FFFF).
[[nodiscard]] bool isUtf8(std::string_view text);

}  // namespace pellucid
