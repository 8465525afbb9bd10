// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QGroupBox>

#include "app/desktop/document.h"

class QCheckBox;
class QComboBox;
class QFormLayout;
class QPushButton;

namespace pellucid::app {

class NumberControl;

/// How exactly and against what: reconstruction, step, compositing space, projection, background.
class QualityPanel : public QGroupBox {
    Q_OBJECT

public:
    explicit QualityPanel(Document& document, QWidget* parent = nullptr);

private:
    void connectEdits();
    void sync();
    void pickBackground();

    Document& m_document;
    QFormLayout* m_form;
    QComboBox* m_filter;
    NumberControl* m_step;
    QComboBox* m_space;
    QComboBox* m_projection;
    NumberControl* m_fov;
    QPushButton* m_background;
    QCheckBox* m_dither;
};

}  // namespace pellucid::app
