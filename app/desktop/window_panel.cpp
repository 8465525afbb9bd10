// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/desktop/window_panel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "app/desktop/number_control.h"
#include "scene/presets.h"

namespace pellucid::app {

namespace {

NamedWindow wholeRange(const Volume& volume, int component) {
    const ValueRange range = volume.physicalRange(component);
    return {"Full range", {(range.lo + range.hi) / 2.0, range.hi > range.lo ? range.hi - range.lo : 1.0}};
}

// NIfTI and raw files carry no unit; there the scene's function may.
bool isHounsfield(const Volume& volume, const VolumeItem& item) {
    return volume.mapping().unit == "HU" || volume.info().modality == "CT" ||
           (item.transferFunction && item.transferFunction->unit == "HU");
}

}  // namespace

std::vector<NamedWindow> windowsFor(const Volume& volume, const VolumeItem& item) {
    std::vector<NamedWindow> windows;
    for (const NamedWindow& window : volume.info().windows)
        windows.push_back({window.name.empty() ? "From the file" : window.name, window.window});
    if (isHounsfield(volume, item))
        for (const WindowPreset& preset : ctWindowPresets()) windows.push_back({preset.name, preset.window});
    windows.push_back(wholeRange(volume, item.component));
    return windows;
}

std::optional<NamedWindow> windowForKey(const Volume& volume, const VolumeItem& item, int key) {
    if (key == 0) return wholeRange(volume, item.component);
    if (!isHounsfield(volume, item)) return std::nullopt;
    for (const WindowPreset& preset : ctWindowPresets())
        if (preset.key == key) return NamedWindow{preset.name, preset.window};
    return std::nullopt;
}

WindowPanel::WindowPanel(Document& document, QWidget* parent)
    : QGroupBox(tr("Window"), parent),
      m_document(document),
      m_preset(new QComboBox(this)),
      m_width(new NumberControl(0, 1, 0, this)),
      m_level(new NumberControl(0, 1, 0, this)) {
    setObjectName(QStringLiteral("windowPanel"));
    m_preset->setObjectName(QStringLiteral("windowPreset"));
    m_width->setObjectName(QStringLiteral("windowWidth"));
    m_level->setObjectName(QStringLiteral("windowLevel"));
    auto* form = new QFormLayout(this);
    form->addRow(tr("Preset"), m_preset);
    form->addRow(tr("Width"), m_width);
    form->addRow(tr("Level"), m_level);

    connect(m_preset, &QComboBox::activated, this, &WindowPanel::choose);
    connect(m_width, &NumberControl::edited, this, [this](double width) {
        m_document.changeItem("Window width", "window width",
                              [&](VolumeItem& item) { item.window->width = width; });
    });
    connect(m_level, &NumberControl::edited, this, [this](double level) {
        m_document.changeItem("Window level", "window level",
                              [&](VolumeItem& item) { item.window->level = level; });
    });
    connect(m_width, &NumberControl::editEnded, &document, &Document::endGesture);
    connect(m_level, &NumberControl::editEnded, &document, &Document::endGesture);
    connect(&document, &Document::replaced, this, &WindowPanel::fill);
    connect(&document, &Document::sceneChanged, this, &WindowPanel::sync);
}

void WindowPanel::fill() {
    const Volume& volume = m_document.volume();
    const int component = m_document.item().component;
    m_windows = windowsFor(volume, m_document.item());
    m_preset->clear();
    m_preset->addItem(tr("Own"));
    for (const NamedWindow& window : m_windows) m_preset->addItem(QString::fromStdString(window.name));

    const ValueRange range = volume.physicalRange(component);
    const double span = range.hi > range.lo ? range.hi - range.lo : 1.0;
    // Three digits more than the range has, so that small-valued data can be set as finely as HU.
    const int decimals = std::clamp(static_cast<int>(std::ceil(3.0 - std::log10(span))), 0, 8);
    const double smallest = std::pow(10.0, -decimals);
    m_width->setRange(smallest, std::max(span * 1.5, 2.0 * smallest), decimals);
    m_level->setRange(range.lo - span / 2.0, range.hi + span / 2.0, decimals);
}

void WindowPanel::sync() {
    const Window window = m_document.item().window.value_or(Window{});
    m_width->setValue(window.width);
    m_level->setValue(window.level);
    const auto found = std::find_if(m_windows.begin(), m_windows.end(),
                                    [&](const NamedWindow& named) { return named.window == window; });
    const QSignalBlocker quiet(m_preset);
    m_preset->setCurrentIndex(found == m_windows.end() ? 0 : static_cast<int>(found - m_windows.begin()) + 1);
}

void WindowPanel::choose(int index) {
    if (index < 1) return sync();
    const NamedWindow& chosen = m_windows[static_cast<std::size_t>(index) - 1];
    m_document.changeItem("Window: " + chosen.name, {},
                          [&](VolumeItem& item) { item.window = chosen.window; });
}

}  // namespace pellucid::app
