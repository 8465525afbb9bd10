// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace pellucid::cli {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

class Plan : public ProgramTest {
protected:
    [[nodiscard]] json planOf(const std::string& scene) const {
        const Outcome outcome = run({"plan", scene, "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return json::parse(outcome.out, nullptr, false);
    }
};

std::map<std::string, std::string> variants(const json& plan) {
    std::map<std::string, std::string> found;
    for (const json& row : plan["stages"])
        found[row["stage"].get<std::string>()] = row["variant"].get<std::string>();
    return found;
}

TEST_F(Plan, ALightAddsExactlyTheGradientShadeAndLightRows) {
    writeBallScene("unlit.json", R"(, "lights": [])");
    writeBallScene("lit.json",
                   R"(, "lights": [{"kind": "headlight"}], "quality": {"gradients": "on-the-fly"})");
    const json unlit = planOf("unlit.json");
    const json lit = planOf("lit.json");

    std::vector<std::string> changed;
    const auto before = variants(unlit);
    for (const auto& [stage, variant] : variants(lit)) {
        if (before.count(stage) == 0 || before.at(stage) != variant) changed.push_back(stage);
    }
    EXPECT_THAT(changed, ElementsAre("gradient", "shade"));

    std::vector<std::string> added;
    for (const json& row : lit["resources"]) {
        const bool there =
            std::any_of(unlit["resources"].begin(), unlit["resources"].end(),
                        [&](const json& other) { return other["resource"] == row["resource"]; });
        if (!there) added.push_back(row["resource"].get<std::string>());
    }
    EXPECT_THAT(added, ElementsAre(HasSubstr("light")));
    EXPECT_EQ(unlit["passes"], lit["passes"]);
}

TEST_F(Plan, TheTextSaysTheSameInRows) {
    writeBallScene("scene.json");
    const Outcome outcome = run({"plan", "scene.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const auto& [stage, variant] : variants(planOf("scene.json"))) {
        EXPECT_THAT(outcome.out, HasSubstr(stage));
        EXPECT_THAT(outcome.out, HasSubstr(variant));
    }
}

}  // namespace
}  // namespace pellucid::cli
