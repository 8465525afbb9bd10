// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/resources.h"

#include <fmt/format.h>

namespace pellucid::app {

namespace fs = std::filesystem;

Result<fs::path> sampleScene() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    const fs::path installed = program.parent_path().parent_path() / "share" / "pellucid";
    const fs::path source = PELLUCID_SOURCE_RESOURCES;
    for (const fs::path& resources : {installed, source}) {
        const fs::path sample = resources / "sample" / "sample.json";
        if (fs::is_regular_file(sample, ignored)) return sample;
    }
    return fail(ErrorCode::NotFound,
                fmt::format("the sample scan is not where it belongs: {} or {}",
                            (installed / "sample").string(), (source / "sample").string()));
}

}  // namespace pellucid::app
