// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QFrame>

#include "app/desktop/document.h"
#include "app/desktop/slice_view.h"
#include "app/desktop/volume_view.h"

class QHBoxLayout;

namespace pellucid::app {

/// A view under its coloured bar: the plane's name with a slider through the slices, or "3D" with the
/// standard views.
class ViewFrame : public QFrame {
    Q_OBJECT

public:
    ViewFrame(SliceView* view, Document& document, QWidget* parent = nullptr);
    ViewFrame(VolumeView* view, Document& document, QWidget* parent = nullptr);

    [[nodiscard]] ViewWidget* view() const { return m_view; }

private:
    QHBoxLayout* build(const QString& title, const QColor& color);

    ViewWidget* m_view;
};

}  // namespace pellucid::app
