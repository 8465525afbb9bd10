// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "scene/result.h"

namespace pellucid::accuracy {

/// Finished work in a file of JSON lines, one for each, so that a stopped report goes on where it was. Each
/// line carries the context it is valid in (scene, voxels, build, driver); lines of another context are kept
/// and not read.
class ReportStore {
public:
    /// Reads what is there; a last line that was cut off is passed over. Errors: Unreadable.
    static Result<ReportStore> open(const std::filesystem::path& file, const std::string& context);

    [[nodiscard]] const nlohmann::json* find(const std::string& key) const;
    /// Appends one line in one write. Errors: WriteFailed.
    [[nodiscard]] Result<void> add(const std::string& key, nlohmann::json value);

private:
    std::filesystem::path m_file;
    std::string m_context;
    std::map<std::string, nlohmann::json> m_found;
};

}  // namespace pellucid::accuracy
