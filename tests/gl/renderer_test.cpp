// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/gpu/gl_api.h"

#include "renderer/renderer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "renderer/gpu/gpu_context.h"
#include "tests/gl/gl_fixture.h"
#include "tests/gl/scenes.h"

namespace pellucid::renderer {
namespace {

class RendererTest : public test::GlTest {
protected:
    Frame draw(Renderer& renderer, const Scene& scene, const RenderOptions& options = {}) {
        auto frame = renderer.render(scene, {m_volume}, options);
        EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
        return frame ? std::move(*frame) : Frame{};
    }
    VolumePtr m_volume = test::ballVolume();
};

TEST_F(RendererTest, TheSameSceneGivesTheSameBits) {
    auto renderer = Renderer::headless().value();
    for (const Mode mode : test::kAllModes) {
        Scene scene = test::rampScene(mode);
        scene.lights->push_back(Light{});
        const auto first = draw(renderer, scene).image;
        EXPECT_EQ(draw(renderer, scene).image, first) << name(mode);
        auto other = Renderer::headless().value();
        EXPECT_EQ(draw(other, scene).image, first) << name(mode);
    }
}

TEST_F(RendererTest, TileSizesDoNotShow) {
    auto renderer = Renderer::headless().value();
    const Scene scene = test::rampScene();
    RenderOptions tiny;
    tiny.tileTargetMs = 1e-3;
    const Frame many = draw(renderer, scene, tiny);
    EXPECT_GT(many.cost.tiles, 10);
    RenderOptions huge;
    huge.tileTargetMs = 1e6;
    const Frame one = draw(renderer, scene, huge);
    EXPECT_EQ(one.cost.tiles, 1);
    EXPECT_EQ(many.image, one.image);
}

TEST_F(RendererTest, BandsJoinWithoutASeam) {
    // 16384 x 600 pixels are two bands of 512 rows; the same rays in a narrower picture of the same height
    // are the middle columns.
    auto renderer = Renderer::headless().value();
    Scene scene = test::rampScene(Mode::Slice);
    scene.camera.projection = Projection::Orthographic;
    scene.picture.size = {16384, 600};
    const auto wide = draw(renderer, scene).image;
    scene.picture.size = {600, 600};
    const auto narrow = draw(renderer, scene).image;
    // Framing fits the volume to the shorter side, so the scale is the same. Positions differ by float
    // rounding of u only: 2^-24 * 16384 / 600 of half the picture's height, a hundred-thousandth of a voxel;
    // the steepest slope is 250 a voxel of 1000.
    for (int y = 0; y < 600; y += 7)
        for (int x = 0; x < 600; x += 7)
            ASSERT_NEAR(wide.at(16384 / 2 - 300 + x, y).r, narrow.at(x, y).r, 1e-4) << x << " " << y;
}

TEST_F(RendererTest, RecomputesOnlyWhatAnEventTouches) {
    // Van Gelder and Kim's table of events (V18): what each one rebuilds. Frames count every picture.
    auto renderer = Renderer::headless().value();
    Scene scene = test::rampScene();
    scene.lights->push_back(Light{});
    draw(renderer, scene);
    const auto step = [&](auto&& edit, const WorkCounts& expected, const char* event) {
        const WorkCounts before = renderer.workCounts();
        edit();
        draw(renderer, scene);
        const WorkCounts after = renderer.workCounts();
        const WorkCounts work{after.volumeUploads - before.volumeUploads,
                              after.transferTables - before.transferTables,
                              after.programsCompiled + after.programsFromDisk - before.programsCompiled -
                                  before.programsFromDisk,
                              0, after.frames - before.frames};
        EXPECT_EQ(work, expected) << event;
    };
    step([&] { scene.camera.view = AnatomicalView::Left; }, {0, 0, 0, 0, 1}, "rotation");
    step([&] { scene.camera.zoom = 1.5; }, {0, 0, 0, 0, 1}, "zoom");
    step([&] { scene.lights->front().color = {1, 0, 0}; }, {0, 0, 0, 0, 1}, "light colour");
    step([&] { scene.material.ambient = 0.3; }, {0, 0, 0, 0, 1}, "material");
    step([&] { scene.quality.stepVoxels = 0.25; }, {0, 0, 0, 0, 1}, "sampling distance");
    step([&] { scene.densityScale = 3.0; }, {0, 0, 0, 0, 1}, "density");
    step(
        [&] {
            scene.volumes[0].transferFunction->points[1].color = {0, 1, 0};
        },
        {0, 1, 0, 0, 1}, "transfer function");
    step([&] { scene.lights->push_back(Light{}); }, {0, 0, 1, 0, 1}, "one more light");
    step([&] { m_volume = test::ballVolume(20); }, {1, 0, 0, 0, 1}, "new volume");
    step([&] {}, {0, 0, 0, 0, 1}, "nothing");
}

TEST_F(RendererTest, EmptySpaceIsSoughtAgainOnlyWhenWhatShowsChanges) {
    auto renderer = Renderer::headless().value();
    Scene scene = test::rampScene();
    const auto counts = [&](auto&& edit) {
        edit();
        draw(renderer, scene);
        return std::pair(renderer.workCounts().blockRanges, renderer.workCounts().occupancies);
    };
    auto& function = *scene.volumes[0].transferFunction;
    EXPECT_EQ(counts([] {}), std::pair(1, 1));
    EXPECT_EQ(counts([&] { scene.camera.view = AnatomicalView::Left; }), std::pair(1, 1));
    EXPECT_EQ(counts([&] { scene.quality.stepVoxels = 0.25; }), std::pair(1, 1));
    EXPECT_EQ(counts([&] { function.points[1].color = {0, 1, 0}; }), std::pair(1, 1));
    EXPECT_EQ(counts([&] { scene.lights->push_back(Light{}); }), std::pair(1, 1));
    EXPECT_EQ(counts([&] { function.points[0].value = 350; }), std::pair(1, 2));
    EXPECT_EQ(counts([&] { function.points[0].value = 200; }), std::pair(1, 2));  // still known
    EXPECT_EQ(counts([&] { scene.volumes[0].filter = Filter::TricubicBSpline; }), std::pair(2, 3));
    EXPECT_EQ(counts([&] { m_volume = test::ballVolume(20); }), std::pair(3, 4));
}

TEST_F(RendererTest, IncrementalUpdatesEqualAFullRebuild) {
    auto renderer = Renderer::headless().value();
    Scene scene = test::rampScene();
    draw(renderer, scene);
    scene.lights->push_back(Light{});
    draw(renderer, scene);
    scene.volumes[0].transferFunction->points[0].value = 300;
    scene.camera.view = AnatomicalView::Superior;
    const auto incremental = draw(renderer, scene).image;
    auto fresh = Renderer::headless().value();
    EXPECT_EQ(draw(fresh, scene).image, incremental);
}

TEST_F(RendererTest, CancelEndsTheFrameWithAnError) {
    auto renderer = Renderer::headless().value();
    RenderOptions options;
    options.progress = [](double, std::string_view) { return false; };
    const auto frame = renderer.render(test::rampScene(), {m_volume}, options);
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().code, ErrorCode::Cancelled);
    draw(renderer, test::rampScene());  // and the renderer is as good as before
}

TEST_F(RendererTest, ProgramsComeBackFromDisk) {
    const auto folder = std::filesystem::temp_directory_path() / "pellucid-program-cache-test";
    std::filesystem::remove_all(folder);
    const char* before = std::getenv("XDG_CACHE_HOME");
    const std::string saved = before != nullptr ? before : "";
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    {
        auto first = Renderer::headless().value();
        const auto image = draw(first, test::rampScene()).image;
        EXPECT_EQ(first.workCounts().programsCompiled, 1);
        auto second = Renderer::headless().value();
        EXPECT_EQ(draw(second, test::rampScene()).image, image);
        EXPECT_EQ(second.workCounts().programsCompiled, 0);
        EXPECT_EQ(second.workCounts().programsFromDisk, 1);
        // A damaged file is not used.
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (entry.is_regular_file()) std::filesystem::resize_file(entry.path(), 100);
        auto third = Renderer::headless().value();
        EXPECT_EQ(draw(third, test::rampScene()).image, image);
        EXPECT_EQ(third.workCounts().programsCompiled, 1);
    }
    if (before != nullptr)
        ::setenv("XDG_CACHE_HOME", saved.c_str(), 1);
    else
        ::unsetenv("XDG_CACHE_HOME");
    std::filesystem::remove_all(folder);
}

TEST_F(RendererTest, TheContextThatIsCurrentServesTooAndKeepsItsState) {
    // The fixture's context stands for a window's.
    auto owner = GpuContext::headless().value();
    owner.makeCurrent();
    glViewport(1, 2, 3, 4);
    glEnable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    auto guest = Renderer::inCurrentContext().value();
    const Scene scene = test::rampScene();
    const auto image = draw(guest, scene).image;
    GLint viewport[4] = {};
    glGetIntegerv(GL_VIEWPORT, viewport);
    EXPECT_THAT(viewport, testing::ElementsAre(1, 2, 3, 4));
    EXPECT_TRUE(glIsEnabled(GL_BLEND));
    EXPECT_FALSE(glIsEnabled(GL_SCISSOR_TEST));
    auto own = Renderer::headless().value();
    EXPECT_EQ(draw(own, scene).image, image);
    owner.makeCurrent();
}

TEST_F(RendererTest, PicturesAreFiniteInEveryModeAndFilter) {
    auto renderer = Renderer::headless().value();
    for (const Mode mode : test::kAllModes)
        for (const Filter filter : test::kAllFilters) {
            Scene scene = test::rampScene(mode);
            scene.volumes[0].filter = filter;
            scene.lights->push_back(Light{});
            scene.lights->push_back({LightKind::Point, {1, 1, 1}, 0.5, {0, 1, 0}, {30, -40, 20}});
            scene.volumes[0].window = Window{300, 1000};  // grey also where the value is 0
            bool shows = false;
            for (const auto& pixel : draw(renderer, scene).image.pixels) {
                for (int channel = 0; channel < 4; ++channel)
                    ASSERT_TRUE(std::isfinite(pixel[channel])) << name(mode) << " " << name(filter);
                shows = shows || pixel.r > 0.05f;
            }
            EXPECT_TRUE(shows) << name(mode) << " " << name(filter);
        }
}

}  // namespace
}  // namespace pellucid::renderer
