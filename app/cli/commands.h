// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "app/cli/cli.h"

/// One function per command: it adds its subcommand to the program and returns what to run when it was
/// chosen.
namespace pellucid::app {

struct Command {
    CLI::App* app = nullptr;
    std::function<int()> run;  ///< Returns the exit status.
};

/// `pellucid [PATH...]`; its options belong to the program itself.
Command addOpenCommand(CLI::App& program, const OpenDesktop& openDesktop);
Command addRenderCommand(CLI::App& program);
Command addInfoCommand(CLI::App& program);
Command addPlanCommand(CLI::App& program);
Command addCompareCommand(CLI::App& program);
Command addReportCommand(CLI::App& program);
Command addResampleCommand(CLI::App& program);
Command addDoctorCommand(CLI::App& program);
Command addVerifyCommand(CLI::App& program);

}  // namespace pellucid::app
