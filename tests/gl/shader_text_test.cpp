// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/plan/shader_assembly.h"

#include <gmock/gmock.h>

#include <array>
#include <regex>
#include <set>

#include "renderer/plan/stages.h"
#include "scene/names.h"
#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

using test::kAllFilters;
using test::kAllModes;

std::vector<Features> integratorFeatures();

std::vector<Features> allFeatures() {
    std::vector<Features> all;
    for (const Mode mode : kAllModes)
        for (const Filter filter : kAllFilters)
            for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
                for (const int lights : {0, 1, 3})
                    for (const auto space : {CompositingSpace::Display, CompositingSpace::Linear})
                        for (const double bound : {0.0, 0.001}) {
                            Scene scene = test::rampScene(mode);
                            scene.volumes[0].filter = filter;
                            scene.camera.projection = projection;
                            scene.lights->resize(static_cast<std::size_t>(lights));
                            scene.space = space;
                            scene.quality.earlyTermination = bound;
                            all.push_back(featuresOf(scene));
                        }
    const auto more = integratorFeatures();
    all.insert(all.end(), more.begin(), more.end());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].skipping = std::array{Skipping::None, Skipping::Box, Skipping::Leaps}[i % 3];
    return all;
}

/// All integrators, formats and jitter with the other choices at their defaults.
std::vector<Features> integratorFeatures() {
    std::vector<Features> all;
    for (const Mode mode : kAllModes)
        for (const auto& integrator : enumNames<Integrator>())
            for (const auto& accumulation : enumNames<Accumulation>())
                for (const bool jitter : {false, true}) {
                    Scene scene = test::rampScene(mode);
                    scene.quality.integrator = integrator.value;
                    scene.quality.accumulation = accumulation.value;
                    scene.quality.jitter = jitter;
                    if (mode == Mode::Isosurface)
                        scene.volumes[0].isosurfaces.resize(accumulation.value == Accumulation::Half ? 3 : 0);
                    if (!integratesSegments(integrator.value))
                        scene.volumes[0].classification = jitter ? Classification::Pre : Classification::Post;
                    all.push_back(featuresOf(scene));
                }
    return all;
}

std::set<std::string> identifiers(const std::string& text) {
    static const std::regex word("[A-Za-z_][A-Za-z0-9_]*");
    static const std::regex comment("//[^\n]*");
    const std::string code = std::regex_replace(text, comment, "");
    return {std::sregex_token_iterator(code.begin(), code.end(), word), std::sregex_token_iterator()};
}

TEST(ShaderText, EqualFeaturesGiveEqualBytes) {
    for (const auto& features : allFeatures()) {
        const auto rows = chooseStages(features).rows;
        EXPECT_EQ(assembleShader(features, rows).fragment, assembleShader(features, rows).fragment);
    }
}

TEST(ShaderText, AStageLeftOutLeavesNoIdentifierBehind) {
    for (const auto& features : allFeatures()) {
        const auto rows = chooseStages(features).rows;
        const auto text = assembleShader(features, rows);
        const auto present = identifiers(text.fragment);
        std::set<std::string> declared(text.uniforms.begin(), text.uniforms.end());
        declared.insert(text.blocks.begin(), text.blocks.end());
        for (const auto& variant : stageTable()) {
            const bool chosen = std::any_of(rows.begin(), rows.end(), [&](const StageRow& row) {
                return row.stage == variant.stage && row.variant == variant.variant;
            });
            for (const auto& list : {variant.uniforms, variant.blocks})
                for (const char* name : list) {
                    if (chosen)
                        EXPECT_TRUE(present.contains(name))
                            << variant.stage << '/' << variant.variant << ": " << name;
                    else
                        EXPECT_EQ(present.contains(name), declared.contains(name)) << name;
                }
        }
        EXPECT_THAT(text.fragment, testing::Not(testing::HasSubstr("//@")));
        for (const char* name : {"shade", "gradientMm", "lights", "material"})
            EXPECT_EQ(present.contains(name), features.lit) << name;
        EXPECT_EQ(present.contains("rayIsDone"), features.earlyTermination);
        EXPECT_EQ(present.contains("encodePicture"), features.space == CompositingSpace::Linear);
    }
}

TEST(ShaderText, StagesFindWhatTheyCall) {
    for (const auto& features : allFeatures()) {
        const auto rows = chooseStages(features).rows;
        std::set<std::string> present;
        for (const auto& row : rows) {
            for (const char* need : findVariant(row.stage, row.variant).needs)
                EXPECT_TRUE(present.contains(need))
                    << row.stage << '/' << row.variant << " needs " << need << " before it";
            present.insert(row.stage);
        }
    }
}

TEST(ShaderText, DriverMessagesNameFileAndLine) {
    const std::vector<std::string> files{"engine/raycast.frag", "ray/perspective.glsl"};
    EXPECT_EQ(locateInFiles("0:1012(5): error: syntax", files), "ray/perspective.glsl:12: error: syntax");
    EXPECT_EQ(locateInFiles("a\n0(7) : error C0000", files), "a\nengine/raycast.frag:7 : error C0000");
}

TEST(ShaderText, LineDirectivesPointIntoTheFile) {
    Scene scene = test::rampScene();
    const Features features = featuresOf(scene);
    const auto text = assembleShader(features, chooseStages(features).rows);
    // Follow the directives and compare each line with the file it claims to come from.
    std::istringstream lines(text.fragment);
    std::string line, name;
    int number = 0;
    std::vector<std::string> source;
    int compared = 0;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_match(line, match, std::regex(R"(#line (\d+))"))) {
            number = std::stoi(match[1]) % 1000;
            source.clear();
            std::istringstream file(shaderFile(text.files[std::stoul(match[1]) / 1000]));
            for (std::string l; std::getline(file, l);) source.push_back(l);
        } else if (!source.empty()) {
            ASSERT_LE(static_cast<std::size_t>(number), source.size());
            EXPECT_EQ(line, source[static_cast<std::size_t>(number) - 1]);
            ++number;
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace pellucid::renderer
