// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// The renderer in a context that a window gives: the same picture as headless. Only this test links Qt's
// OpenGL widgets; the desktop itself draws headless.
#include <gtest/gtest.h>

#include <QApplication>
#include <QOpenGLWidget>
#include <QSurfaceFormat>
#include <QTest>
#include <optional>
#include <thread>

#include "renderer/renderer.h"
#include "tests/gui/display.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class DrawingWidget : public QOpenGLWidget {
public:
    Scene scene;
    std::vector<VolumePtr> volumes;
    std::optional<Result<renderer::Frame>> frame;

protected:
    void paintGL() override {
        if (frame) return;
        auto renderer = renderer::Renderer::inCurrentContext();
        frame = renderer ? renderer->render(scene, volumes) : tl::unexpected(renderer.error());
    }
};

TEST(WindowContext, GivesTheSamePictureAsHeadless) {
    const app::OpenedScan scan = smallScan();
    for (const Mode mode : {Mode::Composite, Mode::Isosurface, Mode::Mip}) {
        DrawingWidget widget;
        widget.scene = scan.scene;
        widget.scene.mode = mode;
        widget.scene.picture.size = {200, 150};
        widget.volumes = scan.volumes;
        widget.resize(200, 150);
        widget.show();
        ASSERT_TRUE(waitFor([&] { return widget.frame.has_value(); }));
        ASSERT_TRUE(*widget.frame) << widget.frame->error().text();
        // On another thread, as in the desktop: this one has the window's context.
        std::optional<Result<renderer::Frame>> expected;
        std::jthread([&] {
            auto headless = renderer::Renderer::headless();
            expected =
                headless ? headless->render(widget.scene, widget.volumes) : tl::unexpected(headless.error());
        }).join();
        ASSERT_TRUE(*expected) << expected->error().text();
        // The same driver and the same program: the same numbers.
        EXPECT_EQ((*widget.frame)->image, (*expected)->image) << name(mode);
    }
}

}  // namespace
}  // namespace pellucid::test

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    if (pellucid::test::onlyListsTests()) return RUN_ALL_TESTS();
    pellucid::test::provideDisplay();
    QSurfaceFormat format;
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication application(argc, argv);
    return RUN_ALL_TESTS();
}
