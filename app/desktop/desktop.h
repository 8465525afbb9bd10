// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace pellucid::app {

/// Runs the desktop until its window is closed; opens `paths` as one scan or scene first, if there are any.
/// Returns the exit status. Needs a display.
int runDesktop(int argc, char** argv, const std::vector<std::filesystem::path>& paths);

}  // namespace pellucid::app
