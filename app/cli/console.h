// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "scene/progress.h"
#include "scene/result.h"
#include "scene/volume.h"

/// What a command says besides its result: errors, warnings and progress, all on stderr; and Ctrl-C.
namespace pellucid::app {

/// Prints `pellucid: <sentence>` and returns the exit status that belongs to the error.
int report(const Error& error);

/// The same for a mistake in the command itself, with where to read on. Returns kExitRefused.
int reportUsage(std::string_view sentence, std::string_view command);

void printWarnings(const Volume& volume);

/// From now on the first Ctrl-C asks running work to end (see consoleProgress), a second one ends the process
/// at once.
void catchInterrupt();

/// Shows the progress on one line while stderr is a terminal, and cancels after Ctrl-C. Thread-safe.
Progress consoleProgress();

/// Removes the progress line, if there is one, before something else is printed.
void clearProgress();

}  // namespace pellucid::app
