// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QKeyEvent>
#include <QToolButton>

#include "scene/image.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

using VolumeViewTest = GuiTest;

TEST_F(VolumeViewTest, ShowsThePictureOfTheDocumentsSceneWithItsError) {
    const auto& reply = volumeView()->lastReply();
    ASSERT_TRUE(reply && reply->frame);
    EXPECT_EQ(reply->frame->image.size, volumeView()->pixelSize());
    EXPECT_TRUE(reply->frame->error);
    auto renderer = renderer::Renderer::headless().value();
    EXPECT_EQ(renderer.render(volumeView()->shownScene(), document().volumes()).value().image,
              reply->frame->image);
    EXPECT_EQ(volumeView()->letters(), (EdgeLetters{"R", "L", "S", "I"}));
}

TEST_F(VolumeViewTest, LeftDragRotatesAboutTheTargetAsOneStep) {
    const Scene before = document().scene();
    const CameraPose start =
        app::editablePose(before.camera, document().volume().grid(),
                          static_cast<double>(volumeView()->width()) / volumeView()->height());
    const int quarter = volumeView()->height() / 2;  // Half the height is a quarter turn.
    dragMouse(volumeView(), Qt::LeftButton, Qt::NoModifier, {100, 100}, {100 + quarter, 100});
    ASSERT_TRUE(document().scene().camera.pose);
    const CameraPose pose = *document().scene().camera.pose;
    EXPECT_EQ(pose.target, start.target);
    const double angle = 3.14159265358979 * quarter / volumeView()->height();
    EXPECT_NEAR(glm::distance(pose.eye, app::rotated(start, angle, 0.0).eye), 0.0, 1e-6);
    ASSERT_TRUE(settle());
    EXPECT_EQ(volumeView()->letters().right,
              volumeView()->height() % 2 == 0 ? "A" : volumeView()->letters().right);
    EXPECT_EQ(document().undoStack().undoName(), "Rotate");
    document().undo();
    EXPECT_EQ(document().scene(), before);
    document().redo();
    EXPECT_EQ(*document().scene().camera.pose, pose);
}

TEST_F(VolumeViewTest, ASmallPictureComesFirstAndThenTheFullOne) {
    std::vector<app::RenderService::Priority> order;
    std::vector<int> widths;
    QObject::connect(volumeView(), &app::ViewWidget::pictureShown,
                     [&](const app::RenderService::Reply& reply) {
                         order.push_back(reply.priority);
                         widths.push_back(reply.picture.width());
                     });
    const int expected = volumeView()->interactiveSize().x;
    volumeView()->setStandardView(AnatomicalView::Left);
    ASSERT_TRUE(settle());
    using Priority = app::RenderService::Priority;
    EXPECT_EQ(order, (std::vector{Priority::Interactive, Priority::Full}));
    EXPECT_EQ(widths, (std::vector{expected, volumeView()->pixelSize().x}));
}

TEST_F(VolumeViewTest, WheelAndRightDragZoomAndMiddleDragPans) {
    turnWheel(volumeView(), 1);
    EXPECT_NEAR(document().scene().camera.zoom, 1.15, 1e-12);
    document().endGesture();
    dragMouse(volumeView(), Qt::RightButton, Qt::NoModifier, {50, 150}, {50, 75});
    EXPECT_NEAR(document().scene().camera.zoom, 1.15 * std::exp(0.5), 1e-12);
    const CameraPose before = *document().scene().camera.pose;
    dragMouse(volumeView(), Qt::MiddleButton, Qt::NoModifier, {50, 50}, {70, 50});
    const CameraPose after = *document().scene().camera.pose;
    EXPECT_LT(after.target.x, before.target.x)
        << "the object goes to the right, so the target goes to the left";
    EXPECT_EQ(after.eye - before.eye, after.target - before.target);
    dragMouse(volumeView(), Qt::RightButton, Qt::ControlModifier, {50, 150}, {50, 75});
    EXPECT_NEAR(glm::distance(document().scene().camera.pose->eye, after.target),
                glm::distance(after.eye, after.target) * std::exp(-0.5), 1e-9);
    dragMouse(volumeView(), Qt::LeftButton, Qt::ControlModifier, {50, 20}, {150, 20});
    EXPECT_EQ(document().undoStack().undoName(), "Roll");
}

TEST_F(VolumeViewTest, ButtonsLettersAndKeypadGiveTheStandardViews) {
    child<QToolButton>("viewS")->click();
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Superior);
    EXPECT_EQ(document().undoStack().undoName(), "View from superior");
    QTest::keyClick(volumeView(), Qt::Key_P);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
    EXPECT_EQ(volumeView()->letters().left, "L");
    QTest::keyClick(volumeView(), Qt::Key_R, Qt::ShiftModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Right);
    QTest::keyClick(volumeView(), Qt::Key_1, Qt::KeypadModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Anterior);
    QTest::keyClick(axial(), Qt::Key_7, Qt::KeypadModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Superior);
    QTest::keyClick(axial(), Qt::Key_End, Qt::KeypadModifier | Qt::ShiftModifier);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
    turnWheel(volumeView(), 3);
    QTest::keyClick(volumeView(), Qt::Key_R);
    EXPECT_FALSE(document().scene().camera.pose);
    EXPECT_EQ(document().scene().camera.zoom, 1.0);
    EXPECT_EQ(document().scene().camera.view, AnatomicalView::Posterior);
}

TEST_F(VolumeViewTest, NothingIsDrawnWhileNothingChanges) {
    int pictures = 0;
    QObject::connect(&window.renderService(), &app::RenderService::replied,
                     [&](const app::RenderService::Reply&) { ++pictures; });
    // A window changes no composite, so only the slices are drawn.
    document().changeItem("window", {}, [](VolumeItem& item) { item.window = Window{0, 100}; });
    ASSERT_TRUE(settle());
    EXPECT_EQ(pictures, 3);
    QTest::qWait(400);  // Longer than the rest after which the full picture is drawn.
    EXPECT_EQ(pictures, 3);
}

}  // namespace
}  // namespace pellucid::test
