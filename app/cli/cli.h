// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

/// The command line: `pellucid [PATH...]` opens the desktop; render, info, plan, compare, report and doctor
/// do without one.
namespace pellucid::app {

inline constexpr int kExitOk = 0;
inline constexpr int kExitBeyond = 1;       ///< compare: the pictures differ by more than the limits.
inline constexpr int kExitRefused = 2;      ///< Input or usage refused; nothing was written.
inline constexpr int kExitInternal = 3;     ///< The graphics driver or the program itself failed.
inline constexpr int kExitCancelled = 130;  ///< Stopped by Ctrl-C, as shells count it (128 + SIGINT).

/// Opens the paths (none: an empty window) and returns the exit status when the window is closed.
using OpenDesktop = std::function<int(const std::vector<std::filesystem::path>&)>;

/// Runs one command and returns the exit status. Results go to stdout, all else to stderr.
int runCli(int argc, const char* const* argv, const OpenDesktop& openDesktop);

}  // namespace pellucid::app
