// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QSlider>

#include "scene/image.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

using SliceViewTest = GuiTest;

QImage drawnByAnotherRenderer(const Scene& scene, const std::vector<VolumePtr>& volumes) {
    auto renderer = renderer::Renderer::headless().value();
    const renderer::Frame frame = renderer.render(scene, volumes).value();
    const Image8 bytes = quantise(frame.image, false, scene.quality.dither);
    return QImage(bytes.bytes.data(), bytes.size.x, bytes.size.y, 3 * bytes.size.x, QImage::Format_RGB888)
        .copy();
}

TEST_F(SliceViewTest, ShowsThePictureOfItsSceneInDevicePixels) {
    for (app::SliceView* view : {axial(), coronal(), sagittal()}) {
        const glm::ivec2 size = view->pixelSize();
        EXPECT_EQ(view->picture().size(), QSize(size.x, size.y));
        EXPECT_EQ(view->picture(), drawnByAnotherRenderer(view->shownScene(), document().volumes()));
    }
    // The bright ball is in the middle, air at the edge: not three black pictures.
    const QImage& picture = axial()->picture();
    EXPECT_EQ(qGray(picture.pixel(picture.width() / 2 + 20, picture.height() / 2)), 255);
    EXPECT_EQ(qGray(picture.pixel(1, 1)), 0);
}

TEST_F(SliceViewTest, OrientationLettersFollowTheRadiologicalConvention) {
    EXPECT_EQ(axial()->letters(), (EdgeLetters{"R", "L", "A", "P"}));
    EXPECT_EQ(coronal()->letters(), (EdgeLetters{"R", "L", "S", "I"}));
    EXPECT_EQ(sagittal()->letters(), (EdgeLetters{"A", "P", "S", "I"}));
}

TEST_F(SliceViewTest, LettersArePaintedAtTheEdges) {
    const auto bright = [](const QImage& image, QRect where) {
        int count = 0;
        for (int y = where.top(); y <= where.bottom(); ++y)
            for (int x = where.left(); x <= where.right(); ++x) count += qGray(image.pixel(x, y)) > 150;
        return count;
    };
    app::SliceView* view = axial();
    view->setShowsCrosshair(false);
    const QRect left(2, view->height() / 2 - 14, 24, 28);
    EXPECT_GT(bright(view->grab().toImage(), left), 10);
    view->setShowsOverlay(false);
    EXPECT_EQ(bright(view->grab().toImage(), left), 0);
}

TEST_F(SliceViewTest, LeftDragSetsTheWindowByTheExpectedNumbers) {
    const Window before{40, 400};  // The file's window.
    ASSERT_EQ(document().item().window, before);
    const QPoint from(100, 100);
    dragMouse(axial(), Qt::LeftButton, Qt::NoModifier, from, from + QPoint(64, 32));
    // 256 pixels change a value by the width at the start: 400 / 256 a pixel; to the right wider, downwards a
    // higher level.
    EXPECT_EQ(document().item().window, (Window{40 + 32 * 400.0 / 256, 400 + 64 * 400.0 / 256}));
    EXPECT_EQ(document().undoStack().undoName(), "Window and level");
    document().undo();
    EXPECT_EQ(document().item().window, before);
    EXPECT_FALSE(document().undoStack().canUndo());
    ASSERT_TRUE(settle());
    // All slices share the window.
    dragMouse(axial(), Qt::LeftButton, Qt::NoModifier, from, from + QPoint(-60, 0));
    EXPECT_EQ(coronal()->shownScene().volumes.front().window, document().item().window);
}

TEST_F(SliceViewTest, WheelMovesBySlices) {
    const glm::dvec3 before = document().crosshairMm();
    turnWheel(axial(), 1);
    EXPECT_EQ(document().crosshairMm(), before + glm::dvec3(0, 0, 4));
    turnWheel(coronal(), -2);
    EXPECT_EQ(document().crosshairMm(), before + glm::dvec3(0, 6, 4));
    turnWheel(sagittal(), 1);
    EXPECT_EQ(document().crosshairMm(), before + glm::dvec3(-2, 6, 4));
    turnWheel(axial(), 1000);
    EXPECT_EQ(document().crosshairMm().z, -40 + 15 * 4);
    EXPECT_FALSE(document().undoStack().canUndo()) << "looking around is not a change of the scene";
}

TEST_F(SliceViewTest, KeysMoveBySlices) {
    const glm::dvec3 before = document().crosshairMm();
    QTest::keyClick(axial(), Qt::Key_Down);
    EXPECT_EQ(document().crosshairMm(), before - glm::dvec3(0, 0, 4));
    QTest::keyClick(axial(), Qt::Key_Up);
    QTest::keyClick(axial(), Qt::Key_PageDown);
    EXPECT_EQ(document().crosshairMm().z, std::max(before.z - 40, -40.0));
}

TEST_F(SliceViewTest, TheSliderInTheBarMovesTheSlice) {
    auto* slider = childOf<QSlider>("axialFrame", "sliceSlider");
    EXPECT_EQ(slider->maximum(), 15);
    slider->setValue(3);
    EXPECT_EQ(document().crosshairMm().z, -40 + 3 * 4);
    turnWheel(axial(), 1);
    EXPECT_EQ(slider->value(), 4);
}

TEST_F(SliceViewTest, ControlClickSetsTheCrosshairForAllViews) {
    const QPointF wanted = axial()->positionOf({10, 12, 0});
    dragMouse(axial(), Qt::LeftButton, Qt::ControlModifier, wanted.toPoint(), wanted.toPoint());
    // Voxel centres at -20 + 2 i and -30 + 3 j; 10 and 12 are such.
    EXPECT_EQ(document().crosshairMm().x, 10);
    EXPECT_EQ(document().crosshairMm().y, 12);
    EXPECT_NEAR(sagittal()->shownScene().camera.pose->target.x, 10, 1e-9);
    EXPECT_NEAR(coronal()->shownScene().camera.pose->target.y, 12, 1e-9);
}

TEST_F(SliceViewTest, MiddleDragPansAndRightDragZooms) {
    const glm::dvec3 patient(4, 6, document().crosshairMm().z);
    const QPointF before = axial()->positionOf(patient);
    dragMouse(axial(), Qt::MiddleButton, Qt::NoModifier, {80, 80}, {110, 60});
    EXPECT_NEAR(axial()->positionOf(patient).x(), before.x() + 30, 1e-9);
    EXPECT_NEAR(axial()->positionOf(patient).y(), before.y() - 20, 1e-9);
    const double mmPerPixel = axial()->patientAt({1, 0}).x - axial()->patientAt({0, 0}).x;
    dragMouse(axial(), Qt::RightButton, Qt::NoModifier, {80, 130}, {80, 80});
    EXPECT_NEAR(axial()->placement().zoom, std::exp(50.0 / 150.0), 1e-12);
    EXPECT_NEAR(axial()->patientAt({1, 0}).x - axial()->patientAt({0, 0}).x,
                mmPerPixel / std::exp(50.0 / 150.0), 1e-9);
    QTest::keyClick(axial(), Qt::Key_R);
    EXPECT_EQ(axial()->placement(), app::SlicePlacement{});
}

TEST_F(SliceViewTest, TheProbeTellsValuePositionAndVoxel) {
    // Voxel (14, 10, 8): 2 voxels from the ball's centre, so 700 + i.
    document().setCrosshairMm({-20 + 2 * 14, -30 + 3 * 10, -40 + 4 * 8});
    const QPointF at = axial()->positionOf(document().crosshairMm());
    EXPECT_EQ(axial()->probeText(at), QStringLiteral("714 HU   L 8.0  P 0.0  I 8.0 mm   voxel 14, 10, 8"));
    EXPECT_EQ(axial()->probeText({-1000, -1000}), QString());
    QMouseEvent move(QEvent::MouseMove, at, axial()->mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                     Qt::NoModifier);
    QApplication::sendEvent(axial(), &move);
    EXPECT_TRUE(child<QLabel>("probe")->text().startsWith(QStringLiteral("714 HU")));
}

TEST_F(SliceViewTest, DoubleClickMaximisesAndRestores) {
    QTest::mouseDClick(coronal(), Qt::LeftButton);
    EXPECT_TRUE(coronal()->isVisible());
    EXPECT_FALSE(axial()->isVisible());
    EXPECT_FALSE(volumeView()->isVisible());
    ASSERT_TRUE(waitFor([this] { return coronal()->isSettled(); }));
    EXPECT_EQ(coronal()->picture().width(), coronal()->pixelSize().x);
    QTest::mouseDClick(coronal(), Qt::LeftButton);
    EXPECT_TRUE(axial()->isVisible());
    EXPECT_TRUE(settle());
}

TEST_F(SliceViewTest, DigitsSelectWindows) {
    QTest::keyClick(axial(), Qt::Key_2);
    EXPECT_EQ(document().item().window, (Window{-600, 1500}));
    EXPECT_EQ(document().undoStack().undoName(), "Window: Lung");
    QTest::keyClick(axial(), Qt::Key_0);
    // Values from -1000 (i = 0, air) to 700 + 16 (the ball reaches i = 16).
    EXPECT_EQ(document().item().window, (Window{-142, 1716}));
}

}  // namespace
}  // namespace pellucid::test
