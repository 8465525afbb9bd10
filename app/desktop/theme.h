// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>

#include "app/desktop/view_scenes.h"

class QApplication;
class QPainter;
class QRectF;
class QString;

namespace pellucid::app {

/// A calm dark look, so that the pictures are the brightest thing on the screen.
void applyTheme(QApplication& application);

/// The planes' colours: bars, crosshair lines. Red, green and yellow as in 3D Slicer, muted.
[[nodiscard]] QColor colorOf(Plane plane);
[[nodiscard]] QColor volumeViewColor();
/// The same, darker, for the bars: a large area of the full colour would outshine the pictures.
[[nodiscard]] QColor barColor(const QColor& color);

/// Text that reads on any picture: light with a dark edge. `flags` as in QPainter::drawText.
void drawOverlayText(QPainter& painter, const QRectF& where, int flags, const QString& text);

}  // namespace pellucid::app
