// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// What an event recomputes, and that nothing else is (Van Gelder and Kim 1996, sections 2 and 3: the table of
// events).
#include <gtest/gtest.h>

#include <functional>

#include "tests/accuracy/gpu_fixture.h"

namespace pellucid::test {
namespace {

constexpr glm::dvec3 kOblique(0.4, 1.0, -0.3);

class Events : public GpuTest {
protected:
    static Scene litScene() {
        Scene scene = sceneOf(colourfulFunction(2.0),
                              perspectiveAlong(axisAlignedGrid({8, 8, 8}), kOblique, 3.5), {16, 16});
        scene.lights = std::vector<Light>{Light{}};
        return scene;
    }
    static VolumePtr data(std::uint64_t seed) {
        return accuracy::randomVolume(axisAlignedGrid({8, 8, 8}), seed);
    }

    /// Work done by one more frame. Programs count together, wherever they come from.
    struct Work {
        int uploads, tables, programs, frames;
        bool operator==(const Work&) const = default;
    };
    static Work workOf(const Scene& scene, const VolumePtr& volume, renderer::Renderer& on = gpu()) {
        const renderer::WorkCounts before = on.workCounts();
        const auto frame = on.render(scene, {volume});
        EXPECT_TRUE(frame) << frame.error().text();
        const renderer::WorkCounts after = on.workCounts();
        return {after.volumeUploads - before.volumeUploads, after.transferTables - before.transferTables,
                after.programsCompiled - before.programsCompiled + after.programsFromDisk -
                    before.programsFromDisk,
                after.frames - before.frames};
    }
    friend void PrintTo(const Work& w, std::ostream* out) {
        *out << "uploads " << w.uploads << " tables " << w.tables << " programs " << w.programs << " frames "
             << w.frames;
    }
};

TEST_F(Events, EachEditRedoesWhatDependsOnItAndNothingElse) {
    struct Event {
        const char* name;
        std::function<void(Scene&)> edit;
        Work expected;
    };
    const std::vector<Event> events{
        {"nothing", [](Scene&) {}, {0, 0, 0, 1}},
        {"rotation", [](Scene& s) { s.camera.pose->eye.x += 3.0; }, {0, 0, 0, 1}},
        {"zoom", [](Scene& s) { s.camera.zoom = 1.5; }, {0, 0, 0, 1}},
        {"window size",
         [](Scene& s) {
             s.picture.size = {20, 12};
         },
         {0, 0, 0, 1}},
        {"background",
         [](Scene& s) {
             s.picture.background = {0.2, 0.3, 0.4};
         },
         {0, 0, 0, 1}},
        {"light colour",
         [](Scene& s) {
             s.lights->front().color = {1.0, 0.5, 0.2};
         },
         {0, 0, 0, 1}},
        {"light intensity", [](Scene& s) { s.lights->front().intensity = 0.4; }, {0, 0, 0, 1}},
        {"light kind and place",
         [](Scene& s) {
             s.lights->front() = Light{LightKind::Point, {1, 1, 1}, 1.0, {0, 1, 0}, {30, 2, 1}};
         },
         {0, 0, 0, 1}},
        {"material", [](Scene& s) { s.material.shininess = 30.0; }, {0, 0, 0, 1}},
        {"transfer function colour",
         [](Scene& s) {
             s.volumes.front().transferFunction->points[1].color = {1, 0, 0};
         },
         {0, 1, 0, 1}},
        {"transfer function point",
         [](Scene& s) { s.volumes.front().transferFunction->points[1].value = 0.4; },
         {0, 1, 0, 1}},
        {"early termination bound", [](Scene& s) { s.quality.earlyTermination = 0.0; }, {0, 0, 0, 1}},
    };
    Scene scene = litScene();
    const VolumePtr volume = data(1);
    draw(scene, volume);
    for (const Event& event : events) {
        event.edit(scene);
        EXPECT_EQ(workOf(scene, volume), event.expected) << event.name;
    }
}

TEST_F(Events, ANewVolumeIsUploadedOnceAndTheOldOneIsKept) {
    const Scene scene = litScene();
    const VolumePtr first = data(1);
    const VolumePtr second = data(2);
    draw(scene, first);
    EXPECT_EQ(workOf(scene, second).uploads, 1);
    EXPECT_EQ(workOf(scene, second), (Work{0, 0, 0, 1}));
    EXPECT_EQ(workOf(scene, first).uploads, 0);
}

/// Only structure compiles: a first light, another mode, another filter; going back compiles nothing.
TEST_F(Events, OnlyStructureCompiles) {
    const VolumePtr volume = data(3);
    const Scene lit = litScene();
    Scene unlit = lit;
    unlit.lights = std::vector<Light>{};
    Scene mip = lit;
    mip.mode = Mode::Mip;
    Scene cubic = lit;
    cubic.volumes.front().filter = Filter::CatmullRom;
    auto fresh = renderer::Renderer::headless();  // The shared one may have drawn anything already.
    ASSERT_TRUE(fresh) << fresh.error().text();
    const std::vector<const Scene*> structures{&lit, &unlit, &mip, &cubic};
    for (const Scene* scene : structures) {
        EXPECT_EQ(workOf(*scene, volume, *fresh).programs, 1);
        EXPECT_EQ(workOf(*scene, volume, *fresh), (Work{0, 0, 0, 1}));
    }
    EXPECT_EQ(workOf(lit, volume, *fresh).programs, 0);
}

/// A picture after edits is bit for bit the picture of a renderer that has never drawn anything else.
TEST_F(Events, IncrementalPicturesEqualAFreshRenderer) {
    const VolumePtr volume = data(1);
    Scene scene = litScene();
    draw(scene, data(2));
    draw(scene, volume);
    scene.mode = Mode::Mip;
    draw(scene, volume);
    scene.mode = Mode::Composite;
    scene.volumes.front().transferFunction->points[1].color = {1, 0, 0};
    scene.lights->front().intensity = 0.7;
    scene.camera.pose->eye.x += 3.0;
    const ImageF incremental = draw(scene, volume);
    EXPECT_EQ(draw(scene, volume), incremental);

    auto fresh = renderer::Renderer::headless();
    ASSERT_TRUE(fresh) << fresh.error().text();
    const auto frame = fresh->render(scene, {volume});
    ASSERT_TRUE(frame) << frame.error().text();
    EXPECT_EQ(frame->image, incremental);
}

}  // namespace
}  // namespace pellucid::test
