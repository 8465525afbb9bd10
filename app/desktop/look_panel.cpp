// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/look_panel.h"

#include <QColorDialog>
#include <QComboBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "app/desktop/curve_editor.h"
#include "app/desktop/number_control.h"

namespace pellucid::app {

namespace {

constexpr int kFirstPreset = 2;  // After "Own" and "From the data".

struct ModeText {
    Mode mode;
    const char* text;
};
// What the 3D view offers; slices have their own views.
constexpr ModeText kModes[] = {
    {Mode::Composite, "Composite"}, {Mode::Mip, "Maximum (MIP)"},    {Mode::MinIp, "Minimum (MinIP)"},
    {Mode::Average, "Average"},     {Mode::XRay, "X-ray"},           {Mode::Emission, "Emission"},
    {Mode::FirstHit, "First hit"},  {Mode::Isosurface, "Isosurface"}};

}  // namespace

std::vector<VolumePreset> presetsFor(const std::string& modality) {
    std::vector<VolumePreset> presets = volumePresets();
    std::stable_partition(presets.begin(), presets.end(),
                          [&](const VolumePreset& preset) { return preset.modality == modality; });
    return presets;
}

LookPanel::LookPanel(Document& document, QWidget* parent)
    : QGroupBox(tr("Look"), parent),
      m_document(document),
      m_mode(new QComboBox(this)),
      m_preset(new QComboBox(this)),
      m_curve(new CurveEditor(this)),
      m_curveButtons(new QWidget(this)),
      m_color(new QPushButton(tr("Colour..."), m_curveButtons)),
      m_remove(new QPushButton(tr("Remove point"), m_curveButtons)),
      m_density(new NumberControl(0.0, 4.0, 2, this)),
      m_isovalue(new NumberControl(0.0, 1.0, 1, this)),
      m_hitOpacity(new NumberControl(0.01, 1.0, 2, this)),
      m_xray(new QComboBox(this)) {
    build();
    connectEdits();
    connect(&document, &Document::replaced, this, &LookPanel::fill);
    connect(&document, &Document::sceneChanged, this, &LookPanel::sync);
}

void LookPanel::build() {
    setObjectName(QStringLiteral("lookPanel"));
    m_mode->setObjectName(QStringLiteral("mode"));
    m_preset->setObjectName(QStringLiteral("volumePreset"));
    m_curve->setObjectName(QStringLiteral("curveEditor"));
    m_color->setObjectName(QStringLiteral("pointColor"));
    m_remove->setObjectName(QStringLiteral("removePoint"));
    m_density->setObjectName(QStringLiteral("density"));
    m_isovalue->setObjectName(QStringLiteral("isovalue"));
    m_hitOpacity->setObjectName(QStringLiteral("hitOpacity"));
    m_xray->setObjectName(QStringLiteral("xray"));
    for (const ModeText& mode : kModes) m_mode->addItem(tr(mode.text));
    m_xray->addItem(tr("Bone dark (transmittance)"));
    m_xray->addItem(tr("Bone bright (opacity)"));
    m_density->setToolTip(
        tr("Multiplies the density of everything: above 1 more opaque, below 1 more transparent."));
    m_hitOpacity->setToolTip(tr("A ray stops at the first point at least this opaque."));

    auto* buttons = new QHBoxLayout(m_curveButtons);
    buttons->setContentsMargins(0, 0, 0, 0);
    buttons->addWidget(m_color);
    buttons->addWidget(m_remove);
    buttons->addStretch(1);
    m_form = new QFormLayout(this);
    m_form->addRow(tr("Mode"), m_mode);
    m_form->addRow(tr("Shown as"), m_xray);
    m_form->addRow(tr("Preset"), m_preset);
    m_form->addRow(m_curve);
    m_form->addRow(m_curveButtons);
    m_form->addRow(tr("Density"), m_density);
    m_form->addRow(tr("Isovalue"), m_isovalue);
    m_form->addRow(tr("Hit opacity"), m_hitOpacity);
}

void LookPanel::connectEdits() {
    connect(m_mode, &QComboBox::activated, this, [this](int index) {
        m_document.change("Mode: " + m_mode->itemText(index).toStdString(), {},
                          [&](Scene& scene) { scene.mode = kModes[index].mode; });
    });
    connect(m_xray, &QComboBox::activated, this, [this](int index) {
        m_document.change("X-ray display", {},
                          [&](Scene& scene) { scene.xray = static_cast<XRayDisplay>(index); });
    });
    connect(m_preset, &QComboBox::activated, this, &LookPanel::choosePreset);
    connect(m_curve, &CurveEditor::edited, this,
            [this](const TransferFunction1D& function, const QString& name) {
                m_document.changeItem(name.toStdString(), "curve: " + name.toStdString(),
                                      [&](VolumeItem& item) { item.transferFunction = function; });
            });
    connect(m_curve, &CurveEditor::selectionChanged, this, [this] {
        m_color->setEnabled(m_curve->selected().has_value());
        m_remove->setEnabled(m_curve->selected().has_value());
    });
    connect(m_curve, &CurveEditor::colorAsked, this, &LookPanel::pickColor);
    connect(m_color, &QPushButton::clicked, this, &LookPanel::pickColor);
    connect(m_remove, &QPushButton::clicked, m_curve, &CurveEditor::removeSelected);
    connect(m_density, &NumberControl::edited, this, [this](double value) {
        m_document.change("Density", "density", [&](Scene& scene) { scene.densityScale = value; });
    });
    connect(m_isovalue, &NumberControl::edited, this, [this](double value) {
        m_document.changeItem("Isovalue", "isovalue", [&](VolumeItem& item) { item.isovalue = value; });
    });
    connect(m_hitOpacity, &NumberControl::edited, this, [this](double value) {
        m_document.change("Hit opacity", "hit opacity", [&](Scene& scene) { scene.hitOpacity = value; });
    });
    connect(m_curve, &CurveEditor::editEnded, &m_document, &Document::endGesture);
    for (NumberControl* control : {m_density, m_isovalue, m_hitOpacity})
        connect(control, &NumberControl::editEnded, &m_document, &Document::endGesture);
}

void LookPanel::fill() {
    const Volume& volume = m_document.volume();
    m_presets = presetsFor(volume.info().modality);
    m_preset->clear();
    m_preset->addItem(tr("Own"));
    m_preset->addItem(tr("From the data"));
    for (const VolumePreset& preset : m_presets) m_preset->addItem(QString::fromStdString(preset.name));
    m_curve->setHistogram(m_document.histogram(), QString::fromStdString(volume.mapping().unit));

    const ValueRange range = volume.physicalRange(m_document.item().component);
    const double span = range.hi > range.lo ? range.hi - range.lo : 1.0;
    m_isovalue->setRange(range.lo, range.lo + span,
                         std::clamp(static_cast<int>(std::ceil(3.0 - std::log10(span))), 0, 8));
}

void LookPanel::sync() {
    const Scene& scene = m_document.scene();
    const VolumeItem& item = m_document.item();
    const auto isCurrent = [&](const ModeText& mode) { return mode.mode == scene.mode; };
    const auto mode = std::find_if(std::begin(kModes), std::end(kModes), isCurrent);
    m_mode->setCurrentIndex(mode == std::end(kModes) ? -1 : static_cast<int>(mode - std::begin(kModes)));

    // Several surfaces have values and colours of their own.
    const bool hasSurfaces = scene.mode == Mode::Isosurface && !item.isosurfaces.empty();
    const bool usesCurve = usesTransferFunction(scene.mode) && !hasSurfaces;
    m_form->setRowVisible(m_preset, usesCurve);
    m_form->setRowVisible(m_curve, usesCurve);
    m_form->setRowVisible(m_curveButtons, usesCurve);
    m_form->setRowVisible(m_density, usesTransferFunction(scene.mode) && scene.mode != Mode::Isosurface);
    m_form->setRowVisible(m_isovalue, scene.mode == Mode::Isosurface && !hasSurfaces);
    m_form->setRowVisible(m_hitOpacity, scene.mode == Mode::FirstHit);
    m_form->setRowVisible(m_xray, scene.mode == Mode::XRay);

    const TransferFunction1D& function = item.transferFunction.value();
    m_curve->setFunction(function);
    m_color->setEnabled(m_curve->selected().has_value());
    m_remove->setEnabled(m_curve->selected().has_value());
    const auto preset = std::find_if(m_presets.begin(), m_presets.end(), [&](const VolumePreset& candidate) {
        return candidate.function == function;
    });
    if (preset != m_presets.end())
        m_preset->setCurrentIndex(static_cast<int>(preset - m_presets.begin()) + kFirstPreset);
    else
        m_preset->setCurrentIndex(function == m_document.dataFunction() ? 1 : 0);
    m_density->setValue(scene.densityScale);
    m_isovalue->setValue(item.isovalue.value_or(0.0));
    m_hitOpacity->setValue(scene.hitOpacity);
    m_xray->setCurrentIndex(static_cast<int>(scene.xray));
}

void LookPanel::choosePreset(int index) {
    if (index < 1) return sync();
    if (index == 1) {
        m_document.changeItem("Preset: From the data", {},
                              [&](VolumeItem& item) { item.transferFunction = m_document.dataFunction(); });
        return;
    }
    const VolumePreset& preset = m_presets[static_cast<std::size_t>(index - kFirstPreset)];
    m_document.change("Preset: " + preset.name, {}, [&](Scene& scene) {
        scene.volumes.front().transferFunction = preset.function;
        scene.material = preset.material;
    });
}

void LookPanel::pickColor() {
    if (!m_curve->selected()) return;
    const glm::dvec3 color = m_curve->function().points[*m_curve->selected()].color;
    m_curve->setSelectedColor(
        QColorDialog::getColor(QColor::fromRgbF(static_cast<float>(color.r), static_cast<float>(color.g),
                                                static_cast<float>(color.b)),
                               this, tr("Colour of the point")));
}

}  // namespace pellucid::app
