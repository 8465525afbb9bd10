// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
// How the curve editor looks; what it does is in curve_editor.cpp.
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "app/desktop/curve_editor.h"

namespace pellucid::app {

namespace {

constexpr double kLabelHeight = 16.0;

QColor shown(glm::dvec3 color, int alpha = 255) {
    const auto byte = [](double channel) { return static_cast<int>(std::lround(channel * 255.0)); };
    return {byte(color.r), byte(color.g), byte(color.b), alpha};
}

}  // namespace

void CurveEditor::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (m_function.points.empty()) return;
    paintHistogram(painter);
    paintCurve(painter);
    paintAxis(painter);
}

void CurveEditor::paintHistogram(QPainter& painter) const {
    const auto& counts = m_histogram.counts;
    if (counts.empty()) return;
    const std::uint64_t most = *std::max_element(counts.begin(), counts.end());
    if (most == 0) return;
    const QRectF area = plot();
    const double binWidth =
        (m_histogram.range.hi - m_histogram.range.lo) / static_cast<double>(counts.size());
    QPainterPath path(QPointF(area.left(), area.bottom()));
    for (double x = area.left(); x <= area.right(); x += 1.0) {
        const double bin = binWidth > 0.0 ? (valueAt(x) - m_histogram.range.lo) / binWidth : 0.0;
        const auto index =
            static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(counts.size() - 1)));
        // log(1 + n): empty bins stay at the bottom, a single voxel still shows.
        const double height =
            std::log1p(static_cast<double>(counts[index])) / std::log1p(static_cast<double>(most));
        path.lineTo(x, area.bottom() - height * area.height());
    }
    path.lineTo(area.right(), area.bottom());
    path.closeSubpath();
    painter.fillPath(path, QColor(255, 255, 255, 34));
}

void CurveEditor::paintCurve(QPainter& painter) const {
    const QRectF area = plot();
    // Sampled per pixel, because between two points the extinction is linear and the opacity is not.
    QPainterPath curve;
    QLinearGradient colors(area.topLeft(), area.topRight());
    for (double x = area.left(); x <= area.right(); x += 1.0) {
        const OpticalSample sample = evaluate(m_function, valueAt(x));
        const QPointF at(x, area.bottom() - opacityFromExtinction(sample.extinction) * area.height());
        if (curve.elementCount() == 0)
            curve.moveTo(at);
        else
            curve.lineTo(at);
    }
    constexpr int kColorStops = 128;
    for (int i = 0; i <= kColorStops; ++i) {
        const double fraction = static_cast<double>(i) / kColorStops;
        const double value = m_visible.lo + fraction * (m_visible.hi - m_visible.lo);
        colors.setColorAt(fraction, shown(evaluate(m_function, value).color, 150));
    }
    QPainterPath below = curve;
    below.lineTo(area.bottomRight());
    below.lineTo(area.bottomLeft());
    below.closeSubpath();
    painter.fillPath(below, colors);
    painter.setPen(QPen(QColor(0xdf, 0xe3, 0xe8), 1.5));
    painter.drawPath(curve);

    painter.setClipRect(area.adjusted(-6, -6, 6, 6));
    for (std::size_t i = 0; i < m_function.points.size(); ++i) {
        const TransferPoint& point = m_function.points[i];
        const bool isSelected = m_selected == i;
        painter.setPen(QPen(isSelected ? palette().color(QPalette::Highlight) : QColor(0xdf, 0xe3, 0xe8),
                            isSelected ? 2.5 : 1.2));
        painter.setBrush(shown(point.color));
        const double radius = isSelected ? 5.5 : 4.5;
        painter.drawEllipse(positionOf(point.value, opacityFromExtinction(point.extinction)), radius, radius);
    }
    painter.setClipping(false);
}

void CurveEditor::paintAxis(QPainter& painter) const {
    const QRectF area = plot();
    painter.setPen(QColor(0x55, 0x5c, 0x67));
    painter.drawLine(area.bottomLeft(), area.bottomRight());
    QFont font = painter.font();
    font.setPointSizeF(font.pointSizeF() * 0.85);
    painter.setFont(font);
    painter.setPen(palette().color(QPalette::PlaceholderText));
    const QRectF labels(area.left(), area.bottom() + 2, area.width(), kLabelHeight);
    painter.drawText(labels, Qt::AlignLeft | Qt::AlignVCenter, QString::number(m_visible.lo, 'g', 5));
    painter.drawText(labels, Qt::AlignHCenter | Qt::AlignVCenter, m_unit);
    painter.drawText(labels, Qt::AlignRight | Qt::AlignVCenter, QString::number(m_visible.hi, 'g', 5));
}

}  // namespace pellucid::app
