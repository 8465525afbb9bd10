// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/theme.h"

#include <QApplication>
#include <QPainter>
#include <QPalette>
#include <QStyleFactory>

namespace pellucid::app {

namespace {

constexpr const char* kStyleSheet = R"(
QToolTip { color: #dfe3e8; background: #2b2f36; border: 1px solid #454b55; padding: 3px; }
QMainWindow::separator { background: #16181c; width: 5px; }
QGroupBox { border: 0; border-top: 1px solid #383d46; margin-top: 18px; padding-top: 6px; font-weight: 600; }
QGroupBox::title { subcontrol-origin: margin; subcontrol-position: top left; left: 0; padding: 2px 6px 2px 0; color: #9fb4cc; }
QScrollArea { border: 0; }
QStatusBar { background: #1b1d22; }
QStatusBar::item { border: 0; }
QStatusBar QLabel { padding: 0 6px; color: #b4bac3; }
QToolBar { background: #24272d; border: 0; border-bottom: 1px solid #16181c; padding: 3px; spacing: 3px; }
QToolBar QToolButton { padding: 4px 9px; border-radius: 3px; }
QToolBar QToolButton:hover { background: #363b44; }
QMenuBar { background: #24272d; }
QDockWidget::title { background: #24272d; padding: 6px; }
#viewHeader QLabel, #viewHeader QToolButton { color: #f2f4f6; font-weight: 600; }
#viewHeader QToolButton { border: 0; border-radius: 2px; padding: 0 5px; }
#viewHeader QToolButton:hover { background: rgba(255, 255, 255, 60); }
#viewHeader QSlider::groove:horizontal { height: 4px; background: rgba(0, 0, 0, 90); border-radius: 2px; }
#viewHeader QSlider::handle:horizontal { width: 10px; margin: -4px 0; background: #f2f4f6; border-radius: 3px; }
#messageBar { border-radius: 4px; }
#messageBar[kind="error"] { background: #5a2a2c; }
#messageBar[kind="warning"] { background: #4d4323; }
#messageBar[kind="note"] { background: #2b3f52; }
)";

}  // namespace

void applyTheme(QApplication& application) {
    application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    QPalette palette;
    const QColor window(0x24, 0x27, 0x2d), base(0x1b, 0x1d, 0x22), text(0xdf, 0xe3, 0xe8),
        accent(0x4a, 0x86, 0xc5);
    const QColor dim(0x7a, 0x81, 0x8c);
    palette.setColor(QPalette::Window, window);
    palette.setColor(QPalette::WindowText, text);
    palette.setColor(QPalette::Base, base);
    palette.setColor(QPalette::AlternateBase, window);
    palette.setColor(QPalette::Text, text);
    palette.setColor(QPalette::PlaceholderText, dim);
    palette.setColor(QPalette::Button, QColor(0x30, 0x34, 0x3c));
    palette.setColor(QPalette::ButtonText, text);
    palette.setColor(QPalette::BrightText, Qt::white);
    palette.setColor(QPalette::ToolTipBase, QColor(0x2b, 0x2f, 0x36));
    palette.setColor(QPalette::ToolTipText, text);
    palette.setColor(QPalette::Highlight, accent);
    palette.setColor(QPalette::HighlightedText, Qt::white);
    palette.setColor(QPalette::Link, accent.lighter(130));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        palette.setColor(QPalette::Disabled, role, dim);
    application.setPalette(palette);
    application.setStyleSheet(QString::fromUtf8(kStyleSheet));
}

QColor colorOf(Plane plane) {
    switch (plane) {
        case Plane::Axial:
            return {0xe0, 0x6c, 0x60};
        case Plane::Coronal:
            return {0x78, 0xb8, 0x6e};
        case Plane::Sagittal:
            break;
    }
    return {0xe0, 0xbe, 0x56};
}

QColor volumeViewColor() {
    return {0x82, 0x9f, 0xd0};
}

QColor barColor(const QColor& color) {
    return color.darker(140);
}

void drawOverlayText(QPainter& painter, const QRectF& where, int flags, const QString& text) {
    painter.setPen(QColor(0, 0, 0, 190));
    for (const QPointF& shift : {QPointF(1, 1), QPointF(-1, 1), QPointF(1, -1), QPointF(-1, -1)})
        painter.drawText(where.translated(shift), flags, text);
    painter.setPen(QColor(0xe8, 0xeb, 0xee));
    painter.drawText(where, flags, text);
}

}  // namespace pellucid::app
