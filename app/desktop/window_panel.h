// SPDX-FileCopyrightText: Pellucid contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QGroupBox>

#include "app/desktop/document.h"

class QComboBox;

namespace pellucid::app {

class NumberControl;

/// Window width and level of the slices (and of the modes that show values through it), and named windows.
class WindowPanel : public QGroupBox {
    Q_OBJECT

public:
    explicit WindowPanel(Document& document, QWidget* parent = nullptr);

private:
    void fill();
    void sync();
    void choose(int index);

    Document& m_document;
    QComboBox* m_preset;
    NumberControl* m_width;
    NumberControl* m_level;
    std::vector<NamedWindow> m_windows;  ///< In the order of the combo box, after its first entry.
};

/// The windows that fit a volume: those of its file, the CT presets for Hounsfield data, and its whole range.
[[nodiscard]] std::vector<NamedWindow> windowsFor(const Volume& volume, const VolumeItem& item);
/// The window that a digit key selects: 0 the whole range, 1 to 9 the CT presets for Hounsfield data.
[[nodiscard]] std::optional<NamedWindow> windowForKey(const Volume& volume, const VolumeItem& item, int key);

}  // namespace pellucid::app
