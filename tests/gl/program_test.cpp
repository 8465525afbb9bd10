// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gl_program.h"

#include <gmock/gmock.h>

#include <set>

#include "renderer/plan/stages.h"
#include "scene/names.h"
#include "tests/gl/gl_fixture.h"
#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

using ProgramTest = test::GlTest;

/// Every pair of choices of (mode, filter, projection, lights, space, termination) that can occur together
/// occurs in one of these: mode x filter is complete, the two-valued choices rotate through their
/// combinations.
std::vector<Features> coveringSet() {
    std::vector<Features> all;
    int turn = 0;
    for (const Mode mode : test::kAllModes)
        for (const Filter filter : test::kAllFilters)
            for (int half = 0; half < 2; ++half, ++turn) {
                Scene scene = test::rampScene(mode);
                scene.volumes[0].filter = filter;
                scene.camera.projection =
                    (turn / 2 + half) % 2 == 0 ? Projection::Perspective : Projection::Orthographic;
                scene.lights->resize(half == 0 ? 0u : 2u);
                scene.space = (turn / 4) % 2 == 0 ? CompositingSpace::Display : CompositingSpace::Linear;
                scene.quality.earlyTermination = (turn / 8 + half) % 2 == 0 ? 0.0 : 0.01;
                scene.xray = half == 0 ? XRayDisplay::Opacity : XRayDisplay::Transmittance;
                all.push_back(featuresOf(scene));
            }
    for (const Mode mode : {Mode::Composite, Mode::XRay})
        for (const auto& integrator : enumNames<Integrator>())
            for (int half = 0; half < 2; ++half, ++turn) {
                Scene scene = test::rampScene(mode);
                scene.lights->resize(half == 0 ? 0u : 1u);
                scene.xray = (turn / 2) % 2 == 0 ? XRayDisplay::Opacity : XRayDisplay::Transmittance;
                scene.quality.integrator = integrator.value;
                scene.quality.accumulation =
                    enumNames<Accumulation>()[static_cast<std::size_t>(turn % 3)].value;
                scene.quality.jitter = half == 0;
                all.push_back(featuresOf(scene));
            }
    for (const Mode mode : {Mode::Composite, Mode::XRay, Mode::Emission, Mode::Isosurface})
        for (int half = 0; half < 2; ++half) {
            Scene scene = test::rampScene(mode);
            scene.lights->resize(half == 0 ? 0u : 1u);
            scene.volumes[0].classification = Classification::Pre;
            scene.volumes[0].isosurfaces.resize(half == 0 ? 1u : 8u);
            scene.xray = half == 0 ? XRayDisplay::Opacity : XRayDisplay::Transmittance;
            all.push_back(featuresOf(scene));
        }
    for (int half = 0; half < 2; ++half) {
        Scene scene = test::rampScene(half == 0 ? Mode::Composite : Mode::XRay);
        scene.lights->resize(1);
        scene.volumes[0].filter = Filter::Nearest;
        scene.quality.integrator = Integrator::Adaptive;
        all.push_back(featuresOf(scene));
    }
    // Differences from a texture: with their values where those are sampled alone, or only they.
    for (const auto integrator : {Integrator::Exponential, Integrator::Simpson})
        for (const bool jitter : {false, true}) {
            Scene scene = test::rampScene();
            scene.lights->resize(1);
            scene.quality.integrator = integrator;
            scene.quality.jitter = jitter;
            all.push_back(featuresOf(scene));
            all.back().gradients = GradientSource::Texture;
        }
    // What is skipped goes with everything that can be skipped in.
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].mode != Mode::Average && all[i].mode != Mode::Slice)
            all[i].skipping = i % 3 == 0 ? Skipping::Box : Skipping::Leaps;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].slabs = i % 2 == 0 && (all[i].mode == Mode::Composite || all[i].mode == Mode::FirstHit ||
                                      all[i].mode == Mode::Isosurface);
    return all;
}

TEST_F(ProgramTest, EveryVariantCompilesAndDeclaresWhatTheTableSays) {
    std::set<std::string> variantsSeen;
    for (const auto& features : coveringSet()) {
        const auto rows = chooseStages(features).rows;
        const auto text = assembleShader(features, rows);
        const auto program = GlProgram::compile(text);
        ASSERT_TRUE(program) << program.error().text();
        for (const auto& name : program->activeUniforms())
            EXPECT_THAT(text.uniforms, testing::Contains(name));
        EXPECT_THAT(program->activeBlocks(), testing::UnorderedElementsAreArray(text.blocks));
        for (const auto& row : rows) variantsSeen.insert(row.stage + "/" + row.variant);
    }
    for (const auto& variant : stageTable())
        EXPECT_TRUE(variantsSeen.contains(std::string(variant.stage) + "/" + variant.variant))
            << variant.stage << '/' << variant.variant;
}

TEST_F(ProgramTest, ACompileErrorNamesFileAndLine) {
    const Features features = featuresOf(test::rampScene());
    auto text = assembleShader(features, chooseStages(features).rows);
    const std::string line = "vec4 classify(float u) {";
    const auto place = text.fragment.find(line);
    ASSERT_NE(place, std::string::npos);
    text.fragment.replace(place, line.size(), "vec4 classify(float u) { nonsense;");
    const auto program = GlProgram::compile(text);
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::Gpu);
    EXPECT_THAT(program.error().text(), testing::HasSubstr("classify/tf1d.glsl:6: error"));
    (void)takeGlErrors();  // the driver's own report of it
}

}  // namespace
}  // namespace pellucid::renderer
