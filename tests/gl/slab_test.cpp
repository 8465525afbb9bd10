// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// Rays drawn in slabs, since a driver ends a pixel's loops after some number of turns.
#include <gmock/gmock.h>

#include <cmath>

#include "renderer/plan/slabs.h"
#include "renderer/renderer.h"
#include "scene/names.h"
#include "tests/gl/gl_fixture.h"
#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

/// A driver with a limit that asks for slabs at ordinary steps, and one without.
class SlabTest : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        m_whole.emplace(Renderer::headless().value());
        m_cut.emplace(Renderer::headless().value());
        m_cut->limitLoopTurns(kTurns);
    }

    static Frame draw(Renderer& renderer, const Scene& scene, const VolumePtr& volume) {
        auto frame = renderer.render(scene, {volume});
        EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
        return frame ? std::move(*frame) : Frame{};
    }

    /// Slabs are blended in float, and positions along the ray are sums of two floats in place of one: some
    /// roundings of numbers up to 1 each slab, and of positions in a field that rises by its whole range in a
    /// few voxels.
    void expectSame(const Scene& scene, const std::string& what, double bound = 2e-5) {
        const Frame whole = draw(*m_whole, scene, m_volume);
        const Frame cut = draw(*m_cut, scene, m_volume);
        EXPECT_EQ(whole.plan.slabs, 1) << what;
        EXPECT_FALSE(whole.plan.features.slabs) << what;
        EXPECT_GT(cut.plan.slabs, 1) << what;
        ASSERT_EQ(whole.image.size, cut.image.size) << what;
        double largest = 0.0;
        bool isEmpty = true;
        for (std::size_t i = 0; i < whole.image.pixels.size(); ++i)
            for (int channel = 0; channel < 4; ++channel) {
                const auto at = [&](const Frame& frame) {
                    return static_cast<double>(frame.image.pixels[i][channel]);
                };
                const double apart = std::abs(at(whole) - at(cut));
                if (!(apart <= largest)) largest = apart;
                isEmpty = isEmpty && whole.image.pixels[i].a < 0.2f;
            }
        EXPECT_LE(largest, bound) << what << ", " << cut.plan.slabs << " slabs";
        EXPECT_FALSE(isEmpty) << what;
    }

    static constexpr double kTurns = 220.0;
    std::optional<Renderer> m_whole, m_cut;
    VolumePtr m_volume = test::ballVolume();
};

/// Steps of an eighth of a voxel: 340 samples on the longest ray.
Scene fineScene() {
    Scene scene = test::rampScene();
    scene.quality.stepVoxels = 0.125;
    scene.quality.earlyTermination = 0.0;
    scene.quality.skipEmpty = false;
    scene.picture.background = {0.3, 0.2, 0.1};
    scene.picture.size = {24, 20};
    return scene;
}

TEST_F(SlabTest, EveryIntegratorGivesThePictureOfWholeRays) {
    for (const auto& integrator : enumNames<Integrator>()) {
        if (integrator.value == Integrator::Adaptive || integrator.value == Integrator::Importance) continue;
        for (const bool lit : {false, true}) {
            Scene scene = fineScene();
            // A quarter of a turn each, where four samples are taken a turn.
            scene.quality.stepVoxels = 0.03;
            if (lit) scene.lights->push_back(Light{});
            scene.quality.integrator = integrator.value;
            scene.quality.jitter = !lit;
            expectSame(scene, fmt::format("{} lit {} jitter {}", integrator.name, lit, !lit));
        }
    }
}

/// Steps so long that a sample elsewhere is seen: only the first slab begins with the part of a step that the
/// jitter gives.
TEST_F(SlabTest, AJitteredStartIsThatOfTheRay) {
    m_cut->limitLoopTurns(68.0);
    for (const Integrator integrator : {Integrator::Exponential, Integrator::IntegralFunctions}) {
        Scene scene = fineScene();
        scene.quality.stepVoxels = 1.5;
        scene.quality.integrator = integrator;
        scene.quality.jitter = true;
        expectSame(scene, name(integrator));
        scene.quality.jitter = false;
        expectSame(scene, name(integrator) + std::string(" from the entry"));
    }
}

TEST_F(SlabTest, LitRaysWithEitherSourceOfGradients) {
    for (const Gradients gradients : {Gradients::OnTheFly, Gradients::Texture})
        for (const bool skip : {false, true}) {
            Scene scene = fineScene();
            scene.lights->push_back(Light{});
            scene.quality.gradients = gradients;
            scene.quality.skipEmpty = skip;
            // Looked for on the fly, each sample may take 18 turns; fetched, a quarter.
            if (gradients == Gradients::Texture) scene.quality.stepVoxels = 0.03;
            expectSame(scene, fmt::format("{} skipping {}", name(gradients), skip));
        }
}

TEST_F(SlabTest, EveryFilterButNearest) {
    for (const Filter filter : test::kAllFilters) {
        // A sample on the border of two voxels may fall to either side.
        if (filter == Filter::Nearest) continue;
        Scene scene = fineScene();
        scene.volumes[0].filter = filter;
        scene.quality.stepVoxels = filter == Filter::Trilinear ? 0.03 : 0.125;
        expectSame(scene, name(filter));
    }
}

TEST_F(SlabTest, LeapsEarlyEndsProjectionsAndPlacesOfTheCamera) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
        for (const double bound : {0.0, 1.0 / 255.0}) {
            Scene scene = fineScene();
            scene.quality.skipEmpty = true;
            scene.camera.projection = projection;
            scene.quality.earlyTermination = bound;
            // What is hidden behind the bound is drawn where a slab begins, and may differ by it.
            expectSame(scene, fmt::format("{} bound {}", name(projection), bound), bound + 2e-5);
        }
}

TEST_F(SlabTest, SpacesAndTransparentPictures) {
    for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear})
        for (const bool transparent : {false, true}) {
            Scene scene = fineScene();
            scene.quality.stepVoxels = 0.03;
            scene.space = space;
            scene.picture.transparent = transparent;
            // In the dark the curve is 12.92 times as steep as light.
            expectSame(scene, fmt::format("{} transparent {}", name(space), transparent),
                       space == CompositingSpace::Linear ? 2e-4 : 2e-5);
        }
}

TEST_F(SlabTest, SeveralSurfacesAreNeitherLostNorCountedTwice) {
    Scene scene = fineScene();
    scene.mode = Mode::Isosurface;
    scene.volumes[0].isosurfaces = {
        {200.0, {1, 0, 0}, 0.3}, {500.0, {0, 1, 0}, 0.4}, {800.0, {0, 0, 1}, 1.0}};
    expectSame(scene, "surfaces");
    scene.lights->push_back(Light{});
    scene.space = CompositingSpace::Linear;
    expectSame(scene, "lit surfaces, linear", 2e-4);
}

TEST_F(SlabTest, OneSurfaceIsFoundWhereTheWholeRayFindsIt) {
    for (const Mode mode : {Mode::FirstHit, Mode::Isosurface})
        for (const Projection projection : {Projection::Perspective, Projection::Orthographic})
            for (const bool skip : {false, true}) {
                Scene scene = fineScene();
                scene.mode = mode;
                scene.volumes[0].isovalue = 500.0;
                scene.camera.projection = projection;
                scene.quality.skipEmpty = skip;
                scene.lights->push_back(Light{});
                expectSame(scene, fmt::format("{} {} skipping {}", name(mode), name(projection), skip));
            }
}

/// Rays that enter through a face and cross the voxels behind it at every seventh step, where a slab of seven
/// ends: the sample that two slabs share is where the value jumps, but for rounding. Were it not one sample,
/// a jump might be in neither slab. Who goes into the ball comes out again: every surface is crossed an even
/// number of times.
TEST_F(SlabTest, NoSurfaceIsLostBetweenTwoSlabs) {
    Scene scene = fineScene();
    scene.mode = Mode::Isosurface;
    scene.picture.size = {96, 96};
    scene.volumes[0].filter = Filter::Nearest;
    scene.volumes[0].isosurfaces = {
        {200.0, {1, 0, 0}, 0.3}, {500.0, {0, 1, 0}, 0.4}, {800.0, {0, 0, 1}, 0.5}};
    scene.camera.projection = Projection::Orthographic;
    std::vector<double> opacities;
    for (int crossings = 0; crossings < 5 * 5 * 5; ++crossings)
        opacities.push_back(1.0 - std::pow(0.7 * 0.7, crossings % 5) *
                                      std::pow(0.6 * 0.6, crossings / 5 % 5) *
                                      std::pow(0.5 * 0.5, crossings / 25));
    const glm::dvec3 centre = centreMm(m_volume->grid());
    for (const glm::dvec3& eye : {glm::dvec3(3, -40, 7), glm::dvec3(-11, 40, 5), glm::dvec3(9, -50, -13)}) {
        scene.camera.pose = CameraPose{centre + eye, centre, {0, 0, 1}, 20.0};
        scene.quality.stepMm = glm::length(eye) / std::abs(eye.y) / 7.0;
        const Frame cut = draw(*m_cut, scene, m_volume);
        EXPECT_EQ(samplesPerSlab(cut.plan), 7.0);
        const auto isLost = [&](const glm::vec4& pixel) {
            return std::none_of(opacities.begin(), opacities.end(), [&](double opacity) {
                return std::abs(opacity - static_cast<double>(pixel.a)) < 1e-5;
            });
        };
        EXPECT_EQ(std::count_if(cut.image.pixels.begin(), cut.image.pixels.end(), isLost), 0)
            << "from " << eye.x << ' ' << eye.z;
    }
}

TEST_F(SlabTest, FewerRaysThanPixels) {
    for (const CompositingSpace space : {CompositingSpace::Display, CompositingSpace::Linear}) {
        Scene scene = fineScene();
        scene.space = space;
        scene.picture.size = {200, 180};
        scene.quality.stepVoxels = 0.03;
        scene.quality.interpolationGreyLevels = 0.5;
        const Frame whole = draw(*m_whole, scene, m_volume);
        const Frame cut = draw(*m_cut, scene, m_volume);
        EXPECT_GT(cut.plan.slabs, 1);
        EXPECT_LT(cut.cost.rays, 200 * 180 / 2);
        EXPECT_EQ(whole.cost.rays, cut.cost.rays);
        double largest = 0.0;
        for (std::size_t i = 0; i < whole.image.pixels.size(); ++i)
            largest = std::max(largest,
                               static_cast<double>(glm::length(whole.image.pixels[i] - cut.image.pixels[i])));
        EXPECT_LE(largest, 4e-4) << name(space);
    }
}

/// What a driver without a limit has nothing of: no uniform, no blending.
TEST_F(SlabTest, NothingIsThereForThemWhereRaysAreWhole) {
    const Scene scene = fineScene();
    const Frame whole = draw(*m_whole, scene, m_volume);
    const auto isSlab = [](const StageRow& row) { return row.stage == "slab"; };
    EXPECT_EQ(std::count_if(whole.plan.stages.begin(), whole.plan.stages.end(), isSlab), 0);
    EXPECT_THAT(planText(whole.plan), testing::HasSubstr("rays are drawn whole"));
    Scene fine = scene;
    fine.quality.stepVoxels = 0.03;
    const Frame cut = draw(*m_cut, fine, m_volume);
    EXPECT_EQ(std::count_if(cut.plan.stages.begin(), cut.plan.stages.end(), isSlab), 1);
    // And back again with the same renderer.
    EXPECT_EQ(draw(*m_cut, test::rampScene(Mode::Slice), m_volume).image,
              draw(*m_whole, test::rampScene(Mode::Slice), m_volume).image);
}

TEST_F(SlabTest, WhatCannotBeCutIsRefusedNotCutShort) {
    for (const Mode mode : {Mode::Mip, Mode::Average, Mode::XRay, Mode::Emission}) {
        Scene scene = fineScene();
        scene.mode = mode;
        scene.quality.stepVoxels = 0.01;
        const auto refused = m_cut->render(scene, {m_volume});
        ASSERT_FALSE(refused) << name(mode);
        EXPECT_THAT(refused.error().text(), testing::HasSubstr("take a longer step"));
    }
    Scene scene = fineScene();
    scene.quality.stepVoxels = 1e-3;
    const auto refused = m_cut->render(scene, {m_volume});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text(), testing::HasSubstr("take a longer step"));
}

/// The limit the driver has, with steps as short as it asks for.
TEST_F(SlabTest, TheDriversOwnLimitIsKept) {
    const double limit = m_whole->limits().maxLoopTurns;
    EXPECT_GE(limit, 60000.0);
    if (limit > 1e8) return;  // this driver counts on
    Scene scene = test::rampScene();
    scene.camera.projection = Projection::Orthographic;
    scene.picture.size = {2, 2};
    scene.quality.earlyTermination = 0.0;
    scene.quality.skipEmpty = false;
    scene.quality.gradients = Gradients::OnTheFly;
    const double longest = 24.0 * std::sqrt(3.0);
    for (const bool lit : {false, true}) {
        if (lit) scene.lights->push_back(Light{});
        scene.quality.stepMm = 0.05;
        const Frame coarse = draw(*m_whole, scene, m_volume);
        // Unlit rays take four samples a turn, lit ones up to 18 turns a sample.
        const double most = lit ? limit / 18.0 : 4.0 * limit;
        for (const auto& [share, slabs] : {std::pair(0.98, 1), std::pair(1.05, 2)}) {
            scene.quality.stepMm = longest / (share * most);
            const Frame fine = draw(*m_whole, scene, m_volume);
            EXPECT_EQ(fine.plan.slabs, slabs) << lit;
            // Midpoints at 1/20 voxel are within 1e-3 of the limit; a ray cut short would lack half of its
            // opacity.
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(fine.image.pixels[i].a, coarse.image.pixels[i].a, 1e-3) << lit;
        }
    }
}

}  // namespace
}  // namespace pellucid::renderer
