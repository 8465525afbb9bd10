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

/// How exactly and against what: reconstruction, quality (as the error to keep below, or as step and
/// integrator), compositing space, projection, background.
class QualityPanel : public QGroupBox {
    Q_OBJECT

public:
    explicit QualityPanel(Document& document, QWidget* parent = nullptr);

    /// What the renderer chose for the error asked for. Quality by step starts from it.
    void setChosen(const Quality& chosen) { m_chosen = chosen; }
    /// Shows how long a picture may take while something moves.
    void setFrameTargetMs(double ms);

Q_SIGNALS:
    /// The user's wish; of the program, not of the scene.
    void frameTargetEdited(double ms);

private:
    void build();
    void connectEdits();
    void connectQuality();
    void sync();
    void syncQuality();
    void chooseUnit(int index);
    void pickBackground();

    Document& m_document;
    QFormLayout* m_form;
    QComboBox* m_filter;
    QComboBox* m_unit;
    NumberControl* m_tolerance;
    QComboBox* m_norm;
    NumberControl* m_step;
    QComboBox* m_integrator;
    QComboBox* m_space;
    QComboBox* m_projection;
    NumberControl* m_fov;
    NumberControl* m_frameTarget;
    QPushButton* m_background;
    QCheckBox* m_dither;
    std::optional<Quality> m_chosen;
};

}  // namespace pellucid::app
