// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/lint/shaders.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "renderer/plan/stages.h"

namespace pellucid::lint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path kShaders = fs::path(PELLUCID_SOURCE_DIR) / "renderer" / "shaders";

const char* const kSample =
    "// uniform float inAComment;\n"
    "uniform float stepMm;  // mm\n"
    "layout(std140, binding = 0) uniform Lights {\n    vec4 lights[4];\n};\n"
    "vec4 look(float u) { return classify(u); }\n";

TEST(LintShader, LetsAFilePassThatIsAsItsRowSays) {
    EXPECT_THAT(checkShader({"a.glsl", kSample}, {"compose", {"stepMm"}, {"Lights"}, {"classify"}}, {}),
                IsEmpty());
}

TEST(LintShader, RefusesUniformsThatTheTableDoesNotKnowOrTheFileDoesNotHave) {
    EXPECT_THAT(checkShader({"a.glsl", kSample}, {"compose", {}, {"Lights"}, {"classify"}}, {}),
                ElementsAre(HasSubstr("uniform 'stepMm' is not in its row")));
    EXPECT_THAT(
        checkShader({"a.glsl", kSample}, {"compose", {"stepMm", "other"}, {"Lights"}, {"classify"}}, {}),
        ElementsAre(HasSubstr("uniform 'other' of the stage table is not declared")));
    EXPECT_THAT(checkShader({"a.glsl", kSample}, {"compose", {"stepMm"}, {}, {"classify"}}, {}),
                ElementsAre(HasSubstr("block 'Lights' is not in its row")));
}

TEST(LintShader, RefusesACallOfAStageThatTheRowDoesNotNeed) {
    EXPECT_THAT(
        checkShader({"a.glsl", kSample}, {"compose", {"stepMm"}, {"Lights"}, {}}, {}),
        ElementsAre(HasSubstr("a.glsl:6: calls classify(), but its row does not need the stage classify")));
}

TEST(LintShader, AConditionAllowsItsStageUntilItsEndOnly) {
    const char* text =
        "//@when shade\n"
        "vec3 a = shade(gradientMm(p));\n"
        "//@end\n"
        "vec3 b = gradientMm(p);\n";
    EXPECT_THAT(checkShader({"a.glsl", text}, {"compose", {}, {}, {}}, {{"shade", {"gradient"}}}),
                ElementsAre(HasSubstr("a.glsl:4: calls gradientMm()")));
}

std::string pathOf(const renderer::StageVariant& row) {
    return std::string(row.stage) + "/" + row.variant + ".glsl";
}

TEST(LintShaders, EveryFileIsInTheStageTableAndEveryRowHasItsFile) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(kShaders)) {
        const std::string name = fs::relative(entry.path(), kShaders).generic_string();
        if (entry.path().extension() == ".glsl" && !name.starts_with("engine/")) files.push_back(name);
    }
    std::vector<std::string> rows;
    for (const renderer::StageVariant& row : renderer::stageTable()) rows.push_back(pathOf(row));
    EXPECT_GT(rows.size(), 10u);
    EXPECT_THAT(rows, testing::UnorderedElementsAreArray(files));
}

TEST(LintShaders, EveryFileDeclaresAndCallsWhatItsRowSays) {
    StageNeeds needsOf;
    for (const renderer::StageVariant& row : renderer::stageTable())
        needsOf[row.stage].insert(row.needs.begin(), row.needs.end());
    for (const renderer::StageVariant& row : renderer::stageTable()) {
        std::ifstream stream(kShaders / pathOf(row), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        const ShaderFacts facts{row.stage,
                                {row.uniforms.begin(), row.uniforms.end()},
                                {row.blocks.begin(), row.blocks.end()},
                                {row.needs.begin(), row.needs.end()}};
        for (const std::string& finding :
             checkShader({"renderer/shaders/" + pathOf(row), text}, facts, needsOf)) {
            ADD_FAILURE() << finding;
        }
    }
}

}  // namespace
}  // namespace pellucid::lint
