// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "app/cli/cli.h"
#include "app/desktop/desktop.h"

// The desktop is handed to the command line as a function, so that nothing under app/cli knows Qt.
int main(int argc, char** argv) {
    try {
        return pellucid::app::runCli(argc, argv, [&](const std::vector<std::filesystem::path>& paths) {
            return pellucid::app::runDesktop(argc, argv, paths);
        });
    } catch (const std::exception& unexpected) {
        fmt::print(stderr, "pellucid: internal error, please report it: {}\n", unexpected.what());
        return pellucid::app::kExitInternal;
    }
}
