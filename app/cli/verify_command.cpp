// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "accuracy/extreme.h"
#include "accuracy/verify.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace pellucid::app {

namespace {

struct VerifyArguments {
    bool extreme = false;
    bool json = false;
};

/// Prints one suite; Text and Json make it of the rows.
template <class Rows, class Text, class Json>
int print(const Result<Rows>& rows, bool json, Text&& text, Json&& toJson,
          const renderer::Renderer& renderer) {
    if (!rows) return report(rows.error());
    clearProgress();
    if (json) {
        nlohmann::ordered_json out = toJson(*rows);
        const auto device = renderer.deviceInfo();
        out["program"] = "Pellucid " PELLUCID_VERSION;
        out["driver"] = device.vendor + ", " + device.renderer + ", " + device.version;
        fmt::print("{}\n", out.dump(2));
    } else {
        fmt::print("{}", text(*rows));
    }
    return accuracy::allPassed(*rows) ? kExitOk : kExitBeyond;
}

int run(const VerifyArguments& arguments) {
    Result<renderer::Renderer> renderer = renderer::Renderer::headless();
    if (!renderer) return report(renderer.error());
    if (arguments.extreme)
        return print(
            accuracy::verifyExtremes(*renderer, consoleProgress()), arguments.json,
            [](const auto& rows) { return accuracy::extremeText(rows); },
            [](const auto& rows) { return accuracy::extremeJson(rows); }, *renderer);
    return print(
        accuracy::verifyOrders(*renderer, consoleProgress()), arguments.json,
        [](const auto& rows) { return accuracy::orderText(rows); },
        [](const auto& rows) { return accuracy::orderJson(rows); }, *renderer);
}

}  // namespace

Command addVerifyCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "verify", "Measures whether pictures converge as theory says, on this machine");
    const auto arguments = std::make_shared<VerifyArguments>();
    command->add_flag(
        "--extreme", arguments->extreme,
        "Draw the stiff and extreme cases instead, each against its closed form or the reference");
    command->add_flag("--json", arguments->json, "Print every figure as JSON");
    command->footer(
        "Draws known fields at finer and finer steps, voxels and pixels, and compares the order at which the "
        "error "
        "falls with\n"
        "theory, for every mode, integrator and filter; some 40 seconds. Exit status 0 when all pass, 1 when "
        "one "
        "fails.\n\n"
        "Examples:\n"
        "  pellucid verify\n"
        "  pellucid verify --extreme --json");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
