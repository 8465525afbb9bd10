// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <string>

namespace pellucid {

/// Prints the text and aborts. For broken contracts (a programmer's mistake), never for input.
[[noreturn]] void contractBroken(const char* file, int line, const std::string& what);

}  // namespace pellucid

#define PELLUCID_CHECK(condition)                                                     \
    do {                                                                              \
        if (!(condition)) ::pellucid::contractBroken(__FILE__, __LINE__, #condition); \
    } while (false)

/// Aborts with both values shown unless a == b.
#define PELLUCID_CHECK_EQ(a, b)                                                                         \
    do {                                                                                                \
        const auto& checkA = (a);                                                                       \
        const auto& checkB = (b);                                                                       \
        if (!(checkA == checkB))                                                                        \
            ::pellucid::contractBroken(__FILE__, __LINE__,                                              \
                                       fmt::format("{} == {}: {} against {}", #a, #b, checkA, checkB)); \
    } while (false)
