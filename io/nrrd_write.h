// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scene/volume.h"

namespace pellucid::io {

/// Writes the stored values as an attached NRRD (version 4, raw encoding, native byte order) that reads back
/// bit for bit, with its grid and unit; several components are the first axis. NRRD has no slope and
/// intercept. Errors: InvalidArgument when the mapping is not the identity, WriteFailed.
[[nodiscard]] Result<void> writeNrrd(const std::filesystem::path& file, const Volume& volume);

}  // namespace pellucid::io
