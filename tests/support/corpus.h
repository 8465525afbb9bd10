// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>

namespace pellucid::test {

/// The optional larger test data. Tests on it are only registered where it is (PELLUCID_CORPUS_DIR of
/// tests/CMakeLists.txt), with PELLUCID_CORPUS in their environment.
[[nodiscard]] inline std::filesystem::path corpus() {
    const char* named = std::getenv("PELLUCID_CORPUS");
    return named != nullptr ? std::filesystem::path(named)
                            : std::filesystem::path(PELLUCID_SOURCE_DIR) / "../shared/data";
}

}  // namespace pellucid::test
