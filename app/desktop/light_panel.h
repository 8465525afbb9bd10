// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QGroupBox>
#include <optional>
#include <vector>

#include "app/desktop/document.h"

class QCheckBox;

namespace pellucid::app {

class NumberControl;

/// Light on or off and the material. Hidden in modes that do not shade.
class LightPanel : public QGroupBox {
    Q_OBJECT

public:
    explicit LightPanel(Document& document, QWidget* parent = nullptr);

private:
    void sync();
    void switchLight(bool on);
    NumberControl* addSlider(const char* objectName, const QString& text, double hi,
                             double Material::*member);

    struct Slider {
        NumberControl* control;
        double Material::*member;
    };
    Document& m_document;
    QCheckBox* m_on;
    std::vector<Slider> m_sliders;
    std::optional<std::vector<Light>>
        m_lightsBefore;  ///< What switching off put out, for switching on again.
};

}  // namespace pellucid::app
