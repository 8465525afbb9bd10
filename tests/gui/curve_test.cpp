// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/curve_editor.h"
#include "tests/gui/gui_support.h"

namespace pellucid::test {
namespace {

class CurveTest : public GuiTest {
protected:
    app::CurveEditor* curve() { return child<app::CurveEditor>("curveEditor"); }
    QPoint place(std::size_t point) {
        const TransferPoint& p = curve()->function().points[point];
        return curve()->positionOf(p.value, opacityFromExtinction(p.extinction)).toPoint();
    }
    void SetUp() override {
        GuiTest::SetUp();
        TransferFunction1D function{
            "three", "HU", {{-500, {1, 0, 0}, 0.0}, {100, {0, 1, 0}, 0.5}, {600, {0, 0, 1}, 1.0}}};
        document().changeItem("start", {}, [&](VolumeItem& item) { item.transferFunction = function; });
    }
};

TEST_F(CurveTest, DraggingAPointMovesItAsOneUndoableStep) {
    const Scene before = document().scene();
    const QPoint from = place(1), to = from + QPoint(20, -15);
    dragMouse(curve(), Qt::LeftButton, Qt::NoModifier, from, to);
    const TransferPoint moved = document().item().transferFunction->points[1];
    // The press is within half a pixel of the point and does not move it, so it moves by exactly the distance
    // dragged.
    const double perPixel = curve()->valueAt(1.0) - curve()->valueAt(0.0);
    EXPECT_NEAR(moved.value, 100 + 20 * perPixel, 1e-9);
    EXPECT_NEAR(opacityFromExtinction(moved.extinction),
                opacityFromExtinction(0.5) + 15 * (curve()->opacityAt(50) - curve()->opacityAt(51)), 1e-9);
    EXPECT_EQ(document().undoStack().undoName(), "Move point");
    document().undo();
    EXPECT_EQ(document().scene(), before);
    EXPECT_EQ(curve()->function().points[1].value, 100);
}

TEST_F(CurveTest, APointStaysBetweenItsNeighbours) {
    dragMouse(curve(), Qt::LeftButton, Qt::NoModifier, place(1), place(1) + QPoint(1000, 0));
    EXPECT_EQ(document().item().transferFunction->points[1].value, 600);
    EXPECT_TRUE(validate(document().scene()));
}

TEST_F(CurveTest, DoubleClickAddsAPointOfTheColourThere) {
    const QPoint where = curve()->positionOf(-200, 0.8).toPoint();
    QTest::mouseDClick(curve(), Qt::LeftButton, Qt::NoModifier, where);
    const auto& points = document().item().transferFunction->points;
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[1].value, curve()->valueAt(where.x()));
    EXPECT_NEAR(points[1].color.r, 1.0 - (points[1].value + 500) / 600, 1e-12);
    EXPECT_NEAR(opacityFromExtinction(points[1].extinction), curve()->opacityAt(where.y()), 1e-12);
    EXPECT_EQ(document().undoStack().undoName(), "Add point");
}

TEST_F(CurveTest, RightClickAndDeleteRemoveButNeverTheLastPoint) {
    QTest::mouseClick(curve(), Qt::RightButton, Qt::NoModifier, place(1));
    ASSERT_EQ(document().item().transferFunction->points.size(), 2u);
    EXPECT_EQ(document().item().transferFunction->points[1].value, 600);
    curve()->select(1);
    QTest::keyClick(curve(), Qt::Key_Delete);
    curve()->select(0);
    QTest::keyClick(curve(), Qt::Key_Delete);
    EXPECT_EQ(document().item().transferFunction->points.size(), 1u);
    EXPECT_EQ(document().undoStack().undoName(), "Remove point");
}

TEST_F(CurveTest, AColourGoesToTheSelectedPoint) {
    curve()->select(2);
    curve()->setSelectedColor(QColor(255, 51, 0));
    EXPECT_EQ(document().item().transferFunction->points[2].color, glm::dvec3(1.0, 0.2, 0.0));
    EXPECT_EQ(document().undoStack().undoName(), "Colour of a point");
}

TEST_F(CurveTest, TheWheelMagnifiesAboutThePointer) {
    const double under = curve()->valueAt(curve()->rect().center().x());
    turnWheel(curve(), 2);
    EXPECT_NEAR(curve()->valueAt(curve()->rect().center().x()), under, 1e-9);
    const ValueRange visible = curve()->visibleRange();
    EXPECT_NEAR(visible.hi - visible.lo, 1716 / (1.25 * 1.25), 1e-9);
    EXPECT_EQ(document().undoStack().undoName(), "start");
}

}  // namespace
}  // namespace pellucid::test
