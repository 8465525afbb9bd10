// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/cli.h"

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace pellucid::app {

namespace {

constexpr const char* kFooter =
    "Without a command, opens a scene or a scan in the desktop; without a display, draws it to "
    "pellucid-NAME.png.\n"
    "`pellucid COMMAND --help` tells more, with examples.\n\n"
    "Examples:\n"
    "  pellucid ct-head/\n"
    "  pellucid --sample\n"
    "  pellucid render ct-head/ -o head.png --size 1024x768 --view left\n"
    "  pellucid info brain.nii.gz\n\n"
    "Exit status: 0 done; 1 pictures differ beyond the limits or a self-test fails (compare, verify); 2 "
    "input or usage refused; 3 "
    "graphics driver or\n"
    "internal failure; 130 stopped by Ctrl-C. Pellucid is not a medical device.";

/// The chosen command's name, for a hint; empty for the program itself.
std::string chosenName(const CLI::App& program) {
    const auto chosen = program.get_subcommands();
    return chosen.empty() ? "" : chosen.front()->get_name();
}

}  // namespace

int runCli(int argc, const char* const* argv, const OpenDesktop& openDesktop) {
    CLI::App program{"Pellucid shows volume data such as CT and MR scans, exactly and fast.", "pellucid"};
    program.footer(kFooter);
    program.set_version_flag("--version", "Pellucid " PELLUCID_VERSION);
    program.require_subcommand(0, 1);

    const Command open = addOpenCommand(program, openDesktop);
    const std::vector<Command> commands = {addRenderCommand(program),   addInfoCommand(program),
                                           addPlanCommand(program),     addCompareCommand(program),
                                           addResampleCommand(program), addReportCommand(program),
                                           addDoctorCommand(program),   addVerifyCommand(program)};
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return program.exit(asked);
    } catch (const CLI::ParseError& mistake) {
        return reportUsage(mistake.what(), chosenName(program));
    }
    for (const Command& command : commands) {
        if (!command.app->parsed()) continue;
        if (program.get_option("path")->count() > 0 || program.get_option("--sample")->count() > 0) {
            return reportUsage("the command comes first, then its paths and options",
                               command.app->get_name());
        }
        catchInterrupt();
        return command.run();
    }
    return open.run();
}

}  // namespace pellucid::app
