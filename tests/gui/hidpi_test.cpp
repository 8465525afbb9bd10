// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// With a scale of two the views are drawn with twice the pixels each way. A program of its own, because the
// scale is read when the application starts.
#include <QApplication>
#include <QSettings>
#include <QTemporaryDir>

#include "tests/gui/display.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

using HiDpiTest = GuiTest;

TEST_F(HiDpiTest, PicturesHaveTwiceTheLogicalSize) {
    ASSERT_EQ(window.devicePixelRatioF(), 2.0);
    for (const app::ViewWidget* view :
         std::vector<app::ViewWidget*>{axial(), coronal(), sagittal(), volumeView()})
        EXPECT_EQ(view->picture().size(), view->size() * 2);
}

TEST_F(HiDpiTest, TheMouseStillWorksInLogicalPixels) {
    const glm::dvec3 patient(10, 12, document().crosshairMm().z);
    const QPointF at = axial()->positionOf(patient);
    EXPECT_TRUE(QRectF(axial()->rect()).contains(at));
    EXPECT_NEAR(axial()->patientAt(at).x, 10, 1e-9);
    dragMouse(axial(), Qt::LeftButton, Qt::ControlModifier, at.toPoint(), at.toPoint());
    EXPECT_EQ(document().crosshairMm(), patient);
}

}  // namespace
}  // namespace pellucid::test

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    if (pellucid::test::onlyListsTests()) return RUN_ALL_TESTS();
    pellucid::test::provideDisplay();
    qputenv("QT_SCALE_FACTOR", "2");
    QApplication application(argc, argv);
    QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    return RUN_ALL_TESTS();
}
