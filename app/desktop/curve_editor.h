// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QWidget>
#include <optional>

#include "scene/histogram.h"
#include "scene/transfer_function.h"

namespace pellucid::app {

/// A piecewise linear transfer function over the histogram of the values (log counts). Across: physical
/// value; upwards: opacity per unit length, 0 to 1. Drag a point; double-click beside the points adds one, on
/// a point picks its colour; right click or Delete removes it; the wheel magnifies the value axis, the middle
/// button moves it.
class CurveEditor : public QWidget {
    Q_OBJECT

public:
    explicit CurveEditor(QWidget* parent = nullptr);

    void setHistogram(const Histogram& histogram, const QString& unit);
    /// Shows a function; not signalled.
    void setFunction(const TransferFunction1D& function);
    [[nodiscard]] const TransferFunction1D& function() const { return m_function; }
    [[nodiscard]] std::optional<std::size_t> selected() const { return m_selected; }
    void select(std::optional<std::size_t> point);
    void removeSelected();
    void setSelectedColor(const QColor& color);

    /// Where a point shows, in logical pixels, and the value and opacity at a position.
    [[nodiscard]] QPointF positionOf(double value, double opacity) const;
    [[nodiscard]] double valueAt(double x) const;
    [[nodiscard]] double opacityAt(double y) const;
    /// The values from the left to the right edge.
    [[nodiscard]] ValueRange visibleRange() const { return m_visible; }

    [[nodiscard]] QSize sizeHint() const override { return {300, 170}; }

Q_SIGNALS:
    /// `name` says what was done: "Move point", "Add point". Edits of one gesture come with the same name
    /// until editEnded().
    void edited(const pellucid::TransferFunction1D& function, const QString& name);
    void editEnded();
    void selectionChanged();
    void colorAsked();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    [[nodiscard]] QRectF plot() const;
    [[nodiscard]] std::optional<std::size_t> pointAt(QPointF position) const;
    void movePoint(QPointF position);
    void addPoint(QPointF position);
    void commit(const QString& name);
    void showTip(QPointF position, double value, double opacity);
    void limitVisible();
    void paintHistogram(QPainter& painter) const;
    void paintCurve(QPainter& painter) const;
    void paintAxis(QPainter& painter) const;

    Histogram m_histogram;
    QString m_unit;
    TransferFunction1D m_function;
    ValueRange m_visible{0.0, 1.0};
    std::optional<std::size_t> m_selected;
    bool m_dragsPoint = false;
    bool m_dragsAxis = false;
    QPointF m_grip;  ///< From the pointer to the point at the press, so that a press does not move it.
    double m_axisGrip = 0.0;
};

}  // namespace pellucid::app
