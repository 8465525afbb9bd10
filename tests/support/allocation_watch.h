// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pellucid::test {

/// Bytes of the largest block that any thread asked operator new for since the last reset. A program that
/// links allocation_watch.cpp has its operator new, and so have the shared libraries it uses.
[[nodiscard]] std::size_t largestAllocation();
void resetLargestAllocation();

}  // namespace pellucid::test
