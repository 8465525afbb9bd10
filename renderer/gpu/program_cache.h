// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>

#include "renderer/gpu/gl_program.h"

namespace pellucid::renderer {

/// Programs by their text: in memory, and as driver binaries in the user's cache folder
/// ($XDG_CACHE_HOME/pellucid/programs, nowhere when neither it nor HOME is set). A file holds the whole text
/// and the driver's name, so a wrong one is never used; the folder is a cache, failing to write it is no
/// error.
class ProgramCache {
public:
    ProgramCache();

    struct Found {
        const GlProgram* program = nullptr;  ///< Valid as long as the cache.
        enum class Origin { Memory, Disk, Compiled } origin = Origin::Memory;
    };
    /// Errors: as GlProgram::compile.
    [[nodiscard]] Result<Found> find(const ShaderText& text);

private:
    [[nodiscard]] std::filesystem::path fileOf(const std::string& key) const;
    void store(const std::string& key, const GlProgram& program) const;

    std::string m_driver;            // vendor, renderer and version
    std::filesystem::path m_folder;  // empty: no cache on disk
    std::map<std::string, GlProgram> m_programs;
};

}  // namespace pellucid::renderer
