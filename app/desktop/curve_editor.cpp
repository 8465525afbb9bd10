// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/curve_editor.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace pellucid::app {

namespace {
constexpr double kGrabPx = 8.0;
constexpr double kMargin = 8.0, kAxisHeight = 16.0;
constexpr double kWheelZoom = 1.25;
constexpr double kMinVisibleFraction = 1e-3;  // Of the whole range.
}  // namespace

CurveEditor::CurveEditor(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setFocusPolicy(Qt::ClickFocus);
    setMinimumHeight(150);
    setToolTip(tr(
        "Drag a point to change value and opacity.\nDouble-click: add a point, or pick the colour of one.\n"
        "Right click or Delete: remove.\nWheel: magnify the values; middle button: move them."));
}

void CurveEditor::setHistogram(const Histogram& histogram, const QString& unit) {
    m_histogram = histogram;
    m_unit = unit;
    m_visible = histogram.range;
    limitVisible();
    select(std::nullopt);
}

void CurveEditor::setFunction(const TransferFunction1D& function) {
    m_function = function;
    if (m_selected && *m_selected >= function.points.size()) select(std::nullopt);
    update();
}

void CurveEditor::select(std::optional<std::size_t> point) {
    m_selected = point;
    update();
    Q_EMIT selectionChanged();
}

QRectF CurveEditor::plot() const {
    return QRectF(rect()).adjusted(kMargin, kMargin, -kMargin, -kMargin - kAxisHeight);
}

QPointF CurveEditor::positionOf(double value, double opacity) const {
    const QRectF area = plot();
    const double fraction = (value - m_visible.lo) / (m_visible.hi - m_visible.lo);
    return {area.left() + fraction * area.width(), area.bottom() - opacity * area.height()};
}

double CurveEditor::valueAt(double x) const {
    const QRectF area = plot();
    return m_visible.lo + (x - area.left()) / area.width() * (m_visible.hi - m_visible.lo);
}

double CurveEditor::opacityAt(double y) const {
    const QRectF area = plot();
    return std::clamp((area.bottom() - y) / area.height(), 0.0, 1.0);
}

std::optional<std::size_t> CurveEditor::pointAt(QPointF position) const {
    std::optional<std::size_t> nearest;
    double best = kGrabPx;
    for (std::size_t i = 0; i < m_function.points.size(); ++i) {
        const TransferPoint& point = m_function.points[i];
        const QPointF offset = positionOf(point.value, opacityFromExtinction(point.extinction)) - position;
        const double distance = std::hypot(offset.x(), offset.y());
        if (distance > best) continue;
        best = distance;
        nearest = i;
    }
    return nearest;
}

void CurveEditor::commit(const QString& name) {
    update();
    Q_EMIT edited(m_function, name);
}

void CurveEditor::movePoint(QPointF position) {
    const std::size_t i = *m_selected;
    auto& points = m_function.points;
    const QPointF wanted = position + m_grip;
    // A point stays between its neighbours; at the same value the two make a step.
    const double lo = i > 0 ? points[i - 1].value : std::min(m_histogram.range.lo, points[i].value);
    const double hi =
        i + 1 < points.size() ? points[i + 1].value : std::max(m_histogram.range.hi, points[i].value);
    points[i].value = std::clamp(valueAt(wanted.x()), lo, hi);
    // A height that did not change keeps its exact extinction, which may be beyond what opacity 1 stands for.
    const double opacity = opacityAt(wanted.y());
    if (opacity != opacityFromExtinction(points[i].extinction))
        points[i].extinction = extinctionFromOpacity(opacity);
    showTip(position, points[i].value, opacityFromExtinction(points[i].extinction));
    commit(tr("Move point"));
}

void CurveEditor::addPoint(QPointF position) {
    const double value = std::clamp(valueAt(position.x()), m_histogram.range.lo, m_histogram.range.hi);
    const TransferPoint added{value, evaluate(m_function, value).color,
                              extinctionFromOpacity(opacityAt(position.y()))};
    auto& points = m_function.points;
    const auto after = std::upper_bound(points.begin(), points.end(), value,
                                        [](double v, const TransferPoint& point) { return v < point.value; });
    const auto inserted = points.insert(after, added);
    select(static_cast<std::size_t>(inserted - points.begin()));
    commit(tr("Add point"));
    Q_EMIT editEnded();
}

void CurveEditor::removeSelected() {
    if (!m_selected || m_function.points.size() < 2) return;
    m_function.points.erase(m_function.points.begin() + static_cast<std::ptrdiff_t>(*m_selected));
    select(std::nullopt);
    commit(tr("Remove point"));
    Q_EMIT editEnded();
}

void CurveEditor::setSelectedColor(const QColor& color) {
    if (!m_selected || !color.isValid()) return;

    m_function.points[*m_selected].color = {color.red() / 255.0, color.green() / 255.0, color.blue() / 255.0};
    commit(tr("Colour of a point"));
    Q_EMIT editEnded();
}

void CurveEditor::showTip(QPointF position, double value, double opacity) {
    const QString unit = m_unit.isEmpty() ? QString{} : QLatin1Char(' ') + m_unit;
    const QString text = tr("%1%2, opacity %3").arg(value, 0, 'g', 5).arg(unit).arg(opacity, 0, 'f', 3);
    QToolTip::showText(mapToGlobal(position.toPoint()) + QPoint(12, 12), text, this);
}

void CurveEditor::mousePressEvent(QMouseEvent* event) {
    if (m_function.points.empty()) return;
    const auto hit = pointAt(event->position());
    if (event->button() == Qt::MiddleButton) {
        m_dragsAxis = true;
        m_axisGrip = valueAt(event->position().x());
        return;
    }
    select(hit);
    if (!hit) return;
    if (event->button() == Qt::RightButton) {
        removeSelected();
    } else if (event->button() == Qt::LeftButton) {
        const TransferPoint& point = m_function.points[*hit];
        m_grip = positionOf(point.value, opacityFromExtinction(point.extinction)) - event->position();
        m_dragsPoint = true;
    }
}

void CurveEditor::mouseMoveEvent(QMouseEvent* event) {
    const QPointF position = event->position();
    if (m_dragsPoint && m_selected) return movePoint(position);
    if (m_dragsAxis) {
        const double shift = m_axisGrip - valueAt(position.x());
        m_visible = {m_visible.lo + shift, m_visible.hi + shift};
        limitVisible();
        return update();
    }
    const auto hit = pointAt(position);
    setCursor(hit ? Qt::PointingHandCursor : Qt::CrossCursor);
    if (!hit) return QToolTip::hideText();
    const TransferPoint& point = m_function.points[*hit];
    showTip(position, point.value, opacityFromExtinction(point.extinction));
}

void CurveEditor::mouseReleaseEvent(QMouseEvent*) {
    if (m_dragsPoint) Q_EMIT editEnded();
    m_dragsPoint = m_dragsAxis = false;
}

void CurveEditor::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || m_function.points.empty()) return;
    m_dragsPoint = false;
    if (pointAt(event->position()))
        Q_EMIT colorAsked();
    else
        addPoint(event->position());
}

void CurveEditor::wheelEvent(QWheelEvent* event) {
    const double factor = std::pow(kWheelZoom, -event->angleDelta().y() / 120.0);
    const double fixed = valueAt(event->position().x());
    m_visible = {fixed + (m_visible.lo - fixed) * factor, fixed + (m_visible.hi - fixed) * factor};
    limitVisible();
    update();
}

void CurveEditor::limitVisible() {
    const ValueRange whole = m_histogram.range;
    const double span = whole.hi > whole.lo ? whole.hi - whole.lo : 1.0;
    const double wanted = std::clamp(m_visible.hi - m_visible.lo, span * kMinVisibleFraction, span);
    const double lo = std::clamp(m_visible.lo, whole.lo, whole.lo + span - wanted);
    m_visible = {lo, lo + wanted};
}

void CurveEditor::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace)
        removeSelected();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace pellucid::app
