// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "renderer/plan/plan.h"

namespace pellucid::app {

namespace {

struct PlanArguments {
    InputArguments input;
    LookArguments look;
    bool json = false;
};

int run(const PlanArguments& arguments) {
    const Result<io::LoadedScene> loaded = openInput(arguments.input, arguments.look);
    if (!loaded) return report(loaded.error());
    const Scene scene = completed(loaded->scene, loaded->volumes);
    std::vector<renderer::VolumeFacts> facts;
    for (std::size_t i = 0; i < loaded->volumes.size(); ++i) {
        facts.push_back(renderer::factsOf(*loaded->volumes[i], scene.volumes[i].component));
    }
    const Result<renderer::Plan> plan = renderer::makePlan(scene, facts);
    if (!plan) return report(plan.error());
    clearProgress();
    fmt::print("{}", arguments.json ? renderer::planJson(*plan).dump(2) + "\n" : renderer::planText(*plan));
    return kExitOk;
}

}  // namespace

Command addPlanCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("plan", "Shows what drawing a scene needs, and what it leaves out");
    const auto arguments = std::make_shared<PlanArguments>();
    addInputOptions(*command, arguments->input);
    addLookOptions(*command, arguments->look);
    command->add_flag("--json", arguments->json, "For programs");
    command->footer(
        "Lists the shader variant of every stage, the passes, each resource with its bytes, why each is "
        "there, and what\n"
        "was left out. Needs no graphics driver.\n\n"
        "Examples:\n"
        "  pellucid plan ct-head/\n"
        "  pellucid plan scene.json --set lights=[] --json");
    return {command, [arguments] { return run(*arguments); }};
}

}  // namespace pellucid::app
