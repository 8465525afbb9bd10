// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/light_panel.h"

#include <QCheckBox>
#include <QFormLayout>
#include <QSignalBlocker>

#include "app/desktop/number_control.h"

namespace pellucid::app {

LightPanel::LightPanel(Document& document, QWidget* parent)
    : QGroupBox(tr("Light"), parent), m_document(document), m_on(new QCheckBox(tr("Lit"), this)) {
    setObjectName(QStringLiteral("lightPanel"));
    m_on->setObjectName(QStringLiteral("lit"));
    auto* form = new QFormLayout(this);
    form->addRow(m_on);
    addSlider("ambient", tr("Ambient"), 1.0, &Material::ambient);
    addSlider("diffuse", tr("Diffuse"), 2.0, &Material::diffuse);
    addSlider("specular", tr("Specular"), 2.0, &Material::specular);
    addSlider("shininess", tr("Shininess"), 128.0, &Material::shininess);
    connect(m_on, &QCheckBox::clicked, this, &LightPanel::switchLight);
    connect(&document, &Document::replaced, this, [this] { m_lightsBefore.reset(); });
    connect(&document, &Document::sceneChanged, this, &LightPanel::sync);
}

NumberControl* LightPanel::addSlider(const char* objectName, const QString& text, double hi,
                                     double Material::*member) {
    const double lo = member == &Material::shininess ? 1.0 : 0.0;
    auto* control = new NumberControl(lo, hi, hi > 10.0 ? 0 : 2, this);
    control->setObjectName(QLatin1String(objectName));
    static_cast<QFormLayout*>(layout())->addRow(text, control);
    m_sliders.push_back({control, member});
    connect(control, &NumberControl::edited, this, [this, text, member](double value) {
        const std::string name = text.toStdString();
        m_document.change(name, name, [&](Scene& scene) { scene.material.*member = value; });
    });
    connect(control, &NumberControl::editEnded, &m_document, &Document::endGesture);
    return control;
}

void LightPanel::sync() {
    const Scene& scene = m_document.scene();
    setVisible(usesLights(scene.mode));
    // Unset means the default: a headlight wherever the mode shades.
    const bool isLit = !scene.lights || !scene.lights->empty();
    m_on->setChecked(isLit);
    for (const Slider& slider : m_sliders) {
        slider.control->setEnabled(isLit);
        slider.control->setValue(scene.material.*slider.member);
    }
}

void LightPanel::switchLight(bool on) {
    if (!on) m_lightsBefore = m_document.scene().lights;
    m_document.change(on ? "Light on" : "Light off", {}, [&](Scene& scene) {
        if (on)
            scene.lights = m_lightsBefore && !m_lightsBefore->empty() ? m_lightsBefore : std::nullopt;
        else
            scene.lights.emplace();
    });
}

}  // namespace pellucid::app
