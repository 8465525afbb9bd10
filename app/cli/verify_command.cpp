// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "accuracy/verification.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"

namespace pellucid::app {

namespace {

struct VerifyArguments {
    bool extreme = false;
    bool json = false;
    std::string only;
};

/// Nothing when `only` names no part.
std::optional<accuracy::VerificationParts> partsOf(const VerifyArguments& arguments) {
    const std::string& only = arguments.only;
    if (arguments.extreme) return accuracy::VerificationParts{false, false, false, true, only};
    if (only.empty()) return accuracy::VerificationParts{};
    const accuracy::VerificationParts parts{only == "step", only == "grid", only == "pixel"};
    if (!parts.step && !parts.grid && !parts.pixel) return std::nullopt;
    return parts;
}

int run(const VerifyArguments& arguments) {
    const auto parts = partsOf(arguments);
    if (!parts)
        return reportUsage(
            fmt::format("--only: found {}; step, grid or pixel, or with --extreme a part of a case's name",
                        arguments.only),
            "verify");
    Result<renderer::Renderer> renderer = renderer::Renderer::headless();
    if (!renderer) return report(renderer.error());
    const auto verification = accuracy::verify(*renderer, *parts, consoleProgress());
    if (!verification) return report(verification.error());
    clearProgress();
    if (arguments.json)
        fmt::print("{}\n", accuracy::verificationJson(*verification).dump(2));
    else
        fmt::print("{}", accuracy::verificationText(*verification));
    return verification->passed() ? kExitOk : kExitBeyond;
}

}  // namespace

Command addVerifyCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "verify", "Measures whether pictures converge as theory says, on this machine");
    const auto arguments = std::make_shared<VerifyArguments>();
    command->add_flag(
        "--extreme", arguments->extreme,
        "Draw the stiff and extreme cases instead, each against its closed form or the reference");
    command
        ->add_option("--only", arguments->only,
                     "Only what is refined: step, grid or pixel; with --extreme only the cases whose name "
                     "holds this text")
        ->type_name("TEXT");
    command->add_flag("--json", arguments->json, "Print every figure as JSON");
    command->footer(
        "Draws known fields at finer and finer steps, voxels and pixels, and compares the order at which the "
        "error "
        "falls with\n"
        "theory, for every mode, integrator and filter; about a minute. Exit status 0 when all pass, 1 when "
        "one "
        "fails.\n\n"
        "Examples:\n"
        "  pellucid verify\n"
        "  pellucid verify --only pixel\n"
        "  pellucid verify --extreme --json");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
