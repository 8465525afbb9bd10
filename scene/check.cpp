// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/check.h"

#include <cstdio>
#include <cstdlib>

namespace pellucid {

void contractBroken(const char* file, int line, const std::string& what) {
    // The one place of this room that prints: nobody is left to hand a value to.
    std::fputs(fmt::format("{}:{}: contract broken: {}\n", file, line, what).c_str(), stderr);
    std::abort();
}

}  // namespace pellucid
