// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QGroupBox>
#include <vector>

#include "app/desktop/document.h"
#include "scene/presets.h"

class QComboBox;
class QFormLayout;
class QPushButton;

namespace pellucid::app {

class CurveEditor;
class NumberControl;

/// How the volume becomes a picture: mode, preset, curve, and the numbers that belong to the mode. Shows only
/// what the current mode uses.
class LookPanel : public QGroupBox {
    Q_OBJECT

public:
    explicit LookPanel(Document& document, QWidget* parent = nullptr);

private:
    void build();
    void connectEdits();
    void fill();
    void sync();
    void choosePreset(int index);
    void pickColor();

    Document& m_document;
    QFormLayout* m_form = nullptr;
    QComboBox* m_mode;
    QComboBox* m_preset;
    CurveEditor* m_curve;
    QWidget* m_curveButtons;
    QPushButton* m_color;
    QPushButton* m_remove;
    NumberControl* m_density;
    NumberControl* m_isovalue;
    NumberControl* m_hitOpacity;
    QComboBox* m_xray;
    std::vector<VolumePreset> m_presets;  ///< As in the combo box, after "Own" and "From the data".
};

/// The volume presets, those for the modality first.
[[nodiscard]] std::vector<VolumePreset> presetsFor(const std::string& modality);

}  // namespace pellucid::app
